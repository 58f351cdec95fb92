// Reads a capture's folder.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "error.h"
#include "files/read_file.h"
#include "files/utf8_path.h"
#include "image/exr.h"
#include "lamplight/method.h"
#include "scene/capture.h"
#include "scene/capture_depth.h"
#include "scene/capture_json.h"

namespace lamp::app {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t LARGEST_LIGHTS = std::uint64_t{MAX_LIGHTS} * LIGHT_COLUMNS * sizeof(float) + 4096;  // bytes

// What a capture that says nothing is made of: grey, rough, not metallic.
constexpr glm::vec3 NEUTRAL_ALBEDO{0.5F};
constexpr glm::vec3 NEUTRAL_MATERIAL{0.0F, 0.6F, 1.0F};

/// A file of three channels, and what a value must be.
struct Plane {
  std::string_view name;
  std::array<std::string_view, 3> channels;
  float min = 0.0F;
  float max = 1.0F;
};
constexpr Plane ALBEDO{"albedo", {"R", "G", "B"}};
constexpr Plane MATERIAL{"material", {"metallic", "roughness", "occlusion"}};
constexpr Plane EMISSION{"emission", {"R", "G", "B"}, 0.0F, LARGEST_EMISSION};
constexpr Plane NORMAL{"normal", {"X", "Y", "Z"}, -1e6F, 1e6F};

/// False for a NaN.
bool within(float value, float min, float max) { return value >= min && value <= max; }

/// Reads the pixels that are not sky; the others stay 0.
std::vector<glm::vec3> read_plane(const fs::path& file, const Plane& plane, const CapturedFrame& frame) {
  const std::vector<float> values =
      read_exr(file, {.width = frame.view.width(), .height = frame.view.height(), .channels = plane.channels});
  std::vector<glm::vec3> pixels(frame.depth.size(), glm::vec3(0.0F));
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    if (frame.depth[i] == 0.0F) continue;
    for (int c = 0; c < 3; ++c) {
      const float value = values[i * 3 + static_cast<std::size_t>(c)];
      if (!within(value, plane.min, plane.max))
        throw Error(fmt::format("{}: {} of pixel ({}, {}), channel {}, is {}, expected {} .. {}", file.string(),
                                plane.name, i % frame.view.width(), i / frame.view.width(),
                                plane.channels[static_cast<std::size_t>(c)], value, plane.min, plane.max));
      pixels[i][c] = value;
    }
  }
  return pixels;
}

/// Unit vectors stay bit for bit.
void normalize_normals(std::vector<glm::vec3>& normals, const CapturedFrame& frame, const std::string& file) {
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (frame.depth[i] == 0.0F) continue;
    const double length = glm::length(glm::dvec3(normals[i]));
    if (!(length > 1e-6))
      throw Error(fmt::format("{}: normal of pixel ({}, {}) has length {}, expected a unit vector", file,
                              i % frame.view.width(), i / frame.view.width(), length));
    if (std::abs(length - 1.0) > 1e-6) normals[i] = glm::vec3(glm::dvec3(normals[i]) / length);
  }
}

void read_surfaces(const fs::path& folder, const Manifest& manifest, CapturedFrame& frame) {
  const std::size_t pixels = frame.depth.size();
  const auto read_or = [&](const std::optional<std::string>& file, const Plane& plane, const glm::vec3& neutral) {
    return file ? read_plane(folder / utf8_path(*file), plane, frame) : std::vector<glm::vec3>(pixels, neutral);
  };
  frame.albedo = read_or(manifest.albedo, ALBEDO, NEUTRAL_ALBEDO);
  frame.material = read_or(manifest.material, MATERIAL, NEUTRAL_MATERIAL);
  frame.emission = read_or(manifest.emission, EMISSION, glm::vec3(0.0F));
  if (!manifest.normal) {
    frame.normal = normals_from_depth(frame.view, frame.depth);
    return;
  }
  const fs::path file = folder / utf8_path(*manifest.normal);
  frame.normal = read_plane(file, NORMAL, frame);
  normalize_normals(frame.normal, frame, file.string());
}

/// For what asks a scene for a camera; the frame's own view is `captured->view`.
Camera camera_of(const View& view) {
  Camera camera{
      .name = "capture", .world_from_camera = glm::mat4(view.world_from_view()), .orthographic = view.orthographic()};
  const double half_height = 1.0 / std::abs(view.clip_from_view()[1][1]);
  camera.fov_y = static_cast<float>(2.0 * std::atan(half_height));
  camera.half_height = static_cast<float>(half_height);
  camera.near_m = static_cast<float>(view.z_view(1.0));
  return camera;
}

/// Those of frame.json, or of the file that it names.
std::vector<Light> lights_of(const fs::path& folder, Manifest& manifest, const std::string& manifest_file) {
  std::vector<Light> lights = std::move(manifest.lights);
  if (!manifest.lights_file.empty()) {
    const fs::path file = folder / utf8_path(manifest.lights_file);
    lights = read_npy_lights(
        read_file(file, {.expected = "the lights of " + manifest_file, .most_bytes = LARGEST_LIGHTS}), file.string());
  }
  if (lights.size() > MAX_LIGHTS)
    throw Error(fmt::format("{}: lights: has {}, expected at most {}", manifest_file, lights.size(), MAX_LIGHTS));
  return lights;
}

CapturedFrame frame_of(const fs::path& folder, const Manifest& manifest) {
  constexpr std::array<std::string_view, 1> DEPTH{"Z"};
  CapturedFrame frame{.view = manifest.view};
  const fs::path file = folder / utf8_path(manifest.depth);
  frame.depth = read_exr(
      file, {.width = frame.view.width(), .height = frame.view.height(), .channels = DEPTH, .full_precision = true});
  convert_depth(frame.depth, manifest.depth_kind, frame.view, file.string());
  read_surfaces(folder, manifest, frame);
  return frame;
}

/// frame.json and what it names.
std::vector<fs::path> files_of(const fs::path& folder, const Manifest& manifest) {
  std::vector<fs::path> files{folder / CAPTURE_FILE, folder / utf8_path(manifest.depth)};
  if (!manifest.lights_file.empty()) files.push_back(folder / utf8_path(manifest.lights_file));
  for (const auto* name : {&manifest.albedo, &manifest.normal, &manifest.material, &manifest.emission})
    if (*name) files.push_back(folder / utf8_path(**name));
  return files;
}

Scene read_capture(const fs::path& folder) {
  const fs::path manifest_file = folder / CAPTURE_FILE;
  const std::vector<std::byte> text = read_file(manifest_file, {.expected = "a capture's frame.json"});
  Manifest manifest = parse_manifest(text_of(text), manifest_file.string());

  Scene scene;
  scene.name = folder.filename().empty() ? folder.parent_path().filename().string() : folder.filename().string();
  scene.materials.push_back({.name = "neutral"});
  scene.cameras.push_back(camera_of(manifest.view));
  scene.ambient = manifest.ambient;
  scene.sky = manifest.sky;
  scene.directional_lights = manifest.directional_lights;
  scene.lights = lights_of(folder, manifest, manifest_file.string());
  scene.captured = frame_of(folder, manifest);
  scene.files = files_of(folder, manifest);
  return scene;
}

}  // namespace

Scene load_capture(const fs::path& folder) {
  return within_memory(folder.string(), [&] { return read_capture(folder); });
}

}  // namespace lamp::app
