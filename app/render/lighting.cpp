// Records the four shading paths.
// SPDX-License-Identifier: Apache-2.0
#include "render/lighting.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "gpu/check.h"
#include "render/mirror_pass.h"
#include "render/still_lists.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t VOLUME_VERTICES = 60;

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

std::vector<vulkan::Bound> with_shadows(std::vector<vulkan::Bound> bound, const LightingFrame& frame) {
  bound.insert(bound.end(), frame.shadows.begin(), frame.shadows.end());
  return bound;
}

/// For shaders that have surroundings too.
std::vector<vulkan::Bound> with_probes(std::vector<vulkan::Bound> bound, const LightingFrame& frame) {
  bound.insert(bound.end(), frame.probes.begin(), frame.probes.end());
  return with_shadows(std::move(bound), frame);
}

std::vector<vulkan::Bound> with_forward_inputs(std::vector<vulkan::Bound> bound, const LightingFrame& frame) {
  bound.push_back({BINDING_DECALS, frame.data.decals()});
  bound.push_back({BINDING_STILL, frame.still});
  return with_probes(std::move(bound), frame);
}

/// Of shadows and probes.
std::vector<vulkan::Use> extra_uses(const LightingFrame& frame, VkPipelineStageFlags2 stages) {
  std::vector<vulkan::Use> uses;
  for (const vulkan::Bound& b : frame.shadows) uses.push_back(reads(b.resource, stages));
  for (const vulkan::Bound& b : frame.probes) uses.push_back(reads(b.resource, stages));
  return uses;
}

[[maybe_unused]] float mirror_limit(const MirrorPass* mirror) {
  return mirror == nullptr ? 0.0F : mirror->info().settings.roughness;
}

/// Draws reach only these rows.
void limit_rows(VkCommandBuffer commands, const LightingInfo& info) {
  if (info.shaded.count == 0) return;
  const VkRect2D rows{.offset = {0, static_cast<std::int32_t>(info.shaded.first)},
                      .extent = {info.width, info.shaded.count}};
  vkCmdSetScissor(commands, 0, 1, &rows);
}

/// Nothing where the plan did not count.
std::optional<Options> grown_options(const Method& method, const Problem& problem, const Plan& plan,
                                     std::span<const std::uint32_t> needed) {
  if (needed.size() != plan.capacities.size()) return std::nullopt;
  std::optional<GrownPlan> grown = grow_plan(method, problem, plan, needed);
  if (!grown) return std::nullopt;
  return std::move(grown->options);
}

}  // namespace

std::vector<std::pair<std::string, std::string>> changed_options(const Options& before, const Options& after) {
  std::vector<std::pair<std::string, std::string>> changed;
  for (const auto& [key, value] : after.all())
    if (value != before.word(key)) changed.emplace_back(key, value);
  return changed;
}

Lighting::Lighting(const vulkan::Device& device, const ShaderLibrary& shaders, const LightingInfo& info)
    : info_(info), traits_(device.traits) {
  runner_ = take(vulkan::PlanRunner::create(device, plan_or_throw(info, device), shaders.source()));
  if (has_culler(info.host)) culler_.emplace(device, info);
  shade_ = shading_pipeline(device, shaders, info, runner_.plan());
  if (info.path == ShadingPath::standard_deferred) volumes_ = volumes_pipeline(device, shaders, info);
  if (info.transparency) {
    if (std::optional<AnyDepthPlan> made = app::any_depth_plan(info, runner_.plan(), device))
      any_depth_ = {.method = made->method,
                    .problem = std::move(made->problem),
                    .runner = take(vulkan::PlanRunner::create(device, std::move(made->plan), shaders.source()))};
    transparent_ = transparent_pipeline(device, shaders, info, any_depth_ ? any_depth_->runner.plan() : runner_.plan());
  }
  if (info.decals && info.path != ShadingPath::forward)
    decals_.emplace(device, shaders, runner_.plan(), glm::uvec2(info.width, info.height));
}

std::optional<Options> Lighting::grown(std::span<const std::uint32_t> needed) const {
  return grown_options(*info_.method, problem_of(info_, traits_), runner_.plan(), needed);
}

