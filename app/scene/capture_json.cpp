// frame.json to a Manifest and back.
// SPDX-License-Identifier: Apache-2.0
#include "scene/capture_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>

#include "files/json_values.h"
#include "files/read_file.h"
#include "files/read_json.h"
#include "files/utf8_path.h"
#include "lamplight/method.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t VERSION = 1;
constexpr std::uint32_t LARGEST_SIDE = 65536;                  // pixels; far more than a device takes
constexpr std::uint64_t MOST_PIXELS = std::uint64_t{1} << 26;  // 3.5 GB of surfaces
constexpr std::string_view DIRECTIONAL = "directional_lights";
constexpr std::array<std::string_view, 16> KEYS{
    "version", "generator", "width",    "height", "clip_from_view", "view_from_world", "depth", "depth_kind",
    "lights",  "albedo",    "material", "normal", "emission",       "ambient",         "sky",   DIRECTIONAL};
constexpr std::array<std::string_view, 2> DIRECTIONAL_KEYS{"direction", "illuminance"};

glm::dmat4 matrix_of(const JsonObject& frame, std::string_view key) {
  const std::vector<double> numbers = frame.numbers(key, 16);
  glm::dmat4 matrix;
  for (int i = 0; i < 16; ++i) matrix[i / 4][i % 4] = numbers[static_cast<std::size_t>(i)];
  return matrix;
}

std::vector<double> array_of(const glm::dmat4& matrix) {
  std::vector<double> numbers;
  for (int i = 0; i < 16; ++i) numbers.push_back(matrix[i / 4][i % 4]);
  return numbers;
}

/// Positive where depth falls with distance.
double depth_slope(const glm::dmat4& p) { return p[2][2] * p[3][3] - p[3][2] * p[2][3]; }

View view_of(const JsonObject& frame, DepthKind kind) {
  glm::dmat4 clip_from_view = matrix_of(frame, "clip_from_view");
  const double slope = depth_slope(clip_from_view);
  if (kind == DepthKind::standard && slope > 0.0)
    frame.fail(
        "clip_from_view has reversed depth (near 1, far 0), expected near 0, far 1, as depth_kind says standard");
  if (kind == DepthKind::reversed && slope < 0.0)
    frame.fail("clip_from_view has depth that grows with distance, expected reversed depth (near 1, far 0)");
  if (slope < 0.0) clip_from_view = flip_depth(clip_from_view);
  const std::uint32_t width = frame.whole("width", 1, LARGEST_SIDE);
  const std::uint32_t height = frame.whole("height", 1, LARGEST_SIDE);
  if (std::uint64_t{width} * height > MOST_PIXELS)
    frame.fail(fmt::format("width and height are {} and {}, expected at most {} pixels", width, height, MOST_PIXELS));
  const Result<View> view = View::create(width, height, clip_from_view, matrix_of(frame, "view_from_world"));
  if (!view) frame.fail(view.error().message);
  const glm::dvec3 reach = glm::abs(glm::dvec3(glm::dmat4(view.value().world_from_view())[3]));
  const double furthest = std::max({reach.x, reach.y, reach.z});
  if (!(furthest <= FURTHEST_M))
    frame.fail(
        fmt::format("view_from_world puts the eye {} m from the origin, expected at most {} m", furthest, FURTHEST_M));
  return view.value();
}

DepthKind depth_kind_of(const JsonObject& frame) {
  if (!frame.has("depth_kind")) return DepthKind::reversed;
  const std::string expected = fmt::format("{}", fmt::join(depth_kind_names(), ", "));
  const std::string name = frame.text("depth_kind", expected);
  const auto found = std::ranges::find(depth_kind_names(), name);
  if (found == depth_kind_names().end())
    frame.fail(fmt::format("depth_kind is {}, expected {}", shown(frame.json.at("depth_kind")), expected));
  return static_cast<DepthKind>(found - depth_kind_names().begin());
}

/// The name of a file below the folder, with this extension.
std::string file_of(const JsonObject& frame, std::string_view key, std::string_view extension) {
  const std::string expected = fmt::format("the name of a file in the same folder that ends in {}", extension);
  const std::string name = frame.text(key, expected);
  const std::filesystem::path file = utf8_path(name);
  if (!stays_below(file) || file.extension().string() != extension)
    frame.fail(fmt::format("{} is {}, expected {}", key, shown(frame.json.at(key)), expected));
  return file.lexically_normal().generic_string();
}

std::optional<std::string> optional_file(const JsonObject& frame, std::string_view key) {
  if (!frame.has(key)) return std::nullopt;
  return file_of(frame, key, ".exr");
}

