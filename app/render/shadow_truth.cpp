// Asks the look-up on the GPU and the rays on the CPU.
// SPDX-License-Identifier: Apache-2.0
#include "render/shadow_truth.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <limits>

#include "render/shadow_pairs.h"
#include "render/verification.h"

namespace lamp::app {
namespace {

constexpr std::size_t MOST_PAIRS = 1 << 19;  // five rays each, in a few seconds

constexpr std::size_t ASKED_PAIRS = 1 << 21;   // at once, of the GPU
constexpr std::size_t TRACED_PAIRS = 1 << 14;  // between two reports of progress

/// Keeps one of so many pairs that there are never too many; which ones depends on their order alone.
class Thinned {
 public:
  void add(const gpu::ShadowPair& pair) {
    if (met_++ % stride_ != 0) return;
    pairs_.push_back(pair);
    if (pairs_.size() < MOST_PAIRS) return;
    for (std::size_t i = 0; i < pairs_.size() / 2; ++i) pairs_[i] = pairs_[2 * i];
    pairs_.resize(pairs_.size() / 2);
    stride_ *= 2;
  }
  [[nodiscard]] const std::vector<gpu::ShadowPair>& pairs() const { return pairs_; }
  [[nodiscard]] std::uint64_t stride() const { return stride_; }

 private:
  std::vector<gpu::ShadowPair> pairs_;
  std::uint64_t met_ = 0;
  std::uint64_t stride_ = 1;
};

/// Where the pixel's ray meets the triangle whose depth it has; the depth's own place if there is none so near.
glm::dvec3 on_triangle(const Occluders& occluders, const View& view, std::uint32_t x, std::uint32_t y, float depth) {
  const double z_view = view.z_view(double{depth});
  const auto at = [&](double z) {
    const glm::dvec3 position = view.view_position({x + 0.5, y + 0.5}, z);
    return glm::dvec3(glm::dmat4(view.world_from_view()) * glm::dvec4(position, 1.0));
  };
  const glm::dvec3 place = at(z_view);
  const double largest = std::max({std::abs(place.x), std::abs(place.y), std::abs(place.z)});
  const double off = OFF_OF_DISTANCE * std::abs(z_view) + OFF_OF_COORDINATES * largest;
  glm::dvec3 nearest = place;
  double least = std::numeric_limits<double>::infinity();
  for (const double z : {z_view - off, z_view + off}) {
    const Ray ray{.from = place, .to = at(z)};
    const auto hit = occluders.first_hit(ray);
    if (!hit || hit->at >= least) continue;
    least = hit->at;
    nearest = ray.from + hit->at * (ray.to - ray.from);
  }
  return nearest;
}

enum class Answer : std::uint8_t { arrives, stopped, unclear };

Answer by_ray(const Occluders& occluders, const glm::dvec3& surface, const glm::dvec3& light) {
  const double length = glm::length(light - surface);
  const auto stops = [&](const RayEnd& of) {
    const double end = std::min(of.m / length, of.most);
    return occluders.any_hit({.from = surface, .to = light, .first = end, .last = 1.0 - end});
  };
  const bool first = stops(RAY_END);
  if (first != stops(RAY_SECOND_END)) return Answer::unclear;
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
    return by_ray(occluders, on_triangle(occluders, view, x, y, depth[number]), light);
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

void add(ShadowLight& to, Answer answer, const gpu::ShadowAnswer& said) {
  const double light{said.light};
  const double share{said.share};
  if (answer == Answer::arrives) {
    to.arriving += light;
    to.lost += light * (1.0 - share);
  } else {
    to.stopped += light;
    to.leaked += light * share;
    to.bled += light * std::max(share - double{said.compared}, 0.0);
  }
}

}  // namespace

void ShadowLight::add(const ShadowLight& more) {
  arriving += more.arriving;
  stopped += more.stopped;
  leaked += more.leaked;
  bled += more.bled;
  lost += more.lost;
}

void ShadowFindings::add(const ShadowFindings& more) {
  pairs += more.pairs;
  unclear += more.unclear;
  thinned = std::max(thinned, more.thinned);
  in_shadow += more.in_shadow;
  dark += more.dark;
  cut += more.cut;
  lost += more.lost;
  behind += more.behind;
  cut_behind += more.cut_behind;
  has_meshes = has_meshes || more.has_meshes;
  outside += more.outside;
  lost_outside += more.lost_outside;
  all.add(more.all);
  away.add(more.away);
  beyond.add(more.beyond);
}

bool is_cut(const Renderer& renderer, const Lighting& lighting) {
  const Plan& plan = lighting.runner().plan();
  return renderer.shadows() != nullptr && (plan.binds(INPUT_RADIAL) || plan.binds(INPUT_MESHES));
}

Truth lit_truth(Renderer& renderer, const ShaderLibrary& shaders, const Truth& truth) {
  Truth lit{.first_row = truth.first_row, .rows = truth.rows, .offsets = {0}, .boundary_pairs = truth.boundary_pairs};
  renderer.need_surfaces();
  const std::uint32_t first_pixel = truth.first_row * renderer.view().width();
  std::vector<gpu::ShadowPair> pairs;
  const auto keep_lit = [&](std::uint32_t first, std::uint32_t end) {
    const std::vector<gpu::ShadowAnswer> found = ask_shadows(renderer, shaders, pairs, ShadowAsked::share);
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

ShadowFindings check_shadows(Renderer& renderer, const ShaderLibrary& shaders, const Occluders& occluders,
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
  const std::vector<gpu::ShadowPair>& pairs = thinned.pairs();
  ShadowFindings found{.thinned = thinned.stride(),
                       .has_meshes = renderer.shadows()->reach(ShadowReach::Kind::meshes) != nullptr};
  if (pairs.empty()) return found;
  const std::vector<gpu::ShadowAnswer> looked_up = ask_shadows(renderer, shaders, pairs, ShadowAsked::texels);
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
    const bool is_dark = looked_up[i].share == 0.0F;
    const bool is_cut = looked_up[i].reached == 0;
    const bool is_out = looked_up[i].held == 0;
    found.lost += !is_dark && is_cut ? 1 : 0;
    found.lost_outside += !is_dark && is_out ? 1 : 0;
    if (!(looked_up[i].light > 0.0F)) {
      ++found.behind;
      found.cut_behind += is_cut ? 1 : 0;
      continue;
    }
    ++found.pairs;
    found.dark += is_dark ? 1 : 0;
    found.cut += is_dark && is_cut ? 1 : 0;
    found.outside += is_dark && is_out ? 1 : 0;
    if (answers[i].own == Answer::unclear) {
      ++found.unclear;
      continue;
    }
    found.in_shadow += answers[i].own == Answer::stopped ? 1 : 0;
    add(found.all, answers[i].own, looked_up[i]);
    if (looked_up[i].texels == (answers[i].own == Answer::stopped ? gpu::TEXELS_DARK : gpu::TEXELS_LIT))
      add(found.beyond, answers[i].own, looked_up[i]);
    if (answers[i].away) add(found.away, answers[i].own, looked_up[i]);
  }
  return found;
}

}  // namespace lamp::app