std::optional<Options> Lighting::any_depth_grown(std::span<const std::uint32_t> needed) const {
  if (!any_depth_) return std::nullopt;
  return grown_options(*any_depth_->method, any_depth_->problem, any_depth_plan(), needed);
}

std::vector<std::pair<std::string, std::string>> Lighting::fits_with(std::span<const std::uint32_t> needed) const {
  const std::optional<Options> more = grown(needed);
  return more ? changed_options(info_.options, *more) : std::vector<std::pair<std::string, std::string>>();
}

std::span<const vulkan::PipelineStatistic> Lighting::statistics(std::string_view pass) const {
  if (pass == "forward+ shading" || pass == "deferred shading" || pass == "cull and shade") return shade_.statistics();
  if (pass == "light volumes") return volumes_.statistics();
  return runner_.statistics(pass);
}

bool Lighting::walks() const {
  return info_.path != ShadingPath::standard_deferred || decals_ || info_.probes != gpu::PROBES_OFF;
}

bool Lighting::fused() const { return is_fused(info_, runner_.plan()); }

bool Lighting::is_cull_pass(std::string_view name) const {
  const std::vector<Pass>& passes = fused() ? runner_.plan().fused->passes : runner_.plan().passes;
  return name == vulkan::UPLOAD_PASS || name == vulkan::CLEAR_PASS || name == CullerPass::NAME ||
         std::ranges::any_of(passes, [&](const Pass& pass) { return pass.name == name; });
}

void Lighting::record_cull(vulkan::Recorder& recorder, const LightingFrame& frame) {
  if (frame.culled) return;
  if (culler_) return culler_->record(recorder, frame);
  static_cast<void>(take(runner_.record(recorder, frame.inputs)));
}

void Lighting::record_any_depth_cull(vulkan::Recorder& recorder, const LightingFrame& frame) {
  if (any_depth_) static_cast<void>(take(any_depth_->runner.record(recorder, frame.inputs)));
}

vulkan::BoundLookUp Lighting::lookup(const LightingFrame& frame) const {
  if (culler_) return culler_->lookup();
  return runner_.lookup(frame.inputs, fused() ? Passes::fused : Passes::separate, frame.view);
}

void Lighting::record_counts(vulkan::Recorder& recorder) {
  if (!culler_) runner_.record_counts(recorder);
  if (any_depth_) any_depth_->runner.record_counts(recorder);
}

vulkan::FrameCounts Lighting::counts() const {
  if (culler_) return {.counters = culler_->counters()};
  return runner_.counts();
}

vulkan::FrameCounts Lighting::any_depth_counts() const {
  return any_depth_ ? any_depth_->runner.counts() : vulkan::FrameCounts{};
}

void Lighting::finish() {
  for (vulkan::PlanRunner* runner : {&runner_, any_depth_ ? &any_depth_->runner : nullptr})
    if (runner != nullptr && runner->records() != 0) runner->finish(runner->records());
  if (culler_) culler_->finish();
}

void Lighting::record_surfaces(vulkan::Recorder& recorder, const LightingFrame& frame) {
  if (frame.kept != nullptr)
    frame.kept->record(recorder, frame.targets);
  else
    frame.geometry.record_gbuffer(recorder, frame.scene, frame.data, frame.targets);
  if (!decals_) return;
  record_cull(recorder, frame);
  decals_->record(recorder, frame.data, frame.targets, lookup(frame));
}

void Lighting::record(vulkan::Recorder& recorder, const LightingFrame& frame) {
  assert((info_.probes == gpu::PROBES_OFF || info_.mirror == mirror_limit(frame.mirror)) &&
         "make a Lighting for the limit of the frame's mirror");
  if (info_.path == ShadingPath::forward && frame.mirror == nullptr)
    frame.geometry.record_depth(recorder, frame.scene, frame.data, frame.targets);
  else if (!frame.surfaces_drawn || decals_)
    record_surfaces(recorder, frame);

  if (fused())
    static_cast<void>(take(runner_.record(recorder, frame.inputs, Passes::fused)));
  else if (walks() && !decals_)  // they have culled
    record_cull(recorder, frame);

  if (info_.path == ShadingPath::forward && info_.captured)
    shade_captured(recorder, frame);
  else if (info_.path == ShadingPath::forward)
    shade_forward(recorder, frame);
  else
    shade_compute(recorder, frame);
  if (info_.path == ShadingPath::standard_deferred) add_volumes(recorder, frame);
  if (frame.mirror != nullptr) frame.mirror->record(recorder, frame);
  if (info_.transparency) add_transparent(recorder, frame);
}

