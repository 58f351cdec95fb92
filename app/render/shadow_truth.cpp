// Asks the look-up on the GPU and the rays on the CPU.
// SPDX-License-Identifier: Apache-2.0
#include "render/shadow_truth.h"

#include <tbb/parallel_for.h>

#include <algorithm>

#include "gpu/check.h"
#include "gpu/transfer.h"
#include "render/scene_occluders.h"
#include "render/verification.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t GROUP = 64;          // threads of shadow_pairs.comp
constexpr std::size_t MOST_PAIRS = 1 << 19;  // five rays each, in a few seconds

constexpr std::size_t ASKED_PAIRS = 1 << 21;   // at once, of the GPU
constexpr std::size_t TRACED_PAIRS = 1 << 14;  // between two reports of progress

struct Pair {
  std::uint32_t pixel = 0;
  std::uint32_t light = 0;
};

/// Keeps one of so many pairs that there are never too many; which ones depends on their order alone.
class Thinned {
 public:
  void add(const Pair& pair) {
    if (met_++ % stride_ != 0) return;
    pairs_.push_back(pair);
    if (pairs_.size() < MOST_PAIRS) return;
    for (std::size_t i = 0; i < pairs_.size() / 2; ++i) pairs_[i] = pairs_[2 * i];
    pairs_.resize(pairs_.size() / 2);
    stride_ *= 2;
  }
  [[nodiscard]] const std::vector<Pair>& pairs() const { return pairs_; }
  [[nodiscard]] std::uint64_t stride() const { return stride_; }

 private:
  std::vector<Pair> pairs_;
  std::uint64_t met_ = 0;
  std::uint64_t stride_ = 1;
};

/// What the GPU says of a pair.
struct LookedUp {
  float light = 0.0F;    ///< without shadows
  float share = 0.0F;    ///< of it, that the filter leaves
  float reached = 0.0F;  ///< 1: the radial bound lets it
  float held = 0.0F;     ///< 1: the light's mesh holds it, or there is none
};

