// Writes a capture's folder: beside its place under a temporary name, then renamed.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cassert>

#include "error.h"
#include "image/exr.h"
#include "image/write_file.h"
#include "scene/capture.h"
#include "scene/capture_json.h"

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

/// A folder beside `place`, gone with its owner unless it was moved there.
class NewFolder {
 public:
  explicit NewFolder(const fs::path& place) : place_(place), path_(place) {
    path_ += fmt::format(".{}.tmp", getpid());
    for (above_ = place_.parent_path(); !fs::exists(above_); above_ = above_.parent_path()) {
    }
    fs::create_directories(path_);
  }
  NewFolder(const NewFolder&) = delete;
  NewFolder& operator=(const NewFolder&) = delete;
  ~NewFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
    // Folders that were made on the way, while they are empty.
    for (fs::path made = place_.parent_path(); made != above_; made = made.parent_path())
      if (!fs::remove(made, ignored)) break;
  }
  [[nodiscard]] const fs::path& path() const { return path_; }

  /// An older capture gives way only once the new one is whole.
  void move_into_place() {
    fs::path old = path_;
    old += ".old";
    const bool replaces = fs::exists(place_);
    if (replaces) fs::rename(place_, old);
    std::error_code error;
    fs::rename(path_, place_, error);
    if (error && replaces) fs::rename(old, place_);
    if (error) throw fs::filesystem_error("rename", place_, error);
    if (replaces) fs::remove_all(old);
  }

 private:
  fs::path place_;
  fs::path path_;
  fs::path above_;  ///< the nearest folder that was there before
};

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

/// Without the slash at its end.
fs::path place_of(const fs::path& folder) {
  const fs::path place = fs::absolute(folder).lexically_normal();
  return place.filename().empty() ? place.parent_path() : place;
}

}  // namespace

void check_capture_folder(const fs::path& folder) {
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
  if (access(above.c_str(), W_OK) != 0)
    throw Error(fmt::format("--out '{}': the folder {} is not writable", folder.string(), above.string()));
}

void write_capture(const fs::path& folder, const Scene& scene, LightsFormat lights) {
  assert(scene.captured && "a capture is written from a captured frame");
  check_capture_folder(folder);
  check_emission(*scene.captured, folder);
  try {
    NewFolder made(place_of(folder));
    write_contents(made.path(), scene, lights);
    made.move_into_place();
  } catch (const fs::filesystem_error& failure) {
    throw Error(fmt::format("{}: cannot be written: {}", folder.string(), failure.code().message()));
  }
}

}  // namespace lamp::app