void Lighting::shade_forward(vulkan::Recorder& recorder, const LightingFrame& frame) {
  const Attachments attachments{.colors = {{&frame.targets.hdr, Load::clear, frame.scene.scene().sky}},
                                .depth = &frame.targets.depth,
                                .depth_use = Attachments::Depth::test};
  const vulkan::BoundLookUp walked = lookup(frame);
  std::vector<vulkan::Use> uses = attachment_uses(attachments);
  append(uses, walked.buffer_uses(GRAPHICS_SHADERS));
  append(uses, {reads(frame.data.frame(), GRAPHICS_SHADERS), reads(frame.data.lights(), GRAPHICS_SHADERS),
                reads(frame.data.decals(), GRAPHICS_SHADERS), reads(frame.still, GRAPHICS_SHADERS)});
  append(uses, extra_uses(frame, GRAPHICS_SHADERS));
  recorder.begin_pass("forward+ shading", uses);
  begin_rendering(recorder.commands(), attachments, frame.targets);
  limit_rows(recorder.commands(), info_);
  draw_meshes(recorder, {.scene = &frame.scene,
                         .frame = &frame.data,
                         .draws = frame.scene.opaque(),
                         .pipeline = &shade_,
                         .more = with_forward_inputs(walked.resources, frame)});
  vkCmdEndRendering(recorder.commands());
  recorder.end_pass();
}

void Lighting::shade_captured(vulkan::Recorder& recorder, const LightingFrame& frame) {
  const Attachments attachments{.colors = {{&frame.targets.hdr, Load::clear, frame.scene.scene().sky}}};
  const vulkan::BoundLookUp walked = lookup(frame);
  std::vector<vulkan::Bound> bound = gbuffer_bound(frame.targets);
  append(bound, {{0, frame.data.frame()}, {3, frame.data.lights()}, {4, frame.scene.surroundings()}});
  bound = with_probes(std::move(bound), frame);
  std::vector<vulkan::Use> uses = attachment_uses(attachments);
  for (const vulkan::Bound& b : bound) uses.push_back(reads(b.resource, GRAPHICS_SHADERS));
  append(uses, walked.buffer_uses(GRAPHICS_SHADERS));
  append(bound, walked.resources);
  recorder.begin_pass("forward+ shading", uses);
  begin_rendering(recorder.commands(), attachments, frame.targets);
  limit_rows(recorder.commands(), info_);
  recorder.bind(shade_, bound);
  vkCmdDraw(recorder.commands(), 3, 1, 0, 0);
  vkCmdEndRendering(recorder.commands());
  recorder.end_pass();
}

void Lighting::shade_compute(vulkan::Recorder& recorder, const LightingFrame& frame) {
  constexpr VkPipelineStageFlags2 COMPUTE = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  const vulkan::BoundLookUp walked = lookup(frame);
  std::vector<vulkan::Bound> bound = gbuffer_bound(frame.targets);
  append(bound, {{0, frame.data.frame_constants()},
                 {2, frame.targets.hdr.storage()},
                 {3, frame.data.lights()},
                 {4, frame.scene.surroundings()},
                 {BINDING_STILL, frame.still},
                 triangles_bound(frame.targets)});
  std::vector<vulkan::Use> uses{{.resource = frame.targets.hdr.storage(),
                                 .stages = COMPUTE,
                                 .access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                                 .discard = true},
                                reads(frame.data.frame_constants(), COMPUTE),
                                reads(frame.data.lights(), COMPUTE),
                                reads(frame.still, COMPUTE)};
  for (const vulkan::Bound& b : gbuffer_bound(frame.targets)) uses.push_back(reads(b.resource, COMPUTE));
  if (frame.targets.numbered) uses.push_back(reads(frame.targets.triangles.sampled(), COMPUTE));
  // Standard deferred binds a look-up that it does not walk: its shader could.
  append(uses, walked.buffer_uses(COMPUTE));
  append(bound, walked.resources);
  bound = with_probes(std::move(bound), frame);
  append(uses, extra_uses(frame, COMPUTE));
  const glm::uvec2 group = shade_group(info_, runner_.plan());

  recorder.begin_pass(fused() ? "cull and shade" : "deferred shading", uses);
  recorder.bind(shade_, bound);
  const std::uint32_t rows = info_.shaded.count == 0 ? info_.height : info_.shaded.count;
  vkCmdDispatch(recorder.commands(), (info_.width + group.x - 1) / group.x, (rows + group.y - 1) / group.y, 1);
  recorder.end_pass();
}

