// frame.json of a capture: what it says of itself, checked.
// Promise: any text gives a Manifest or an Error; no file is opened.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lamplight/light.h"
#include "lamplight/view.h"
#include "scene/scene.h"

namespace lamp::app {

/// How the depth file's numbers are meant.
enum class DepthKind : std::uint8_t {
  reversed,  ///< device depth, near 1, far 0; 0 is sky
  standard,  ///< device depth, near 0, far 1; 1 is sky
  linear,    ///< metres ahead; 0, infinity and what lies beyond the far plane are sky
};
/// "reversed", "standard", "linear", in the order of DepthKind.
[[nodiscard]] std::span<const std::string_view> depth_kind_names();

/// Files are names below the capture's folder.
struct Manifest {
  View view;  ///< with reversed depth, whatever the file says
  DepthKind depth_kind = DepthKind::reversed;
  std::string depth;
  std::vector<Light> lights;  ///< those of frame.json itself; checked
  std::string lights_file;    ///< or the name of a .npy file
  std::optional<std::string> albedo, normal, material, emission;
  glm::vec3 ambient{0.02F};  ///< defaults that show unlit surfaces
  glm::vec3 sky{0.01F};
  std::vector<DirectionalLight> directional_lights;
};

/// Reads the text of a frame.json; `file` names it in errors. Throws Error.
[[nodiscard]] Manifest parse_manifest(std::string_view text, const std::string& file);

/// The text of the frame.json that says this; with the lights in it unless they have a file.
[[nodiscard]] std::string manifest_text(const Manifest& manifest);

/// The most lights of a frame.json; a .npy file has room for all.
inline constexpr std::size_t MOST_JSON_LIGHTS = std::size_t{1} << 20;

/// Columns of a light's row in a .npy file.
inline constexpr std::uint32_t LIGHT_COLUMNS = 16;

/// The lights of a .npy file's bytes; `file` names it in errors. Throws Error.
[[nodiscard]] std::vector<Light> read_npy_lights(std::span<const std::byte> bytes, const std::string& file);
[[nodiscard]] std::string npy_lights(std::span<const Light> lights);

/// Lights as frame.json has them. `file` and "light 3" name them in errors.
[[nodiscard]] std::vector<Light> parse_lights(const nlohmann::json& array, const std::string& file);
[[nodiscard]] nlohmann::json lights_json(std::span<const Light> lights);

}  // namespace lamp::app
