// Reads pixels' triangles, walks lists on the device and on the host, and asks the oracle.
// SPDX-License-Identifier: Apache-2.0
#include "render/still_check.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "gpu/check.h"
#include "gpu/transfer.h"
#include "oracle/points.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t WALK_GROUP = 64;  // threads of still_walk
// Of a ray's length: where it ends before its point, so that it does not meet the point's own surface. Half of what a
// hidden point lies behind its occluder at least (OcclusionMap).
constexpr double RAY_END = 1.0 - 0.5 * OcclusionMap::HIDDEN_BEYOND;

gpu::StillWalk walk_of(std::span<const std::uint32_t> list) {
  gpu::StillWalk walk{.lights = static_cast<std::uint32_t>(list.size()), .hash = gpu::STILL_HASH_FIRST};
  for (const std::uint32_t light : list) walk.hash = (walk.hash ^ light) * gpu::STILL_HASH_TIMES;
  return walk;
}

/// The weights of the second and the third corner at a position, as if it lay in the triangle's plane. Of a triangle
/// that is hardly wider than a line they say nothing.
std::optional<glm::dvec2> weights_at(const StillTriangle& triangle, const glm::dvec3& position) {
  constexpr double THIN = 1e-8;  // square of a sine
  const glm::dvec3 a(triangle.corners[0]);
  const glm::dvec3 u = glm::dvec3(triangle.corners[1]) - a;
  const glm::dvec3 v = glm::dvec3(triangle.corners[2]) - a;
  const glm::dvec3 p = position - a;
  const double uv = glm::dot(u, v);
  const double determinant = glm::dot(u, u) * glm::dot(v, v) - uv * uv;
  if (!(determinant > THIN * glm::dot(u, u) * glm::dot(v, v))) return std::nullopt;
  return glm::dvec2(glm::dot(v, v) * glm::dot(u, p) - uv * glm::dot(v, p),
                    glm::dot(u, u) * glm::dot(v, p) - uv * glm::dot(u, p)) /
         determinant;
}

/// Whether the normal that shading has at the position may see the light. Where nothing tells which of a triangle's
/// normals that is, whether all do.
bool may_face(const StillTriangle& triangle, const glm::dvec3& position, const glm::dvec3& light) {
  if (triangle.normal_tilt >= 1.57F) return true;
  const glm::dvec3 to_light = light - position;
  const double least = -std::sin(double{triangle.normal_tilt}) * glm::length(to_light);
  const auto sees = [&](const glm::dvec3& normal) { return glm::dot(to_light, normal) > least * glm::length(normal); };
  const std::optional<glm::dvec2> weights = weights_at(triangle, position);
  if (!weights)
    return std::ranges::all_of(triangle.normals, [&](const auto& normal) { return sees(glm::dvec3(normal)); });
  const glm::dvec2 w = glm::clamp(*weights, glm::dvec2(0.0), glm::dvec2(1.0));
  return sees(glm::dvec3(triangle.normals[0]) * (1.0 - w.x - w.y) + glm::dvec3(triangle.normals[1]) * w.x +
              glm::dvec3(triangle.normals[2]) * w.y);
}

/// Of one point.
struct Met {
  std::vector<std::uint32_t> list;
  std::uint64_t lighting = 0;
  std::vector<std::uint32_t> missed;
};

Met meet(const StillCheck& check, const gpu::StillPoint& point, std::span<const std::uint32_t> reaching) {
  Met met{.list = check.list(point)};
  const glm::dvec3 position(point.position);
  for (const std::uint32_t light : reaching) {
    const glm::dvec3 from(check.lights[light].position);
    if (!check.triangles.empty() && !may_face(check.triangles[point.triangle], position, from)) continue;
    if (check.occluders != nullptr && check.occluders->any_hit({.from = from, .to = position, .last = RAY_END}))
      continue;
    ++met.lighting;
    if (!std::ranges::binary_search(met.list, light)) met.missed.push_back(light);
  }
  return met;
}

}  // namespace

Verdict StillFindings::verdict() const {
  return missed != 0 || unordered != 0 || differing != 0 ? Verdict::failed : Verdict::ok;
}

std::vector<gpu::StillPoint> pixel_points(Renderer& renderer) {
  renderer.need_surfaces();
  const std::vector<float> depth = renderer.read_depth();
  const std::vector<std::uint32_t> triangles =
      renderer.targets().numbered ? renderer.read_triangles() : std::vector<std::uint32_t>(depth.size(), NO_TRIANGLE);
  const View& view = renderer.view();
  std::vector<gpu::StillPoint> points;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const bool sky = depth[i] == renderer.depth().sky();
    const DVec3 position(view.world_position(i % view.width(), i / view.width(), depth[i]));
    points.push_back({.position = sky ? Vec3{} : Vec3(position), .triangle = sky ? NO_TRIANGLE : triangles[i]});
  }
  return points;
}

std::vector<gpu::StillPoint> points_of_pixels(Renderer& renderer) {
  const std::vector<gpu::StillPoint> all = pixel_points(renderer);
  const std::vector<float> depth = renderer.read_depth();
  std::vector<gpu::StillPoint> points;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (depth[i] != renderer.depth().sky()) points.push_back(all[i]);
  return points;
}

