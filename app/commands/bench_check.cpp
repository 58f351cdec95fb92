// Checks outputs; what is wrong gets its reason in one line.
// SPDX-License-Identifier: Apache-2.0
#include "commands/bench_check.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>

#include "commands/verify_boxes.h"
#include "gpu/check.h"
#include "render/antialias.h"
#include "render/box_shapes.h"
#include "render/shadow_truth.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t ALIGNED_PX = 32;  // the largest tile: a band that cuts tiles would judge their lists by a part

// Of truths that are kept from entry to entry: 2 GiB. Longer ones are made again for each.
constexpr std::uint64_t KEPT_LIGHTS = 1U << 29;

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

std::optional<ShadowFilter> filter_of(const std::optional<ShadowSettings>& shadows) {
  if (!shadows) return std::nullopt;
  return shadows->filter;
}

}  // namespace

LightingInfo lighting_info(const BenchScene& scene, const Group& group, const GroupEntry& entry) {
  const Method& method = parse_method(entry.name);
  const glm::uvec2 size = parse_size(group.size);
  const bool listed = entry.still_lists != "off";
  return {.method = &method,
          .options = take(resolve_options(method, with_box_shapes(method, entry.options, scene.boxes() != 0))),
          .width = group.stereo_m > 0.0 ? size.x / 2 : size.x,
          .height = size.y,
          .light_capacity = light_capacity(scene, group) - (listed ? standing_lights(scene, group) : 0) +
                            static_cast<std::uint32_t>(scene.boxes()),
          .path = parse_path(entry.path),
          .brdf = parse_brdf(group.brdf),
          .depth = host_depth_of(group),
          .host = entry.host,
          .transparency = !scene.gpu->blended().empty(),
          .captured = scene.scene.captured.has_value(),
          .decals = !scene.decals.empty(),
          .probes = scene.probes.empty() ? gpu::PROBES_OFF : gpu::PROBES_FLAT,
          .mirror = static_cast<float>(group.mirror),
          .shadows = filter_of(shadows_of(group, scene.scene)),
          .still = still_kind(entry.still_lists)};
}

Checker::Checker(BenchDevice& device, const Group& group, Renderer& renderer, const BenchFrame& frame)
    : device_(device),
      group_(group),
      renderer_(renderer),
      frame_(frame),
      rows_(checked_rows(group.verify, frame.view().height())) {
  renderer_.set_frame(frame.views, frame.lights, frame.decals);
}

void Checker::show(const StillLists* still) {
  if (still == shown_) return renderer_.set_views(frame_.views, frame_.lights, frame_.decals);
  renderer_.restart_shadows();  // of a first frame for every lighting, whatever a budget left to be drawn
  renderer_.light_still(still);
  shown_ = still;
  renderer_.set_frame(frame_.views, frame_.lights, frame_.decals);
}

void Checker::need_truths() {
  if (group_.verify.verifier == Verifier::gpu) {
    if (!verifier_) verifier_.emplace(renderer_, frame_.lights, group_.verify.every_list ? Rows{} : rows_);
  } else if (depths_.empty()) {
    const std::vector<FramePicture> pictures = renderer_.all_pictures();
    truths_.resize(pictures.size());
    for (const FramePicture& picture : pictures) {
      renderer_.show(picture);
      depths_.push_back(renderer_.depth().several() ? renderer_.draw_depth() : renderer_.read_depth());
    }
  }
}

void Checker::for_each_truth(std::size_t picture, const std::function<void(const Truth&)>& use) {
  for (const Truth& truth : truths_[picture]) use(truth);
  if (!truths_[picture].empty()) return;
  std::uint64_t lights = 0;
  std::vector<Truth> kept;
  lamp::app::for_each_truth({.view = renderer_.view(),
                             .depth = depths_[picture],
                             .lights = frame_.lights,
                             .first_row = rows_.first,
                             .rows = rows_.count},
                            [&](const Truth& truth) {
                              use(truth);
                              lights += truth.lights.size();
                              if (lights <= KEPT_LIGHTS / depths_.size()) kept.push_back(truth);
                            });
  if (lights <= KEPT_LIGHTS / depths_.size()) truths_[picture] = std::move(kept);
}

