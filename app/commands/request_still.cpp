// Lights that stand still: the options, their place among all lights, and their lists.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>

#include "commands/command_line.h"
#include "commands/request.h"
#include "gpu/check.h"
#include "scene/place_lights.h"
#include "scene/still_surfaces.h"
#include "scene/still_triangles.h"

namespace lamp::app {
namespace {

constexpr std::string_view OFF = "off";
constexpr std::array<std::string_view, 3> LISTS{OFF, "triangle-lists", "world-tree"};  // in the order of gpu::STILL_OFF
constexpr std::uint64_t LEAST_BYTES = 1U << 20;  // whatever few triangles a scene has
constexpr std::uint64_t LEAST_TREE_BYTES = 16U << 20;

/// m: of the farthest point of a scene's box that any view from within it, or these views, may see.
float farthest(const Box& box, std::span<const View> views) {
  float most = glm::length(box.max - box.min);
  for (const View& view : views) {
    const glm::vec3 eye(glm::dvec3(glm::dmat4(view.world_from_view())[3]));
    most = std::max(most, glm::length(glm::max(glm::abs(box.min - eye), glm::abs(box.max - eye))));
  }
  return most;
}

float slack_of(const Box& box, std::span<const View> views, std::uint32_t subpixel_bits) {
  const float most_z = farthest(box, views);
  float slack = 0.0F;
  for (const View& view : views) {
    const glm::dmat4 clip(view.clip_from_view());
    const double pixel =
        std::max(2.0 / (view.width() * std::abs(clip[0][0])), 2.0 / (view.height() * std::abs(clip[1][1])));
    const bool perspective = clip[2][3] != 0.0;
    slack = std::max(slack, raster_slack(perspective ? most_z : 1.0F, static_cast<float>(pixel), subpixel_bits));
  }
  return slack;
}

/// Eyes may go where they like, as long as it is not very much farther than the scene is large.
float eyes_of(const Box& box, std::span<const View> views) {
  const float corner = std::max(glm::length(box.min), glm::length(box.max));
  return 2.0F * (corner + farthest(box, views));
}

/// Up to the next of four steps to the double: views near each other have the same lists.
float in_steps(float margin) {
  constexpr float STEPS = 4.0F;
  return margin > 0.0F ? std::exp2(std::ceil(std::log2(margin) * STEPS) / STEPS) : margin;
}

TriangleLists make_lists(const Request& request, const StillInfo& of, std::span<const StillTriangle> triangles,
                         std::uint64_t budget, const StillOccluders* occluders) {
  TriangleListsInfo info{.triangles = triangles, .lights = of.lights, .slack_m = of.margin_m, .budget_bytes = budget};
  if (occluders != nullptr) info.hides = hidden_by(*occluders, of.lights, request.still_occlusion);
  return take(make_triangle_lists(info));
}

WorldTree make_tree(const Request& request, const StillInfo& of, std::uint64_t budget,
                    std::shared_ptr<const StillOccluders> occluders) {
  WorldTreeInfo info{.lights = of.lights, .occluders = std::move(occluders), .budget = budget, .eyes_m = of.margin_m};
  if (request.still_occlusion != 0) info.texels = request.still_occlusion;
  return take(WorldTree::build(info));
}

}  // namespace

std::span<const std::string_view> still_lists_names() { return LISTS; }

std::uint32_t still_kind(const std::string& lists) {
  return static_cast<std::uint32_t>(std::ranges::find(LISTS, lists) - LISTS.begin());
}

void check_still(const Request& request) {
  static_cast<void>(parse_name("--still-lists", request.still_lists, LISTS));
  if (request.still_lists != OFF && request.path == "standard-deferred")
    throw Error(fmt::format("--path standard-deferred: walks no lists, expected another, or no --still-lists {}",
                            request.still_lists));
  if (request.still_lists == OFF && request.still_bytes != Request{}.still_bytes)
    throw Error(
        fmt::format("--still-bytes {}: there are no lists to hold, expected --still-lists triangle-lists or world-tree",
                    request.still_bytes));
  if (request.still_lists == OFF && request.still_occlusion != 0)
    throw Error(
        fmt::format("--still-occlusion {}: there are no lists to leave lights out of, expected --still-lists "
                    "triangle-lists or world-tree",
                    request.still_occlusion));
}

void check_still(const Request& request, const Scene& scene) {
  if (request.still_lists != OFF && scene.captured)
    throw Error(fmt::format("--still-lists {}: the capture {} has no triangles, expected off", request.still_lists,
                            request.scene));
}

bool generated_first(const Request& request) { return request.still > 0.0F || request.still_lists != OFF; }

std::uint32_t still_lights(const Request& request, const Scene& scene, std::size_t generated) {
  if (!generated_first(request)) return 0;
  return static_cast<std::uint32_t>(scene.lights.size()) +
         still_count({.count = static_cast<std::uint32_t>(generated), .still = request.still});
}

std::vector<shared::Light> packed_lights(const Request& request, const Scene& scene, std::span<const Light> generated) {
  if (!generated_first(request)) return packed_lights(scene, generated);
  std::vector<shared::Light> lights = pack(generated);
  const std::vector<shared::Light> of_scene = pack(scene.lights);
  lights.insert(lights.end(), of_scene.begin(), of_scene.end());
  return lights;
}

float still_margin(const Request& request, const Box& scene, std::span<const View> views, const DeviceTraits& traits) {
  return in_steps(still_kind(request.still_lists) == gpu::STILL_TREE ? eyes_of(scene, views)
                                                                     : slack_of(scene, views, traits.sub_pixel_bits));
}

StillSetup make_still(const Request& request, const StillInfo& of) {
  check_still(request, of.scene);
  const auto begin = std::chrono::steady_clock::now();
  StillSetup made{.triangles = still_surfaces(of.scene, of.painted)};
  const bool is_tree = still_kind(request.still_lists) == gpu::STILL_TREE;
  const std::uint64_t budget = request.still_bytes > 0.0F
                                   ? std::max(is_tree ? LEAST_TREE_BYTES : LEAST_BYTES,
                                              static_cast<std::uint64_t>(double{request.still_bytes} *
                                                                         static_cast<double>(made.triangles.size())))
                                   : UINT64_MAX;
  std::shared_ptr<const StillOccluders> occluders;
  if (request.still_occlusion != 0) occluders = std::make_shared<StillOccluders>(still_triangles(of.scene));
  if (is_tree)
    made.tree = make_tree(request, of, budget, std::move(occluders));
  else
    made.lists = make_lists(request, of, made.triangles, budget, occluders.get());
  made.build_ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin).count();
  return made;
}

void add_still_options(CLI::App& command, Request& r) {
  command
      .add_option(
          "--still-lists", r.still_lists,
          "lists made ahead for lights that stand still: off; triangle-lists, by a pixel's triangle; or world-tree, by "
          "its position")
      ->type_name("NAME")
      ->group("Lights")
      ->capture_default_str();
  command
      .add_option("--still-occlusion", r.still_occlusion,
                  "leave still lights out of lists where walls surely hide them: texels a side of the cube with which "
                  "each looks around, such as 32; 0: walls hide nothing")
      ->check(whole_number(0, 1024))
      ->type_name("TEXELS")
      ->group("Lights")
      ->capture_default_str();
}

void add_still_bytes_option(CLI::App& command, Request& r) {
  command
      .add_option(
          "--still-bytes", r.still_bytes,
          "bytes for each triangle that lists of still lights may take, or 1 MiB in all (16 in a tree) where that "
          "is more; 0: without limit")
      ->check(number_between(0.0, 1e9))
      ->type_name("BYTES")
      ->group("Lights")
      ->capture_default_str();
}

}  // namespace lamp::app
