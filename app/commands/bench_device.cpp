// Loads scenes, makes frames.
// SPDX-License-Identifier: Apache-2.0
#include "commands/bench_device.h"

#include <fmt/format.h>

#include <algorithm>

#include "files/content_hash.h"
#include "files/utf8_path.h"
#include "scene/number_triangles.h"
#include "scene/place_lights.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t PATH_FRAMES = 300;  // a scene without a flight: lights come back to where they were

/// Frame of the scene's own time: of its flight and of the lights' paths.
std::uint32_t scene_frame(const Group& group, std::uint32_t number, std::uint32_t path_frames) {
  if (!group.flight) return static_cast<std::uint32_t>(std::max(0, group.frame)) + number;
  return static_cast<std::uint32_t>(std::uint64_t{number} * path_frames / group.frames);
}

std::vector<View> views_at(const Scene& scene, const Group& group, std::uint32_t frame) {
  Request request = request_of(group, group.entries.front());
  if (group.flight) request.frame = static_cast<int>(frame);
  return requested_views(request, scene);
}

}  // namespace

HostDepth host_depth_of(const Group& group) {
  HostDepth depth = parse_depth(group.depth, group.depth_samples);
  depth.views = group.stereo_m > 0.0 ? 2 : 1;
  return depth;
}

std::optional<ShadowSettings> shadows_of(const Group& group, const Scene& scene) {
  return requested_shadows(request_of(group, group.entries.front()), scene);
}

std::optional<MirrorSettings> mirror_of(const Group& group, const Scene& scene) {
  std::optional<MirrorSettings> settings = requested_mirror(request_of(group, group.entries.front()), scene);
  if (settings) settings->walks_apart = true;
  return settings;
}

BenchDevice::BenchDevice(const Request& request)
    : shaders_(utf8_path(request.shader_dir)),
      context_(std::make_unique<Context>(
          ContextInfo{.device = request.device, .pipeline_statistics = request.pipeline_statistics})),
      chooser_(*context_, shaders_, request.calibration) {}

BenchScene& BenchDevice::scene(const Group& group) {
  const bool numbers = group.still > 0.0;
  const std::string name = group.scene + (numbers ? " with numbered triangles" : "");
  if (scene_.gpu == nullptr || scene_name_ != name) {
    scene_ = {};
    scene_.scene = load_scene(group.scene);
    if (numbers) number_triangles(scene_.scene);
    if (const auto error = check_lights(scene_.scene.lights)) throw Error(group.scene + ": " + error->text());
    scene_.gpu = std::make_unique<GpuScene>(*context_, scene_.scene);
    scene_name_ = name;
    boxes_name_.clear();
  }
  place_boxes(group);
  return scene_;
}

void BenchDevice::place_boxes(const Group& group) {
  const std::string name = fmt::format("{} decals, {} probes of seed {}", group.decals, group.probes, group.seed);
  if (boxes_name_ == name) return;
  const Request request = request_of(group, group.entries.front());
  scene_.decals = requested_decals(request, scene_.scene);
  scene_.probes = pack(requested_probes(request, scene_.scene));
  boxes_name_ = name;
}

std::uint32_t light_capacity(const BenchScene& scene, const Group& group) {
  return group.lights + static_cast<std::uint32_t>(scene.scene.lights.size());
}

std::uint32_t standing_lights(const BenchScene& scene, const Group& group) {
  return still_lights(request_of(group, group.entries.front()), scene.scene, group.lights);
}

void SceneCheck::check(Group& group) {
  if (group.scene != name_) {
    scene_ = load_scene(group.scene);
    hash_ = hash_of_files(scene_.files);
    name_ = group.scene;
  }
  static_cast<void>(views_at(scene_, group, 0));
  static_cast<void>(shadows_of(group, scene_));
  static_cast<void>(mirror_of(group, scene_));
  for (const GroupEntry& entry : group.entries) check_still(request_of(group, entry), scene_);
  if (scene_.captured) {  // which has no place for them; elsewhere they are placed when they are needed
    const Request request = request_of(group, group.entries.front());
    static_cast<void>(requested_decals(request, scene_));
    static_cast<void>(requested_probes(request, scene_));
  }
  group.scene_hash = hash_;
}

BenchFrame bench_frame(BenchScene& scene, const Group& group, std::uint32_t number) {
  const Request request = request_of(group, group.entries.front());
  const auto [min_range, max_range] = parse_range(request.range);
  const std::uint32_t path_frames = scene.scene.flight ? scene.scene.flight->frames : PATH_FRAMES;
  const std::uint32_t frame = scene_frame(group, number, path_frames);
  const std::uint32_t count = group.flight ? lights_at(*group.flight, number, group.frames) : group.lights;
  if (!scene.air && count != 0) scene.air = find_open_air(scene.scene);
  BenchFrame made{.number = number, .views = views_at(scene.scene, group, frame)};
  std::vector<Light> generated;
  if (count != 0)
    generated = place_lights(*scene.air, {.count = count,
                                          .spots = request.spots,
                                          .still = request.still,
                                          .min_range = min_range,
                                          .max_range = max_range,
                                          .seed = group.seed,
                                          .frame = frame,
                                          .frames = path_frames});
  made.lights = packed_lights(request, scene.scene, generated);
  made.still = still_lights(request, scene.scene, generated.size());
  made.decals = scene.decals;
  return made;
}

Request request_of(const Group& group, const GroupEntry& entry) {
  return {.scene = group.scene,
          .size = group.size,
          .size_given = true,
          .lights = group.lights,
          .spots = static_cast<float>(group.spots),
          .range = group.range,
          .decals = group.decals,
          .probes = group.probes,
          .probes_show = "flat",  // lists and look-ups are measured; captures would take their time
          .seed = group.seed,
          .method = entry.name,
          .options = entry.options,
          .path = entry.path,
          .brdf = group.brdf,
          .still = static_cast<float>(group.still),
          .still_lists = entry.still_lists,
          .still_occlusion = entry.still_occlusion,
          .still_bytes = static_cast<float>(entry.still_bytes),
          .mirror = static_cast<float>(group.mirror),
          .mirror_lists = group.mirror_lists,
          .shadows = group.shadows,
          .camera = group.camera,
          .frame = group.frame,
          .projection = group.projection,
          .depth = group.depth,
          .depth_samples = group.depth_samples,
          .stereo_m = static_cast<float>(group.stereo_m)};
}

}  // namespace lamp::app