const HdrImage& Checker::reference(ShadingPath path) {
  const bool forward = path == ShadingPath::forward;
  std::optional<HdrImage>& image = forward ? forward_ : deferred_;
  if (!image) {
    LightingInfo info =
        lighting_info(device_.scene(group_), group_, {{.name = "all", .path = forward ? "forward" : "deferred"}});
    info.shaded = rows_;
    const StillLists* still = renderer_.still();
    show(nullptr);
    Lighting lighting(device_.context().device(), device_.shaders(), info);
    image = cropped(render_views(renderer_, lighting, frame_.lights, frame_.decals, {}).image, rows_);
    show(still);
  }
  return *image;
}

Findings Checker::find(Lighting& lighting) {
  const auto which = lighting.fused() ? vulkan::PlanRunner::Passes::fused : vulkan::PlanRunner::Passes::separate;
  if (verifier_) return verifier_->check(lighting, which);
  const bool cut = is_cut(renderer_, lighting);
  Verification verification(frame_.view().width(), renderer_.depth());
  const std::vector<FramePicture> pictures = renderer_.all_pictures();  // the first last: it is timed
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    renderer_.show(pictures[i]);
    for_each_truth(i, [&](const Truth& all) {
      const Truth truth = cut ? lit_truth(renderer_, device_.shaders(), all) : all;
      verification.add(truth, renderer_.visit(lighting, truth, which), pictures[i]);
    });
  }
  return verification.findings();
}

Findings Checker::find_boxes(Lighting& lighting, Renderer::Kind kind) {
  const BenchScene& scene = device_.scene(group_);
  BoxCheck check(kind, frame_.view().width(), renderer_.depth());
  const std::pair<Lighting*, BoxCheck*> only{&lighting, &check};
  const std::vector<FramePicture> pictures = renderer_.all_pictures();
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    renderer_.show(pictures[i]);
    check_boxes_of(renderer_, {scene.decals, scene.probes}, depths_[i], rows_, {&only, 1});
  }
  return check.findings(lighting);
}

Judgement Checker::judge_output(const Lighting& lighting, const Checked& checked) {
  Plan plan = lighting.runner().plan();
  if (!checked.findings && lighting.info().still == gpu::STILL_OFF)
    plan.ordered = plan.approximate = false;  // light volumes: no lists
  std::optional<PictureDifference> difference;
  if (checked.difference)
    difference = {.max_abs = *checked.difference,
                  .tolerance = picture_tolerance(plan, reference(lighting.info().path))};
  Judgement judgement = judge(plan, checked.findings.value_or(Findings{}), difference);
  if (checked.decals) judgement = worse_of(judgement, judge(plan, *checked.decals, std::nullopt, "decal"));
  if (checked.probes) judgement = worse_of(judgement, judge(plan, *checked.probes, std::nullopt, "probe"));
  return judgement;
}

Checked Checker::check(Lighting& lighting, bool same_picture) {
  Checked checked{.verdict = "unverified",
                  .reason = group_.unchecked,
                  .rendered = render_views(renderer_, lighting, frame_.lights, frame_.decals, {})};
  if (group_.verify.what == Verify::What::nothing) return checked;
  const bool by_volumes = lighting.info().path == ShadingPath::standard_deferred;
  const bool still = lighting.info().still != gpu::STILL_OFF;
  if (still && !same_picture) {
    checked.reason = "not compared: lists leave out lights that walls hide, which `lamp verify` checks";
    return checked;
  }
  if ((by_volumes || still) && !group_.verify.compares_pictures) return checked;
  if (!still) need_truths();
  if (!by_volumes && !still) {
    checked.findings = find(lighting);
    const BenchScene& scene = device_.scene(group_);
    if (!scene.decals.empty()) checked.decals = find_boxes(lighting, Renderer::Kind::decals);
    if (!scene.probes.empty()) checked.probes = find_boxes(lighting, Renderer::Kind::probes);
  }
  if (group_.verify.compares_pictures)
    checked.difference = max_abs_difference(cropped(checked.rendered.image, rows_), reference(lighting.info().path));
  Judgement judgement = judge_output(lighting, checked);
  const bool approximate = lighting.runner().plan().approximate && !by_volumes;
  if (judgement.verdict < Verdict::unchecked) {
    checked.verdict = approximate ? "approximate" : "exact";
  } else {
    checked.verdict = judgement.verdict == Verdict::failed ? "wrong" : name_of(judgement.verdict);
    checked.reason = std::move(judgement.reason);
  }
  return checked;
}

}  // namespace lamp::app
