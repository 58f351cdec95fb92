// Loads libnvidia-ml.so.1.
// SPDX-License-Identifier: Apache-2.0
#include "gpu/nvml.h"

#include <dlfcn.h>

namespace lamp::app {
namespace {

constexpr int SUCCESS = 0;   // NVML_SUCCESS
constexpr int CLOCK_SM = 1;  // NVML_CLOCK_SM

using Begin = int (*)();
using Find = int (*)(const char* name, void** device);
using Ask = int (*)(void* device, int clock, unsigned* mhz);

template <class Function>
Function function(void* library, const char* name) {
  return library == nullptr ? nullptr : reinterpret_cast<Function>(dlsym(library, name));
}

std::optional<double> asked(void* library, const char* name, void* device) {
  const auto ask = function<Ask>(library, name);
  unsigned mhz = 0;
  if (ask == nullptr || ask(device, CLOCK_SM, &mhz) != SUCCESS) return std::nullopt;
  return mhz;
}

}  // namespace

Nvml::Nvml(const std::string& address, const std::string& uuid)
    : library_(dlopen("libnvidia-ml.so.1", RTLD_NOW | RTLD_LOCAL)) {
  const auto begin = function<Begin>(library_, "nvmlInit_v2");
  if (begin == nullptr || begin() != SUCCESS) {
    if (library_ != nullptr) dlclose(library_);
    library_ = nullptr;
    return;
  }
  find(address, uuid);
}

Nvml::~Nvml() {
  if (library_ == nullptr) return;
  if (const auto end = function<Begin>(library_, "nvmlShutdown")) end();
  dlclose(library_);
}

void Nvml::find(const std::string& address, const std::string& uuid) {
  const auto by_address = function<Find>(library_, "nvmlDeviceGetHandleByPciBusId_v2");
  if (by_address != nullptr && !address.empty() && by_address(address.c_str(), &device_) == SUCCESS) return;
  const auto by_uuid = function<Find>(library_, "nvmlDeviceGetHandleByUUID");
  if (by_uuid == nullptr || by_uuid(uuid.c_str(), &device_) != SUCCESS) device_ = nullptr;
}

std::optional<NvmlClock> Nvml::clock() const {
  if (device_ == nullptr) return std::nullopt;
  const std::optional<double> now = asked(library_, "nvmlDeviceGetClockInfo", device_);
  if (!now) return std::nullopt;
  return NvmlClock{.now_mhz = *now, .most_mhz = asked(library_, "nvmlDeviceGetMaxClockInfo", device_)};
}

}  // namespace lamp::app