glm::vec3 light_color(const JsonObject& object, std::string_view key) {
  const glm::vec3 color = object.vector(key);
  if (std::min({color.r, color.g, color.b}) < 0.0F || std::max({color.r, color.g, color.b}) > LARGEST_INTENSITY)
    object.fail(
        fmt::format("{} is {}, expected numbers 0 .. {:g}", key, shown(object.json.at(key)), LARGEST_INTENSITY));
  return color;
}

std::vector<DirectionalLight> directional_lights_of(const JsonObject& frame) {
  const nlohmann::json& array = frame.json.at(DIRECTIONAL);
  if (!array.is_array()) frame.fail(fmt::format("{} is {}, expected an array", DIRECTIONAL, shown(array)));
  std::vector<DirectionalLight> lights;
  for (std::size_t i = 0; i < array.size(); ++i) {
    const JsonObject object{array[i], frame.file, fmt::format("directional light {}", i)};
    object.check_keys(DIRECTIONAL_KEYS);
    const glm::vec3 direction = object.vector("direction");
    const double length = glm::length(glm::dvec3(direction));
    // A unit vector stays as it is, bit for bit.
    if (!(std::abs(length - 1.0) < 1e-3))
      object.fail(fmt::format("direction has length {}, expected a unit vector", length));
    lights.push_back({direction, light_color(object, "illuminance")});
  }
  return lights;
}

void read_lights(const JsonObject& frame, Manifest& manifest) {
  constexpr std::string_view EXPECTED = "an array of lights or the name of a .npy file";
  const nlohmann::json& lights = frame.at("lights", EXPECTED);
  if (lights.is_array() && lights.size() > MOST_JSON_LIGHTS)
    frame.fail(
        fmt::format("lights has {} elements, expected at most {}, or a .npy file", lights.size(), MOST_JSON_LIGHTS));
  if (lights.is_array())
    manifest.lights = parse_lights(lights, frame.file);
  else if (lights.is_string())
    manifest.lights_file = file_of(frame, "lights", ".npy");
  else
    frame.fail(fmt::format("lights is {}, expected {}", shown(lights), EXPECTED));
}

}  // namespace

std::span<const std::string_view> depth_kind_names() {
  static constexpr std::array<std::string_view, 3> NAMES{"reversed", "standard", "linear"};
  return NAMES;
}

Manifest parse_manifest(std::string_view text, const std::string& file) {
  const nlohmann::json json = parse_json(text, file);
  const JsonObject frame{json, file, ""};
  if (!json.is_object()) frame.fail(fmt::format("is {}, expected an object", shown(json)));
  // First, as another version may have other keys.
  const nlohmann::json& version = frame.at("version", fmt::format("{}", VERSION));
  if (version != VERSION) frame.fail(fmt::format("version is {}, expected {}", shown(version), VERSION));
  frame.check_keys(KEYS);

  Manifest manifest;
  manifest.depth_kind = depth_kind_of(frame);
  manifest.view = view_of(frame, manifest.depth_kind);
  manifest.depth = file_of(frame, "depth", ".exr");
  read_lights(frame, manifest);
  manifest.albedo = optional_file(frame, "albedo");
  manifest.normal = optional_file(frame, "normal");
  manifest.material = optional_file(frame, "material");
  manifest.emission = optional_file(frame, "emission");
  if (frame.has("ambient")) manifest.ambient = light_color(frame, "ambient");
  if (frame.has("sky")) manifest.sky = light_color(frame, "sky");
  if (frame.has(DIRECTIONAL)) manifest.directional_lights = directional_lights_of(frame);
  return manifest;
}

std::string manifest_text(const Manifest& m) {
  const auto vector = [](const glm::vec3& v) { return nlohmann::json{v.x, v.y, v.z}; };
  nlohmann::ordered_json json{{"version", VERSION},
                              {"generator", "lamp capture"},
                              {"width", m.view.width()},
                              {"height", m.view.height()},
                              {"clip_from_view", array_of(m.view.clip_from_view())},
                              {"view_from_world", array_of(m.view.view_from_world())},
                              {"depth", m.depth},
                              {"depth_kind", depth_kind_names()[static_cast<std::size_t>(m.depth_kind)]}};
  const std::pair<const char*, const std::optional<std::string>*> files[] = {
      {"albedo", &m.albedo}, {"normal", &m.normal}, {"material", &m.material}, {"emission", &m.emission}};
  for (const auto& [key, file] : files)
    if (*file) json[key] = **file;
  json["ambient"] = vector(m.ambient);
  json["sky"] = vector(m.sky);
  json[std::string(DIRECTIONAL)] = nlohmann::json::array();
  for (const DirectionalLight& light : m.directional_lights)
    json[std::string(DIRECTIONAL)].push_back(
        {{"direction", vector(light.direction)}, {"illuminance", vector(light.illuminance)}});
  if (m.lights_file.empty())
    json["lights"] = lights_json(m.lights);
  else
    json["lights"] = m.lights_file;
  return json.dump(1) + "\n";
}

}  // namespace lamp::app