std::vector<LookedUp> ask_look_up(Renderer& renderer, const ShaderLibrary& shaders, const std::vector<Pair>& pairs) {
  if (pairs.empty()) return {};
  constexpr VkPipelineStageFlags2 COMPUTE = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  const Targets& targets = renderer.targets();
  renderer.make_reach(ShadowReach::Kind::radial);
  const vulkan::Buffer* radial = renderer.shadows()->reach(ShadowReach::Kind::radial);
  const vulkan::Buffer asked = upload_buffer(renderer.context(), "pairs of pixel and light", bytes_of(pairs),
                                             VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  const vulkan::Buffer answers = readback_buffer(renderer.device(), "shadow answers", pairs.size() * sizeof(LookedUp));
  const vulkan::Resource written = vulkan::Resource::storage(answers.handle());
  std::vector<vulkan::Bound> bound{{0, renderer.data().frame_constants()},
                                   {1, targets.depth.sampled()},
                                   {2, vulkan::Resource::storage(asked.handle())},
                                   {3, renderer.data().lights()},
                                   {5, targets.base_color.sampled()},
                                   {6, targets.surface.sampled()},
                                   {9, vulkan::Resource::storage(radial->handle())},
                                   {10, renderer.light_meshes()}};
  for (const vulkan::Bound& b : renderer.shadow_bound()) bound.push_back(b);
  std::vector<vulkan::Use> uses;
  for (const vulkan::Bound& b : bound) uses.push_back(reads(b.resource, COMPUTE));
  uses.push_back({.resource = written, .stages = COMPUTE, .access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT});
  bound.push_back({8, written});
  vulkan::PipelineInfo info{.name = "shadow pairs",
                            .constants = {shadow_constant(renderer.shadows()->settings().filter)},
                            .push_constant_bytes = sizeof(std::uint32_t)};
  for (const vulkan::Bound& b : bound) info.bindings.push_back({b.binding, b.resource.type});
  const vulkan::Pipeline pipeline =
      take(vulkan::Pipeline::compute(renderer.device(), info, shaders.spirv("shadow_pairs")));
  const auto count = static_cast<std::uint32_t>(pairs.size());
  renderer.also([&](vulkan::Recorder& recorder) {
    recorder.begin_pass("shadow pairs", uses);
    recorder.bind(pipeline, bound);
    vkCmdPushConstants(recorder.commands(), pipeline.layout(), VK_SHADER_STAGE_ALL, 0, sizeof(count), &count);
    vkCmdDispatch(recorder.commands(), (count + GROUP - 1) / GROUP, 1, 1);
    recorder.end_pass();
    recorder.barrier({host_reads(written)});
  });
  renderer.forget(asked);
  renderer.forget(answers);
  return first_values<LookedUp>(answers, pairs.size());
}

enum class Answer : std::uint8_t { arrives, stopped, unclear };

Answer by_ray(const Occluders& occluders, const glm::dvec3& surface, const glm::dvec3& light) {
  const double length = glm::length(light - surface);
  const auto stops = [&](double end_m) {
    const double end = end_m / length;
    return end < 0.5 && occluders.any_hit({.from = surface, .to = light, .first = end, .last = 1.0 - end});
  };
  const bool first = stops(RAY_END_M);
  if (first != stops(RAY_SECOND_END_M)) return Answer::unclear;
  return first ? Answer::stopped : Answer::arrives;
}

/// What a pair's rays say.
struct Answers {
  Answer own = Answer::unclear;
  bool away = true;  ///< from the edge
};

Answers by_rays(const Occluders& occluders, const View& view, std::span<const float> depth, std::uint32_t pixel,
                const glm::dvec3& light) {
  const auto width = static_cast<int>(view.width());
  const glm::ivec2 at(static_cast<int>(pixel) % width, static_cast<int>(pixel) / width);
  const auto answer = [&](const glm::ivec2& p) {
    const std::size_t number = static_cast<std::size_t>(p.y) * view.width() + static_cast<std::size_t>(p.x);
    const auto x = static_cast<std::uint32_t>(p.x);
    const auto y = static_cast<std::uint32_t>(p.y);
    return by_ray(occluders, view.world_position(x, y, double{depth[number]}), light);
  };
  Answers answers{.own = answer(at)};
  for (const glm::ivec2 step : {glm::ivec2(1, 0), glm::ivec2(-1, 0), glm::ivec2(0, 1), glm::ivec2(0, -1)}) {
    const glm::ivec2 p = at + step * EDGE_PX;
    if (p.x < 0 || p.y < 0 || p.x >= width || p.y >= static_cast<int>(view.height())) continue;
    const float d = depth[static_cast<std::size_t>(p.y) * view.width() + static_cast<std::size_t>(p.x)];
    if (d != view.sky_depth() && answer(p) != answers.own) answers.away = false;
  }
  return answers;
}

void add(ShadowLight& to, Answer answer, double light, double share) {
  if (answer == Answer::arrives) {
    to.arriving += light;
    to.lost += light * (1.0 - share);
  } else {
    to.stopped += light;
    to.leaked += light * share;
  }
}

}  // namespace

bool is_cut(const Renderer& renderer, const Lighting& lighting) {
  const Plan& plan = lighting.runner().plan();
  return renderer.shadows() != nullptr && (plan.binds(INPUT_RADIAL) || plan.binds(INPUT_MESHES));
}