std::vector<gpu::StillPoint> random_points_on(std::span<const StillTriangle> triangles, std::size_t count,
                                              std::uint64_t seed) {
  std::vector<double> areas;
  double sum = 0.0;
  for (const StillTriangle& t : triangles) {
    const glm::dvec3 a(t.corners[0]);
    sum += glm::length(glm::cross(glm::dvec3(t.corners[1]) - a, glm::dvec3(t.corners[2]) - a));
    areas.push_back(sum);
  }
  std::mt19937_64 engine(seed);
  const auto unit = [&] { return static_cast<double>(engine() >> 11) * 0x1p-53; };
  std::vector<gpu::StillPoint> points;
  for (std::size_t i = 0; i < count && sum > 0.0; ++i) {
    // Every other point by area, the others of any triangle: small ones are triangles too.
    const auto by_area = std::ranges::upper_bound(areas, unit() * sum) - areas.begin();
    const auto any = static_cast<std::ptrdiff_t>(unit() * static_cast<double>(areas.size()));
    const auto triangle =
        static_cast<std::uint32_t>(std::min(i % 2 == 0 ? by_area : any, static_cast<std::ptrdiff_t>(areas.size()) - 1));
    glm::dvec2 w(unit(), unit());
    if (w.x + w.y > 1.0) w = 1.0 - w;
    const StillTriangle& t = triangles[triangle];
    const glm::dvec3 a(t.corners[0]);
    const glm::dvec3 at = a + w.x * (glm::dvec3(t.corners[1]) - a) + w.y * (glm::dvec3(t.corners[2]) - a);
    points.push_back({.position = Vec3(glm::vec3(at)), .triangle = triangle});
  }
  return points;
}

std::vector<gpu::StillWalk> walk_still_points(Context& context, std::span<const std::uint32_t> spirv,
                                              const StillLists& lists, std::span<const gpu::StillPoint> points) {
  constexpr VkPipelineStageFlags2 COMPUTE = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  const vulkan::Device& device = context.device();
  const vulkan::Pipeline pipeline = take(vulkan::Pipeline::compute(device,
                                                                   {.name = "still walk",
                                                                    .constants = {{CONSTANT_STILL, lists.kind()}},
                                                                    .bindings = {{0}, {1}, {BINDING_STILL}},
                                                                    .push_constant_bytes = sizeof(std::uint32_t)},
                                                                   spirv));
  const vulkan::Buffer from =
      upload_buffer(context, "still points", std::as_bytes(points), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  const vulkan::Buffer to = readback_buffer(device, "still walks", points.size() * sizeof(gpu::StillWalk));
  const vulkan::Resource read = vulkan::Resource::storage(from.handle());
  const vulkan::Resource written = vulkan::Resource::storage(to.handle());
  const auto count = static_cast<std::uint32_t>(points.size());
  vulkan::AccessTracker tracker;
  context.submit([&](VkCommandBuffer commands) {
    vulkan::Recorder recorder(device, commands, tracker);
    recorder.begin_pass("still walk",
                        {reads(read, COMPUTE),
                         reads(lists.words(), COMPUTE),
                         {.resource = written, .stages = COMPUTE, .access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT}});
    const std::vector<vulkan::Bound> bound{{0, read}, {1, written}, {BINDING_STILL, lists.words()}};
    recorder.bind(pipeline, bound);
    vkCmdPushConstants(commands, pipeline.layout(), VK_SHADER_STAGE_ALL, 0, sizeof(count), &count);
    vkCmdDispatch(commands, (count + WALK_GROUP - 1) / WALK_GROUP, 1, 1);
    recorder.end_pass();
    recorder.barrier({host_reads(written)});
  });
  return first_values<gpu::StillWalk>(to, points.size());
}

StillFindings check_still_points(const StillCheck& check, std::span<const gpu::StillPoint> points) {
  StillFindings findings{.points = points.size()};
  if (points.empty()) return findings;
  std::vector<glm::vec3> positions;
  for (const gpu::StillPoint& point : points) positions.emplace_back(point.position);
  const PointTruth truth = truth_at(positions, check.lights);
  findings.boundary_pairs = truth.boundary_pairs;
  const std::vector<gpu::StillWalk> walks =
      walk_still_points(check.context, check.shaders.spirv("still_walk"), check.on_gpu, points);
  std::vector<Met> met(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(),
                    [&](std::size_t i) { met[i] = meet(check, points[i], truth.of(i)); });
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::vector<std::uint32_t>& list = met[i].list;
    const gpu::StillWalk expected = walk_of(list);
    findings.walked += list.size();
    findings.reaching += truth.of(i).size();
    findings.lighting += met[i].lighting;
    findings.longest = std::max<std::uint64_t>(findings.longest, list.size());
    findings.unordered += std::ranges::is_sorted(list, std::less_equal{}) ? 0 : 1;
    findings.differing += walks[i].lights == expected.lights && walks[i].hash == expected.hash ? 0 : 1;
    if (findings.missed == 0 && !met[i].missed.empty())
      findings.first_miss =
          fmt::format("point ({}, {}, {}) of triangle {}: light {}", points[i].position.x, points[i].position.y,
                      points[i].position.z, points[i].triangle, met[i].missed.front());
    findings.missed += met[i].missed.size();
  }
  return findings;
}

}  // namespace lamp::app
