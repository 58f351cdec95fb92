// The clock of one GPU by NVIDIA's management library, which comes with the driver and is loaded when it is there.
// Based on: NVIDIA, NVML API reference (its functions and numbers are declared here, since its header is no
// dependency).
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "system/shared_library.h"

namespace lamp::app {

struct NvmlClock {
  double now_mhz = 0.0;            ///< of the streaming multiprocessors
  std::optional<double> most_mhz;  ///< that they can run at
};

class Nvml {
 public:
  /// The device by its PCI address, "0000:03:00.0", or else by its UUID, "GPU-...".
  Nvml(const std::string& address, const std::string& uuid);
  ~Nvml();
  Nvml(const Nvml&) = delete;
  Nvml& operator=(const Nvml&) = delete;

  /// Nothing where the library is not there, knows no such device, or refuses.
  [[nodiscard]] std::optional<NvmlClock> clock() const;

 private:
  void find(const std::string& address, const std::string& uuid);

  SharedLibrary library_;
  bool has_begun_ = false;
  void* device_ = nullptr;  ///< null: not found
};

}  // namespace lamp::app
