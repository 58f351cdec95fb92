// Reads rays and hits back, and asks the reference and the oracle.
// SPDX-License-Identifier: Apache-2.0
#include "render/mirror_check.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "gpu/check.h"
#include "gpu/transfer.h"
#include "oracle/points.h"
#include "render/scene_occluders.h"

namespace lamp::app {
namespace {

constexpr double NEVER = std::numeric_limits<double>::infinity();
constexpr double SAME_M = 1e-4;        // of the way and a metre: hits so close are one
constexpr double ROUNDING = 1e-5;      // of the way and the distance from the origin: what rays may be off
constexpr double LEAST_COSINE = 1e-3;  // rays that graze more may be off along their way as much as those
constexpr std::uint32_t GROUP_PX = 8;

/// Everything of the frame, row by row.
struct Frame {
  std::vector<gpu::MirrorAsked> rays;
  std::vector<gpu::MirrorHit> hits;
  std::vector<gpu::MirrorSurface> surfaces;
};

template <class T>
std::vector<T> read_back(Renderer& renderer, const vulkan::Buffer& from, std::size_t count) {
  const vulkan::Buffer to = readback_buffer(renderer.device(), "mirror read-back", count * sizeof(T));
  const vulkan::Resource target = vulkan::Resource::storage(to.handle());
  renderer.also([&](vulkan::Recorder& recorder) {
    recorder.barrier({copies_from(vulkan::Resource::storage(from.handle())), copies_to(target)});
    const VkBufferCopy all{.size = count * sizeof(T)};
    vkCmdCopyBuffer(recorder.commands(), from.handle(), to.handle(), 1, &all);
    recorder.barrier({host_reads(target)});
  });
  renderer.forget(to);
  return first_values<T>(to, count);
}

std::vector<gpu::MirrorAsked> read_rays(Renderer& renderer, const ShaderLibrary& shaders) {
  constexpr VkPipelineStageFlags2 COMPUTE = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  const Targets& targets = renderer.targets();
  const std::size_t pixels = std::size_t{targets.width} * targets.height;
  const vulkan::Buffer rays = readback_buffer(renderer.device(), "mirror rays", pixels * sizeof(gpu::MirrorAsked));
  const vulkan::Resource written = vulkan::Resource::storage(rays.handle());
  std::vector<vulkan::Bound> bound = gbuffer_bound(targets);
  bound.push_back({0, renderer.data().frame_constants()});
  std::vector<vulkan::Use> uses;
  for (const vulkan::Bound& b : bound) uses.push_back(reads(b.resource, COMPUTE));
  uses.push_back({.resource = written, .stages = COMPUTE, .access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT});
  bound.push_back({2, written});
  vulkan::PipelineInfo info{.name = "mirror rays"};
  for (const vulkan::Bound& b : bound) info.bindings.push_back({b.binding, b.resource.type});
  const vulkan::Pipeline pipeline =
      take(vulkan::Pipeline::compute(renderer.device(), info, shaders.spirv("mirror_rays")));
  renderer.also([&](vulkan::Recorder& recorder) {
    recorder.begin_pass("mirror rays", uses);
    recorder.bind(pipeline, bound);
    vkCmdDispatch(recorder.commands(), (targets.width + GROUP_PX - 1) / GROUP_PX,
                  (targets.height + GROUP_PX - 1) / GROUP_PX, 1);
    recorder.end_pass();
    recorder.barrier({host_reads(written)});
  });
  renderer.forget(rays);
  return first_values<gpu::MirrorAsked>(rays, pixels);
}

/// Rays in double precision that meet what is drawn.
class Reference {
 public:
  explicit Reference(const Scene& scene) : occluders_(scene_occluders(scene)), sides_(drawn_sides(scene)) {
    const Box box = bounds(scene);
    reach_ = glm::length(glm::dvec3(box.max) - glm::dvec3(box.min)) + 1.0;
    farthest_ = glm::length(glm::max(glm::abs(glm::dvec3(box.min)), glm::abs(glm::dvec3(box.max))));
  }

