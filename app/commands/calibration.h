// The calibration of `auto`: measured on the device, kept in the user's cache folder, read back only when it fits.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>

#include "oracle/choose.h"
#include "render/renderer.h"

namespace lamp::app {

inline constexpr const char* CALIBRATION_VARIABLE = "LAMPLIGHT_CALIBRATION";
/// Throws Error for a typed `--calibration` where nothing goes by it. A variable of the environment may stay.
void check_calibration(const std::string& named, bool is_read);

/// Measures every candidate on a small built-in scene: seconds on a GPU, most of them compilation; longer on a software
/// device.
[[nodiscard]] Calibration measure_calibration(Context& context, const ShaderLibrary& shaders);

struct KnownCalibration {
  Calibration calibration;
  std::string origin;  ///< for `--explain`: which file, or how long it was measured
};
/// Named in place of a file: measured now, and kept.
inline constexpr std::string_view MEASURE = "measure";
/// That of a file that the user names (throws Error when it is none), or else the cached one of the context's device,
/// or else on a software device, where measuring takes long, the one that is built in, or else a new one, which is then
/// kept. What cannot be kept is said on stderr.
[[nodiscard]] KnownCalibration find_calibration(Context& context, const ShaderLibrary& shaders,
                                                const std::string& named);

}  // namespace lamp::app
