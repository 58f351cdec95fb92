// How fast a GPU's clock runs, where its driver tells: NVIDIA's management library, or files of Linux's drivers.
// Promise: whatever is missing is no error; nothing is linked, and nothing of the device is changed.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "gpu/context.h"

namespace lamp::app {

struct Clock {
  std::optional<double> now_mhz;   ///< nothing: the driver does not tell
  std::optional<double> most_mhz;  ///< that the device can run at, as far as it is told
  std::string told_by;             ///< "NVML", "amdgpu", "i915", "xe"
};
inline constexpr const char* CLOCK_UNTOLD = "this driver does not tell";
/// "1980 of at most 1980 MHz (NVML)", or CLOCK_UNTOLD.
[[nodiscard]] std::string words_of(const Clock& clock);

/// What a driver says in the folder that Linux has for a device, /sys/bus/pci/devices/0000:03:00.0; nothing where it
/// says nothing, or what cannot be understood.
[[nodiscard]] std::optional<Clock> clock_in(const std::filesystem::path& folder);

class Nvml;

/// The clock of a context's device.
class DeviceClock {
 public:
  explicit DeviceClock(const Context& context);
  ~DeviceClock();
  DeviceClock(const DeviceClock&) = delete;
  DeviceClock& operator=(const DeviceClock&) = delete;

  /// Asks the driver at most four times a second: in between, what it said last. The first call may take a while.
  [[nodiscard]] const Clock& read();

 private:
  [[nodiscard]] Clock ask();

  std::string address_;  ///< on the PCI bus, "0000:03:00.0"; empty: unknown
  std::string uuid_;     ///< as NVIDIA writes it
  bool nvidia_ = false;
  std::unique_ptr<Nvml> nvml_;  ///< null until it is asked
  std::optional<std::chrono::steady_clock::time_point> asked_;
  Clock last_;
};

}  // namespace lamp::app
