// Reads rays and hits back, and asks the reference and the oracle.
// SPDX-License-Identifier: Apache-2.0
#include "render/mirror_check.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "gpu/transfer.h"
#include "oracle/points.h"
#include "render/answers.h"

namespace lamp::app {
namespace {

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
  const Targets& targets = renderer.targets();
  AnswersPass pass{.shader = "mirror_rays",
                   .bound = gbuffer_bound(targets),
                   .answers_at = 2,
                   .groups = (glm::uvec2(targets.width, targets.height) + GROUP_PX - 1U) / GROUP_PX};
  pass.bound.push_back({0, renderer.data().frame_constants()});
  return answers_of<gpu::MirrorAsked>(renderer, shaders, std::move(pass), std::size_t{targets.width} * targets.height);
}

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

void MirrorFindings::add(const MirrorFindings& more) {
  if (wrong == 0) first_wrong = more.first_wrong;
  if (lists && more.lists) lists->add(*more.lists, hits);
  if (!lists) lists = more.lists;
  rays += more.rays;
  checked += more.checked;
  hits += more.hits;
  wrong += more.wrong;
  unclear += more.unclear;
  ended += more.ended;
}

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

MirrorReference mirror_reference(const Renderer& renderer, const Scene& scene) {
  const MirrorScene& traced = renderer.mirrored()->scene();
  return {scene, traced.bvh(), traced.first_levels()};
}

MirrorFindings check_mirror(Renderer& renderer, const ShaderLibrary& shaders, const MirrorReference& reference,
                            std::span<const shared::Light> lights, std::size_t most) {
  const MirrorPass& mirror = *renderer.mirrored();
  const std::size_t pixels = std::size_t{mirror.info().width} * mirror.info().height;
  const Frame frame{.rays = read_rays(renderer, shaders),
                    .hits = read_back<gpu::MirrorHit>(renderer, mirror.hits(), pixels),
                    .surfaces = read_back<gpu::MirrorSurface>(renderer, mirror.surfaces(), pixels)};
  MirrorFindings findings;
  const std::vector<std::size_t> chosen = chosen_pixels(frame, most, findings);
  findings.checked = chosen.size();
  std::vector<MirrorCompared> compared(chosen.size());
  tbb::parallel_for(std::size_t{0}, chosen.size(), [&](std::size_t i) {
    const std::size_t pixel = chosen[i];
    compared[i] = reference.compare(frame.rays[pixel], frame.hits[pixel], glm::vec3(frame.surfaces[pixel].position));
  });
  std::vector<glm::vec3> points;
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    const std::size_t pixel = chosen[i];
    if (frame.hits[pixel].triangle != gpu::MIRROR_SKY) points.emplace_back(frame.surfaces[pixel].position);
    findings.unclear += compared[i].answer == MirrorAnswer::unclear ? 1 : 0;
    if (compared[i].answer != MirrorAnswer::wrong) continue;
    if (findings.wrong++ == 0)
      findings.first_wrong =
          words_of(renderer.shown(), renderer.depth()) +
          fmt::format("pixel {}, {}: {}", pixel % mirror.info().width, pixel / mirror.info().width, compared[i].fault);
  }
  findings.hits = points.size();
  if (mirror.info().settings.lists != MirrorLists::brute_force)
    findings.lists = check_lists(renderer, shaders, lights, points);
  return findings;
}

}  // namespace lamp::app