Truth lit_truth(Renderer& renderer, const ShaderLibrary& shaders, const Truth& truth) {
  Truth lit{.first_row = truth.first_row, .rows = truth.rows, .offsets = {0}, .boundary_pairs = truth.boundary_pairs};
  renderer.need_surfaces();
  const std::uint32_t first_pixel = truth.first_row * renderer.view().width();
  std::vector<Pair> pairs;
  const auto keep_lit = [&](std::uint32_t first, std::uint32_t end) {
    const std::vector<LookedUp> found = ask_look_up(renderer, shaders, pairs);
    std::size_t k = 0;
    for (std::uint32_t pixel = first; pixel < end; ++pixel) {
      for (std::uint32_t i = truth.offsets[pixel]; i < truth.offsets[pixel + 1]; ++i, ++k)
        if (found[k].share > 0.0F) lit.lights.push_back(truth.lights[i]);
      lit.offsets.push_back(static_cast<std::uint32_t>(lit.lights.size()));
    }
    pairs.clear();
  };
  std::uint32_t first = 0;
  for (std::uint32_t pixel = 0; pixel + 1 < truth.offsets.size(); ++pixel) {
    for (std::uint32_t i = truth.offsets[pixel]; i < truth.offsets[pixel + 1]; ++i)
      pairs.push_back({.pixel = first_pixel + pixel, .light = truth.lights[i]});
    if (pairs.size() < ASKED_PAIRS && pixel + 2 < truth.offsets.size()) continue;
    keep_lit(first, pixel + 1);
    first = pixel + 1;
  }
  return lit;
}

ShadowFindings check_shadows(Renderer& renderer, const ShaderLibrary& shaders, const Scene& scene,
                             std::span<const shared::Light> lights, const ShadowProgress& progress) {
  renderer.need_surfaces();
  const View& view = renderer.view();
  const std::vector<float> depth = renderer.read_depth();
  Thinned thinned;
  for_each_truth({.view = view, .depth = depth, .lights = lights, .rows = view.height()}, [&](const Truth& truth) {
    const std::uint32_t first = truth.first_row * view.width();
    for (std::uint32_t i = 0; i + 1 < truth.offsets.size(); ++i)
      for (std::uint32_t k = truth.offsets[i]; k < truth.offsets[i + 1]; ++k)
        thinned.add({.pixel = first + i, .light = truth.lights[k]});
    if (progress)
      progress("pairs of pixel and light", static_cast<double>(truth.first_row + truth.rows) / view.height());
  });
  const std::vector<Pair>& pairs = thinned.pairs();
  ShadowFindings found{.thinned = thinned.stride(),
                       .has_meshes = renderer.shadows()->reach(ShadowReach::Kind::meshes) != nullptr};
  if (pairs.empty()) return found;
  const std::vector<LookedUp> looked_up = ask_look_up(renderer, shaders, pairs);
  const Occluders occluders = scene_occluders(scene);
  std::vector<Answers> answers(pairs.size());
  for (std::size_t first = 0; first < pairs.size(); first += TRACED_PAIRS) {
    const std::size_t end = std::min(first + TRACED_PAIRS, pairs.size());
    tbb::parallel_for(first, end, [&](std::size_t i) {
      if (looked_up[i].light > 0.0F)
        answers[i] = by_rays(occluders, view, depth, pairs[i].pixel, glm::dvec3(lights[pairs[i].light].position));
    });
    if (progress) progress("rays", static_cast<double>(end) / static_cast<double>(pairs.size()));
  }
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const double light = double{looked_up[i].light};
    if (!(light > 0.0)) continue;  // it faces away
    ++found.pairs;
    const bool is_dark = looked_up[i].share == 0.0F;
    const bool is_cut = looked_up[i].reached == 0.0F;
    found.dark += is_dark ? 1 : 0;
    found.cut += is_dark && is_cut ? 1 : 0;
    found.lost += !is_dark && is_cut ? 1 : 0;
    const bool is_out = looked_up[i].held == 0.0F;
    found.outside += is_dark && is_out ? 1 : 0;
    found.lost_outside += !is_dark && is_out ? 1 : 0;
    if (answers[i].own == Answer::unclear) {
      ++found.unclear;
      continue;
    }
    found.in_shadow += answers[i].own == Answer::stopped ? 1 : 0;
    add(found.all, answers[i].own, light, double{looked_up[i].share});
    if (answers[i].away) add(found.away, answers[i].own, light, double{looked_up[i].share});
  }
  return found;
}

}  // namespace lamp::app
