// Finds the device among those that the driver's own interfaces know, by its PCI address.
// SPDX-License-Identifier: Apache-2.0
#include "gpu/device_clock.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <fstream>
#include <sstream>
#include <string_view>

#include "gpu/nvml.h"

namespace lamp::app {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t NVIDIA = 0x10de;  // vendors by their PCI numbers
constexpr auto BETWEEN = std::chrono::milliseconds(250);
constexpr const char* DEVICES = "/sys/bus/pci/devices";

std::string address_of(VkPhysicalDevice physical) {
  if (!has_extension(physical, VK_EXT_PCI_BUS_INFO_EXTENSION_NAME)) return "";
  VkPhysicalDevicePCIBusInfoPropertiesEXT pci{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PCI_BUS_INFO_PROPERTIES_EXT};
  VkPhysicalDeviceProperties2 properties{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, .pNext = &pci};
  vkGetPhysicalDeviceProperties2(physical, &properties);
  return fmt::format("{:04x}:{:02x}:{:02x}.{:x}", pci.pciDomain, pci.pciBus, pci.pciDevice, pci.pciFunction);
}

/// "GPU-12345678-1234-1234-1234-123456789abc"
std::string uuid_of(VkPhysicalDevice physical) {
  VkPhysicalDeviceIDProperties ids{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_ID_PROPERTIES};
  VkPhysicalDeviceProperties2 properties{.sType = VK_STRUCTURE_TYPE_PHYSICAL_DEVICE_PROPERTIES_2, .pNext = &ids};
  vkGetPhysicalDeviceProperties2(physical, &properties);
  std::string words = "GPU-";
  for (std::size_t i = 0; i < VK_UUID_SIZE; ++i) {
    if (i == 4 || i == 6 || i == 8 || i == 10) words += '-';
    words += fmt::format("{:02x}", ids.deviceUUID[i]);
  }
  return words;
}

/// The number at the beginning of a text, and what follows it.
std::optional<std::pair<double, std::string_view>> number_of(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
  unsigned number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{}) return std::nullopt;
  return std::pair(double(number), text.substr(static_cast<std::size_t>(end - text.data())));
}

/// A file that holds a number of MHz.
std::optional<double> mhz_in(const fs::path& file) {
  std::ifstream stream(file);
  std::string line;
  if (!std::getline(stream, line)) return std::nullopt;
  const auto number = number_of(line);
  if (!number) return std::nullopt;
  return number->first;
}

/// amdgpu's table of levels, "1: 1200Mhz *": the star is at the one in use.
std::optional<Clock> clock_of_levels(const fs::path& file) {
  std::ifstream stream(file);
  Clock clock{.told_by = "amdgpu"};
  for (std::string line; std::getline(stream, line);) {
    const std::size_t colon = line.find(':');
    if (colon == std::string::npos) continue;
    const auto level = number_of(std::string_view(line).substr(colon + 1));
    if (!level || !level->second.starts_with("Mhz")) continue;
    clock.most_mhz = std::max(clock.most_mhz.value_or(0.0), level->first);
    if (level->second.find('*') != std::string_view::npos) clock.now_mhz = level->first;
  }
  return clock.now_mhz ? std::optional(clock) : std::nullopt;
}

/// Where Intel's drivers have them, older kernels last. `now` and `most` lie in the same folder.
struct IntelFiles {
  const char* folder;
  const char* now;
  const char* most;
  const char* driver;
};
constexpr std::array<IntelFiles, 3> INTEL{{{"tile0/gt0/freq0", "cur_freq", "rp0_freq", "xe"},
                                           {"gt/gt0", "rps_cur_freq_mhz", "rps_RP0_freq_mhz", "i915"},
                                           {"", "gt_cur_freq_mhz", "gt_RP0_freq_mhz", "i915"}}};

std::optional<Clock> clock_of_intel(const fs::path& folder) {
  for (const IntelFiles& files : INTEL) {
    const fs::path at = folder / files.folder;
    if (const std::optional<double> now = mhz_in(at / files.now))
      return Clock{.now_mhz = now, .most_mhz = mhz_in(at / files.most), .told_by = files.driver};
  }
  return std::nullopt;
}

}  // namespace

std::string words_of(const Clock& clock) {
  if (!clock.now_mhz) return CLOCK_UNTOLD;
  const std::string most = clock.most_mhz ? fmt::format(" of at most {:.0f}", *clock.most_mhz) : "";
  return fmt::format("{:.0f}{} MHz ({})", *clock.now_mhz, most, clock.told_by);
}

std::optional<Clock> clock_in(const fs::path& folder) {
  if (std::optional<Clock> clock = clock_of_levels(folder / "pp_dpm_sclk")) return clock;
  if (std::optional<Clock> clock = clock_of_intel(folder)) return clock;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder / "drm", none))
    if (entry.path().filename().string().starts_with("card"))
      if (std::optional<Clock> clock = clock_of_intel(entry.path())) return clock;
  return std::nullopt;
}

DeviceClock::DeviceClock(const Context& context) {
  if (context.software()) return;
  const VkPhysicalDevice physical = context.device().physical;
  VkPhysicalDeviceProperties properties{};
  vkGetPhysicalDeviceProperties(physical, &properties);
  nvidia_ = properties.vendorID == NVIDIA;
  address_ = address_of(physical);
  uuid_ = uuid_of(physical);
}

DeviceClock::~DeviceClock() = default;

Clock DeviceClock::ask() {
  if (nvidia_) {
    if (!nvml_) nvml_ = std::make_unique<Nvml>(address_, uuid_);
    if (const std::optional<NvmlClock> clock = nvml_->clock())
      return {.now_mhz = clock->now_mhz, .most_mhz = clock->most_mhz, .told_by = "NVML"};
  }
  if (address_.empty()) return {};
  return clock_in(fs::path(DEVICES) / address_).value_or(Clock());
}

const Clock& DeviceClock::read() {
  const auto now = std::chrono::steady_clock::now();
  if (asked_ && now - *asked_ < BETWEEN) return last_;
  asked_ = now;
  last_ = ask();
  return last_;
}

}  // namespace lamp::app