  struct Met {
    double distance = NEVER;  ///< m
    double cosine = 1.0;      ///< of the angle at which the ray comes in
  };
  /// NEVER where nothing is met.
  [[nodiscard]] Met first(const glm::dvec3& origin, const glm::dvec3& direction) const {
    const double length = glm::length(origin) + farthest_ + reach_;
    const Ray ray{.from = origin, .to = origin + direction * length, .first = 1e-18, .last = 1.0};
    // A front may lie on a back, where a mesh is flat.
    const auto hit = occluders_.first_hit(ray, [&](const Hit& met) {
      const DrawnSides& sides = sides_[met.triangle];
      return sides.both || glm::dot(sides.normal, direction) < 0.0;
    });
    if (!hit) return {};
    const glm::dvec3& normal = sides_[hit->triangle].normal;
    return {.distance = hit->at * length, .cosine = std::abs(glm::dot(normal, direction)) / glm::length(normal)};
  }

 private:
  Occluders occluders_;
  std::vector<DrawnSides> sides_;
  double reach_ = 1.0;     ///< m, of the scene
  double farthest_ = 1.0;  ///< m, from the origin
};

bool is_same(double a, double b) {
  if (std::isinf(a) || std::isinf(b)) return a == b;
  return std::abs(a - b) <= SAME_M * (1.0 + std::max(a, b));
}

enum class Answer : std::uint8_t { same, unclear, wrong };

struct Compared {
  Answer answer = Answer::same;
  double expected = NEVER;  ///< m, by the reference
};

/// What the GPU found of a ray.
struct Found {
  double distance = NEVER;  ///< m
  glm::dvec3 at{0.0};       ///< if there is something
};

Found found_at(const Frame& frame, std::size_t pixel) {
  if (frame.hits[pixel].triangle == gpu::MIRROR_SKY) return {};
  const glm::dvec3 at(glm::vec3(frame.surfaces[pixel].position));
  return {.distance = glm::distance(at, glm::dvec3(glm::vec3(frame.rays[pixel].origin))), .at = at};
}

/// Whether the reference, or one that is a little beside it, meets something at the distance that was found. Of a
/// surface that the ray grazes, distances change so much from one to the next that the one through the hit is asked,
/// too: there, the hit may be off the surface as much as it may be off the ray.
Compared compare(const Reference& reference, const gpu::MirrorAsked& ray, const Found& found) {
  const glm::dvec3 origin(glm::vec3(ray.origin));
  const glm::dvec3 direction(glm::vec3(ray.direction));
  const double expected = reference.first(origin, direction).distance;
  if (is_same(expected, found.distance)) return {.answer = Answer::same, .expected = expected};
  const double way = std::min({expected, found.distance, 1e6});
  const double off = ROUNDING * (1.0 + glm::length(origin) + way);
  const Compared unclear{.answer = Answer::unclear, .expected = expected};
  const glm::dvec3 any = std::abs(direction.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
  const glm::dvec3 x = glm::normalize(glm::cross(direction, any));
  const glm::dvec3 y = glm::cross(direction, x);
  for (const glm::dvec3& side : {x, -x, y, -y, x + y, x - y, y - x, -x - y, direction, -direction})
    if (is_same(reference.first(origin + off * side, direction).distance, found.distance)) return unclear;
  const glm::dvec3 to_hit = found.at - origin;
  const double along = glm::dot(to_hit, direction);
  const glm::dvec3 beside = to_hit - along * direction;
  if (!std::isinf(found.distance) && glm::length(beside) <= off) {
    const Reference::Met met = reference.first(origin + beside, direction);
    if (std::abs(met.distance - along) * std::max(met.cosine, LEAST_COSINE) <= off) return unclear;
  }
  return {.answer = Answer::wrong, .expected = expected};
}

std::string words_of(double distance) { return std::isinf(distance) ? "the sky" : fmt::format("{:.6g} m", distance); }

/// Every so many of the pixels that have a ray.
std::vector<std::size_t> chosen_pixels(const Frame& frame, std::size_t most, MirrorFindings& findings) {
  std::vector<std::size_t> all;
  for (std::size_t pixel = 0; pixel < frame.hits.size(); ++pixel)
    if (frame.hits[pixel].triangle != gpu::MIRROR_NO_RAY) all.push_back(pixel);
  findings.rays = all.size();
  const std::size_t step = (all.size() + most - 1) / std::max<std::size_t>(most, 1);
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < all.size(); i += std::max<std::size_t>(step, 1))
    if (frame.hits[all[i]].triangle == gpu::MIRROR_ENDED)
      ++findings.ended;
    else
      chosen.push_back(all[i]);
  return chosen;
}

PointFindings check_lists(Renderer& renderer, const ShaderLibrary& shaders, std::span<const shared::Light> lights,
                          std::span<const glm::vec3> points) {
  PointWalks walks(renderer.context(), shaders, mirror_plan(renderer.device(), renderer.mirrored()->info()),
                   renderer.view(), lights);
  return check_points(walks.walk(points), truth_at(points, lights), lights.size(), order_of(walks.plan()));
}

}  // namespace

Verdict MirrorFindings::verdict() const {
  if (wrong != 0) return Verdict::failed;
  const Verdict of_lists = lists ? lists->verdict() : Verdict::ok;
  return ended != 0 ? std::max(of_lists, Verdict::unchecked) : of_lists;
}

std::string MirrorFindings::reason() const {
  if (wrong != 0)
    return fmt::format("{} mirror rays meet something else than the reference, the first: {}", wrong, first_wrong);
  if (lists && lists->verdict() != Verdict::ok) return "at what mirror rays meet, the list " + lists->reason();
  return ended == 0 ? "" : fmt::format("the device ended the search of {} mirror rays before its end", ended);
}

MirrorFindings check_mirror(Renderer& renderer, const ShaderLibrary& shaders, const Scene& scene,
                            std::span<const shared::Light> lights, std::size_t most) {
  const MirrorPass& mirror = *renderer.mirrored();
  const std::size_t pixels = std::size_t{mirror.info().width} * mirror.info().height;
  const Frame frame{.rays = read_rays(renderer, shaders),
                    .hits = read_back<gpu::MirrorHit>(renderer, mirror.hits(), pixels),
                    .surfaces = read_back<gpu::MirrorSurface>(renderer, mirror.surfaces(), pixels)};
  MirrorFindings findings;
  const std::vector<std::size_t> chosen = chosen_pixels(frame, most, findings);
  findings.checked = chosen.size();
  std::vector<Compared> compared(chosen.size());
  const Reference reference(scene);
  tbb::parallel_for(std::size_t{0}, chosen.size(), [&](std::size_t i) {
    compared[i] = compare(reference, frame.rays[chosen[i]], found_at(frame, chosen[i]));
  });
  std::vector<glm::vec3> points;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const std::size_t pixel = chosen[i];
    if (frame.hits[pixel].triangle != gpu::MIRROR_SKY) points.emplace_back(frame.surfaces[pixel].position);
    findings.unclear += compared[i].answer == Answer::unclear ? 1 : 0;
    if (compared[i].answer != Answer::wrong) continue;
    if (findings.wrong++ == 0)
      findings.first_wrong =
          fmt::format("pixel {}, {}: {}, expected {}", pixel % mirror.info().width, pixel / mirror.info().width,
                      words_of(found_at(frame, pixel).distance), words_of(compared[i].expected));
  }
  findings.hits = points.size();
  if (mirror.info().settings.lists != MirrorLists::brute_force)
    findings.lists = check_lists(renderer, shaders, lights, points);
  return findings;
}

}  // namespace lamp::app