void Lighting::add_volumes(vulkan::Recorder& recorder, const LightingFrame& frame) {
  const Attachments attachments{
      .colors = {{&frame.targets.hdr}}, .depth = &frame.targets.depth, .depth_use = Attachments::Depth::test};
  std::vector<vulkan::Bound> bound = gbuffer_bound(frame.targets);
  append(bound, {{0, frame.data.frame()}, {3, frame.data.lights()}});
  bound = with_shadows(std::move(bound), frame);
  std::vector<vulkan::Use> uses = attachment_uses(attachments);
  for (const vulkan::Bound& b : bound)
    if (b.binding != 1) uses.push_back(reads(b.resource, GRAPHICS_SHADERS));
  recorder.begin_pass("light volumes", uses);
  begin_rendering(recorder.commands(), attachments, frame.targets);
  limit_rows(recorder.commands(), info_);
  recorder.bind(volumes_, bound);
  const std::uint32_t lights = frame.data.entities().lights.count();
  if (lights != 0) vkCmdDraw(recorder.commands(), VOLUME_VERTICES, lights, 0, 0);
  vkCmdEndRendering(recorder.commands());
  recorder.end_pass();
}

void Lighting::add_transparent(vulkan::Recorder& recorder, const LightingFrame& frame) {
  vulkan::PlanRunner& runner = any_depth_ ? any_depth_->runner : runner_;
  const bool culled = !any_depth_ && walks() && !fused();
  recorder.name_group("transparent");
  if (!culled) static_cast<void>(take(runner.record(recorder, frame.inputs)));
  recorder.name_group("");

  std::vector<Draw> far_to_near(frame.scene.blended().begin(), frame.scene.blended().end());
  std::ranges::sort(far_to_near, {}, [&](const Draw& draw) {
    const glm::vec3 offset = draw.center - frame.eye;
    return std::pair(-glm::dot(offset, offset), draw.first_instance);
  });
  const Attachments attachments{
      .colors = {{&frame.targets.hdr}}, .depth = &frame.targets.depth, .depth_use = Attachments::Depth::test};
  const vulkan::BoundLookUp walked = culled ? lookup(frame) : runner.lookup(frame.inputs, Passes::separate, frame.view);
  std::vector<vulkan::Use> uses = attachment_uses(attachments);
  append(uses, walked.buffer_uses(GRAPHICS_SHADERS));
  append(uses, {reads(frame.data.frame(), GRAPHICS_SHADERS), reads(frame.data.lights(), GRAPHICS_SHADERS),
                reads(frame.data.decals(), GRAPHICS_SHADERS), reads(frame.still, GRAPHICS_SHADERS)});
  append(uses, extra_uses(frame, GRAPHICS_SHADERS));
  recorder.begin_pass("transparent", uses);
  begin_rendering(recorder.commands(), attachments, frame.targets);
  limit_rows(recorder.commands(), info_);
  draw_meshes(recorder, {.scene = &frame.scene,
                         .frame = &frame.data,
                         .draws = far_to_near,
                         .pipeline = &transparent_,
                         .more = with_forward_inputs(walked.resources, frame)});
  vkCmdEndRendering(recorder.commands());
  recorder.end_pass();
}

}  // namespace lamp::app
