// Shifts projections and averages pictures.
// SPDX-License-Identifier: Apache-2.0
#include "render/antialias.h"

#include <utility>
#include <vector>

#include "gpu/check.h"

namespace lamp::app {
namespace {

/// The digits of i in a base, mirrored behind the point: 0 <= result < 1.
double radical_inverse(std::uint32_t i, std::uint32_t base) {
  double inverse = 0.0;
  for (double place = 1.0 / base; i != 0; i /= base, place /= base) inverse += place * (i % base);
  return inverse;
}

/// To nothing at first.
void add(HdrImage& sum, HdrImage image) {
  for (std::size_t p = 0; p < sum.pixels.size(); ++p) image.pixels[p] += sum.pixels[p];
  sum = std::move(image);
}

}  // namespace

glm::dvec2 sample_offset(std::uint32_t i) {
  if (i == 0) return glm::dvec2(0.0);
  // Halton's first point has x = 1/2, the centre's column; the points from the second on lie beside it.
  return {radical_inverse(i + 1, 2) - 0.5, radical_inverse(i + 1, 3) - 0.5};
}

View shifted(const View& view, glm::dvec2 offset_px) {
  glm::dmat4 clip_from_view = view.clip_from_view();
  const glm::dvec2 offset_ndc = 2.0 * offset_px / glm::dvec2(view.width(), view.height());
  for (int column = 0; column < 4; ++column) {
    clip_from_view[column].x -= offset_ndc.x * clip_from_view[column].w;
    clip_from_view[column].y -= offset_ndc.y * clip_from_view[column].w;
  }
  return take(View::create(view.width(), view.height(), clip_from_view, view.view_from_world()));
}

Rendered render_samples(Renderer& renderer, Lighting& lighting, std::span<const shared::Light> lights,
                        std::span<const gpu::DecalData> decals, const Sampling& sampling) {
  const std::vector<View> views = renderer.views();
  const std::uint32_t shown = renderer.shown().view;
  const std::uint32_t of_depth = renderer.depth().samples;
  const std::uint32_t samples = of_depth > 1 ? of_depth : sampling.samples;
  const auto turn_to = [&](std::uint32_t i) {
    if (of_depth > 1) return renderer.show({shown, i});
    if (samples == 1) return;
    std::vector<View> beside;
    for (const View& view : views) beside.push_back(shifted(view, sample_offset(i)));
    renderer.set_views(beside, lights, decals);
    renderer.show({.view = shown});
  };
  const Shadows::Pending pending = renderer.pending_shadows();
  HdrImage sum;
  for (std::uint32_t i = 1; i < samples; ++i) {
    turn_to(i);
    if (sampling.progress) sampling.progress(i);
    add(sum, renderer.render(lighting).image);
  }
  turn_to(0);
  renderer.set_pending_shadows(pending);
  Rendered rendered = renderer.render(lighting, sampling.frames, sampling.warm_up);
  add(sum, std::move(rendered.image));
  for (glm::vec4& pixel : sum.pixels) pixel /= static_cast<float>(samples);
  rendered.image = std::move(sum);
  return rendered;
}

Rendered render_views(Renderer& renderer, Lighting& lighting, std::span<const shared::Light> lights,
                      std::span<const gpu::DecalData> decals, const Sampling& sampling) {
  if (renderer.depth().views == 1) return render_samples(renderer, lighting, lights, decals, sampling);
  const Shadows::Pending pending = renderer.pending_shadows();
  std::vector<HdrImage> pictures(renderer.depth().views);
  for (std::uint32_t view = renderer.depth().views; --view != 0;) {
    renderer.show({.view = view});
    pictures[view] =
        render_samples(renderer, lighting, lights, decals, {.samples = sampling.samples, .progress = sampling.progress})
            .image;
  }
  renderer.show({});
  renderer.set_pending_shadows(pending);
  Rendered rendered = render_samples(renderer, lighting, lights, decals, sampling);
  pictures.front() = std::move(rendered.image);
  rendered.image = side_by_side(pictures);
  return rendered;
}

}  // namespace lamp::app
