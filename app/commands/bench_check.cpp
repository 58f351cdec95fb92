// Checks outputs; what is wrong gets its reason in one line.
// SPDX-License-Identifier: Apache-2.0
#include "commands/bench_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "gpu/check.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t ALIGNED_PX = 32;  // the largest tile: a band that cuts tiles would judge their lists by a part

/// The rows to check: all, or a band in the middle.
Rows checked_rows(const Verify& verify, std::uint32_t height) {
  if (verify.what != Verify::What::rows || verify.rows >= height) return {0, height};
  const std::uint32_t first = (height - verify.rows) / 2 / ALIGNED_PX * ALIGNED_PX;
  return {first, std::min(verify.rows, height - first)};
}

HdrImage cropped(const HdrImage& image, const Rows& rows) {
  const auto begin = image.pixels.begin() + static_cast<std::ptrdiff_t>(std::size_t{rows.first} * image.width);
  return {image.width, rows.count, {begin, begin + static_cast<std::ptrdiff_t>(std::size_t{rows.count} * image.width)}};
}

/// Truths of the rows, in bands whose lists fit a buffer of the device.
std::vector<Truth> truths_of(const BenchFrame& frame, std::span<const float> depth, const Rows& rows,
                             std::uint64_t max_buffer_bytes) {
  std::vector<Truth> truths;
  constexpr std::uint64_t BAND_PIXELS = 1U << 19;
  auto step = static_cast<std::uint32_t>(std::max<std::uint64_t>(1, BAND_PIXELS / frame.view.width()));
  for (std::uint32_t row = rows.first; row < rows.first + rows.count;) {
    step = std::min(step, rows.first + rows.count - row);
    Truth band = truth({.view = frame.view, .depth = depth, .lights = frame.lights, .first_row = row, .rows = step});
    if (band.lights.size() * sizeof(std::uint32_t) > max_buffer_bytes && step > 1) {
      step = (step + 1) / 2;
      continue;
    }
    row += step;
    truths.push_back(std::move(band));
  }
  return truths;
}

}  // namespace

LightingInfo lighting_info(const BenchScene& scene, const Group& group, const GroupEntry& entry) {
  const Method& method = parse_method(entry.method);
  const glm::uvec2 size = parse_size(group.size);
  return {.method = &method,
          .options = take(resolve_options(method, entry.options)),
          .width = size.x,
          .height = size.y,
          .light_capacity = light_capacity(scene, group),
          .path = parse_path(entry.path),
          .brdf = parse_brdf(group.brdf),
          .transparency = !scene.gpu->blended().empty(),
          .captured = scene.scene.captured.has_value()};
}

Checker::Checker(BenchDevice& device, const Group& group, Renderer& renderer, const BenchFrame& frame)
    : device_(device),
      group_(group),
      renderer_(renderer),
      frame_(frame),
      rows_(checked_rows(group.verify, frame.view.height())) {
  renderer_.set_frame(frame.view, frame.lights);
}

void Checker::need_truths() {
  if (group_.verify.verifier == Verifier::gpu) {
    if (!verifier_) verifier_.emplace(renderer_, frame_.lights, group_.verify.every_list ? Rows{} : rows_);
  } else if (truths_.empty()) {
    truths_ =
        truths_of(frame_, renderer_.read_depth(), rows_, device_.context().device().traits.max_storage_buffer_bytes);
  }
}

const HdrImage& Checker::reference(ShadingPath path) {
  const bool forward = path == ShadingPath::forward;
  std::optional<HdrImage>& image = forward ? forward_ : deferred_;
  if (!image) {
    LightingInfo info =
        lighting_info(device_.scene(group_.scene), group_, {.method = "all", .path = forward ? "forward" : "deferred"});
    info.shaded = rows_;
    Lighting lighting(device_.context().device(), device_.shaders(), info);
    image = cropped(renderer_.render(lighting).image, rows_);
  }
  return *image;
}

Findings Checker::find(Lighting& lighting) {
  const auto which = lighting.fused() ? vulkan::PlanRunner::Passes::fused : vulkan::PlanRunner::Passes::separate;
  if (verifier_) return verifier_->check(lighting, which);
  Verification verification(frame_.view.width());
  for (const Truth& truth : truths_) verification.add(truth, renderer_.visit(lighting, truth, which));
  return verification.findings();
}

std::string Checker::fault(const Lighting& lighting, const Plan& plan, const Checked& checked) {
  if (checked.findings && checked.findings->missed != 0)
    return fmt::format("misses {} pairs of pixel and light, the first: {}", checked.findings->missed,
                       checked.findings->first_miss);
  if (checked.findings && checked.findings->repeated != 0)
    return fmt::format("walks {} lights again at a pixel that they reach", checked.findings->repeated);
  if (checked.findings && plan.ordered && checked.findings->unordered) return "a list does not ascend";
  if (!checked.difference) return "";
  const bool ascending = plan.ordered && lighting.info().path != ShadingPath::standard_deferred;
  const float allowed =
      ascending ? 0.0F : UNORDERED_TOLERANCE * (1.0F + largest_value(reference(lighting.info().path)));
  if (*checked.difference <= allowed) return "";
  return fmt::format("the picture differs from brute force by {:.3g}, allowed {:.3g}", *checked.difference, allowed);
}

Checked Checker::check(Lighting& lighting) {
  Checked checked{.verdict = "unverified", .reason = group_.unchecked, .rendered = renderer_.render(lighting)};
  if (group_.verify.what == Verify::What::nothing) return checked;
  const bool by_volumes = lighting.info().path == ShadingPath::standard_deferred;
  if (by_volumes && !group_.verify.compares_pictures) return checked;
  need_truths();
  if (!by_volumes) checked.findings = find(lighting);
  if (group_.verify.compares_pictures)
    checked.difference = max_abs_difference(cropped(checked.rendered.image, rows_), reference(lighting.info().path));
  const Plan& plan = lighting.runner().plan();
  checked.verdict = plan.approximate && !by_volumes ? "approximate" : "exact";
  if (checked.verdict == "approximate") return checked;
  if (std::string why = fault(lighting, plan, checked); !why.empty()) {
    checked.verdict = "wrong";
    checked.reason = std::move(why);
  }
  return checked;
}

}  // namespace lamp::app
