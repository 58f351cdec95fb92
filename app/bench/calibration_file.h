// The calibration of `auto` as a file: checked word for word when it is read, replaced in one step when it is written.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "oracle/choose.h"

namespace lamp::app {

[[nodiscard]] nlohmann::json to_json(const Calibration& calibration);
/// Throws Error, which begins with `source`, for what is no calibration of this version and these candidates.
[[nodiscard]] Calibration parse_calibration(std::string_view text, const std::string& source);

/// The calibration in a file, which errors call `name`. Throws Error.
[[nodiscard]] Calibration load_calibration(const std::string& file, const std::string& name);

/// The file for a device and a driver in the user's cache folder, $XDG_CACHE_HOME, %LOCALAPPDATA% or ~/.cache; empty
/// when there is no such folder.
[[nodiscard]] std::string cached_calibration_file(const std::string& device, const std::string& driver);

/// The calibration in a file of the cache; nothing when it is not there, damaged, or another device's or driver's.
[[nodiscard]] std::optional<Calibration> read_cached_calibration(const std::string& file, const std::string& device,
                                                                 const std::string& driver);

/// Writes beside the file and then renames, so that no other process reads a half of it. Empty, or why it failed.
[[nodiscard]] std::string keep_calibration(const std::string& file, const Calibration& calibration);

}  // namespace lamp::app
