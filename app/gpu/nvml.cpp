// Loads the library and asks it.
// SPDX-License-Identifier: Apache-2.0
#include "gpu/nvml.h"

namespace lamp::app {
namespace {

constexpr int SUCCESS = 0;   // NVML_SUCCESS
constexpr int CLOCK_SM = 1;  // NVML_CLOCK_SM

using Begin = int (*)();
using Find = int (*)(const char* name, void** device);
using Ask = int (*)(void* device, int clock, unsigned* mhz);

std::optional<double> asked(const SharedLibrary& library, const char* name, void* device) {
  const auto ask = library.function<Ask>(name);
  unsigned mhz = 0;
  if (ask == nullptr || ask(device, CLOCK_SM, &mhz) != SUCCESS) return std::nullopt;
  return mhz;
}

}  // namespace

Nvml::Nvml(const std::string& address, const std::string& uuid)
    : library_({.posix = "libnvidia-ml.so.1", .windows = "nvml.dll"}) {
  const auto begin = library_.function<Begin>("nvmlInit_v2");
  has_begun_ = begin != nullptr && begin() == SUCCESS;
  if (has_begun_) find(address, uuid);
}

Nvml::~Nvml() {
  if (!has_begun_) return;
  if (const auto end = library_.function<Begin>("nvmlShutdown")) end();
}

void Nvml::find(const std::string& address, const std::string& uuid) {
  const auto by_address = library_.function<Find>("nvmlDeviceGetHandleByPciBusId_v2");
  if (by_address != nullptr && !address.empty() && by_address(address.c_str(), &device_) == SUCCESS) return;
  const auto by_uuid = library_.function<Find>("nvmlDeviceGetHandleByUUID");
  if (by_uuid == nullptr || by_uuid(uuid.c_str(), &device_) != SUCCESS) device_ = nullptr;
}

std::optional<NvmlClock> Nvml::clock() const {
  if (device_ == nullptr) return std::nullopt;
  const std::optional<double> now = asked(library_, "nvmlDeviceGetClockInfo", device_);
  if (!now) return std::nullopt;
  return NvmlClock{.now_mhz = *now, .most_mhz = asked(library_, "nvmlDeviceGetMaxClockInfo", device_)};
}

}  // namespace lamp::app
