// Writes a capture's folder: beside its place under a temporary name, then renamed.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cassert>

#include "error.h"
#include "image/exr.h"
#include "image/write_file.h"
#include "scene/capture.h"
#include "scene/capture_json.h"
#include "system/file_access.h"
#include "system/temporary.h"

namespace lamp::app {
namespace {

namespace fs = std::filesystem;

constexpr const char* DEPTH_FILE = "depth.exr";
constexpr const char* ALBEDO_FILE = "albedo.exr";
constexpr const char* NORMAL_FILE = "normal.exr";
constexpr const char* MATERIAL_FILE = "material.exr";
constexpr const char* EMISSION_FILE = "emission.exr";
constexpr const char* LIGHTS_FILE = "lights.npy";
constexpr std::array<std::string_view, 7> FILES{CAPTURE_FILE,  DEPTH_FILE,    ALBEDO_FILE, NORMAL_FILE,
                                                MATERIAL_FILE, EMISSION_FILE, LIGHTS_FILE};

void write_plane(const fs::path& file, const View& view, const std::vector<glm::vec3>& values,
                 const std::array<std::string_view, 3>& channels) {
  assert(values.size() == std::size_t{view.width()} * view.height() && "fill every pixel");
  write_exr(file, {.width = view.width(),
                   .height = view.height(),
                   .channels = channels,
                   .first = reinterpret_cast<const float*>(values.data()),
                   .floats_per_pixel = 3});
}

void write_frame(const fs::path& folder, const CapturedFrame& frame) {
  constexpr std::array<std::string_view, 1> DEPTH{"Z"};
  write_exr(
      folder / DEPTH_FILE,
      {.width = frame.view.width(), .height = frame.view.height(), .channels = DEPTH, .first = frame.depth.data()});
  write_plane(folder / ALBEDO_FILE, frame.view, frame.albedo, {"R", "G", "B"});
  write_plane(folder / NORMAL_FILE, frame.view, frame.normal, {"X", "Y", "Z"});
  write_plane(folder / MATERIAL_FILE, frame.view, frame.material, {"metallic", "roughness", "occlusion"});
  write_plane(folder / EMISSION_FILE, frame.view, frame.emission, {"R", "G", "B"});
}

/// A material can be brighter than what a frame is shaded from.
void check_emission(const CapturedFrame& frame, const fs::path& folder) {
  for (std::size_t i = 0; i < frame.emission.size(); ++i) {
    const glm::vec3& emission = frame.emission[i];
    if (!(std::max({emission.r, emission.g, emission.b}) <= LARGEST_EMISSION))
      throw Error(fmt::format("{}: emission of pixel ({}, {}) is beyond {}, expected a darker material",
                              folder.string(), i % frame.view.width(), i / frame.view.width(), LARGEST_EMISSION));
  }
}

void write_contents(const fs::path& folder, const Scene& scene, LightsFormat lights) {
  Manifest manifest{.view = scene.captured->view,
                    .depth = DEPTH_FILE,
                    .albedo = ALBEDO_FILE,
                    .normal = NORMAL_FILE,
                    .material = MATERIAL_FILE,
                    .emission = EMISSION_FILE,
                    .ambient = scene.ambient,
                    .sky = scene.sky,
                    .directional_lights = scene.directional_lights};
  write_frame(folder, *scene.captured);
  if (lights == LightsFormat::npy) {
    manifest.lights_file = LIGHTS_FILE;
    write_file(folder / LIGHTS_FILE, npy_lights(scene.lights));
  } else {
    manifest.lights = scene.lights;
  }
  write_file(folder / CAPTURE_FILE, manifest_text(manifest));
}

/// The folder itself: no link, no slash at its end.
fs::path place_of(const fs::path& folder) {
  const fs::path place = fs::absolute(folder);
  return fs::weakly_canonical(followed(place.filename().empty() ? place.parent_path() : place));
}

void check_place(const fs::path& folder) {
  const fs::path place = folder.empty() ? folder : place_of(folder);
  if (!place.has_relative_path())
    throw Error(fmt::format("--out '{}': expected the name of a folder", folder.string()));
  if (fs::exists(place) && !fs::is_directory(place))
    throw Error(fmt::format("--out '{}': is a file, expected a folder", folder.string()));
  if (fs::is_directory(place)) {
    for (const auto& entry : fs::directory_iterator(place))
      if (std::ranges::find(FILES, entry.path().filename().string()) == FILES.end())
        throw Error(fmt::format("--out '{}': holds {}, expected a new folder, an empty one or a capture to replace",
                                folder.string(), entry.path().filename().string()));
  }
  fs::path above = place.parent_path();
  while (!fs::exists(above) && above.has_relative_path()) above = above.parent_path();
  if (!fs::is_directory(above))
    throw Error(fmt::format("--out '{}': {} is not a folder", folder.string(), above.string()));
  if (!is_writable(above))
    throw Error(fmt::format("--out '{}': the folder {} is not writable", folder.string(), above.string()));
}

}  // namespace

Scene captured_scene(const Scene& scene, std::vector<Light> lights, CapturedFrame captured) {
  return {.lights = std::move(lights),
          .directional_lights = scene.directional_lights,
          .sky = scene.sky,
          .ambient = scene.ambient,
          .captured = std::move(captured)};
}

void check_capture_folder(const fs::path& folder) {
  try {
    check_place(folder);
  } catch (const fs::filesystem_error& failure) {
    throw Error(fmt::format("--out '{}': {}", folder.string(), failure.code().message()));
  }
}

void write_capture(const fs::path& folder, const Scene& scene, LightsFormat lights) {
  assert(scene.captured && "a capture is written from a captured frame");
  check_capture_folder(folder);
  check_emission(*scene.captured, folder);
  if (lights == LightsFormat::json && scene.lights.size() > MOST_JSON_LIGHTS)
    throw Error(fmt::format("{}: {} lights, expected at most {} in frame.json; a .npy file takes them", folder.string(),
                            scene.lights.size(), MOST_JSON_LIGHTS));
  const fs::path place = place_of(folder);
  const fs::path name = temporary_name(place);
  try {
    NewFolders above(place.parent_path());
    Temporary made(Temporary::Removal::everything, [&] {
      fs::create_directory(name);
      return fs::path(name);
    });
    write_contents(name, scene, lights);
    made.move_to(place);
    above.keep();
  } catch (const fs::filesystem_error& failure) {
    throw Error(fmt::format("{}: cannot be written: {}", folder.string(), failure.code().message()));
  } catch (const Error& error) {
    // Of a file in the folder: the user knows it by the name that it was to have.
    const std::string line = error.what();
    throw Error(line.starts_with(name.string()) ? folder.string() + line.substr(name.string().size()) : line);
  }
}

}  // namespace lamp::app
