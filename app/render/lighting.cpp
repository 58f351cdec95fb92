// Builds and records the four shading paths.
// SPDX-License-Identifier: Apache-2.0
#include "render/lighting.h"

#include <algorithm>
#include <array>
#include <cassert>

#include "gpu/check.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t CONSTANT_BRDF = 10;
constexpr std::uint32_t CONSTANT_WALK = 11;
constexpr std::uint32_t CONSTANT_FIRST_ROW = 12;
constexpr std::uint32_t SHADE_GROUP_PX = 8;  // without a fused cull: a subgroup lies within the smallest tile
constexpr std::uint32_t VOLUME_VERTICES = 60;

std::vector<vulkan::DescriptorBinding> lookup_bindings(const LookUp& lookup) {
  std::vector<vulkan::DescriptorBinding> bindings;
  for (std::uint32_t i = 0; i < lookup.bindings.size(); ++i)
    bindings.push_back({LOOKUP_BINDING + i, vulkan::descriptor_type(lookup.bindings[i].resource)});
  return bindings;
}

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

std::string variant(const char* shader, std::string_view lookup) {
  return std::string(shader) + "@" + std::string(lookup);
}

std::vector<vulkan::Bound> with_decals(std::vector<vulkan::Bound> bound, const LightingFrame& frame) {
  bound.push_back({BINDING_DECALS, frame.data.decals()});
  return bound;
}

/// The G-buffer at the bindings of common/deferred_surface.glsl.
std::vector<vulkan::Bound> gbuffer_bound(const Targets& targets) {
  return {{1, targets.depth.sampled()},
          {5, targets.base_color.sampled()},
          {6, targets.surface.sampled()},
          {7, targets.emission.sampled()}};
}

std::vector<vulkan::DescriptorBinding> gbuffer_bindings(VkDescriptorType frame) {
  return {{0, frame},
          {1, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE},
          {3, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
          {5, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE},
          {6, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE},
          {7, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE}};
}

vulkan::Pipeline forward_pipeline(const vulkan::Device& device, const ShaderLibrary& shaders, const LightingInfo& info,
                                  const vulkan::PlanRunner& runner, const vulkan::GraphicsState& state,
                                  const char* name) {
  const vulkan::BoundLookUp lookup = runner.lookup({});
  vulkan::PipelineInfo pipeline{.name = name, .constants = lookup.constants, .bindings = mesh_bindings()};
  append(pipeline.constants, {{CONSTANT_BRDF, static_cast<std::uint32_t>(info.brdf)},
                              {CONSTANT_BOXES, info.decals ? 1U : 0U},
                              {CONSTANT_BOXES_ASCEND, runner.plan().ordered ? 1U : 0U}});
  pipeline.bindings.push_back({BINDING_DECALS, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER});
  append(pipeline.bindings, lookup_bindings(runner.plan().lookup));
  return take(vulkan::Pipeline::graphics(device, pipeline, shaders.spirv("mesh"),
                                         shaders.spirv(variant("forward", lookup.name)), state));
}

vulkan::Pipeline captured_pipeline(const vulkan::Device& device, const ShaderLibrary& shaders, const LightingInfo& info,
                                   const vulkan::PlanRunner& runner) {
  const vulkan::BoundLookUp lookup = runner.lookup({});
  vulkan::PipelineInfo pipeline{.name = "forward+, captured",
                                .constants = lookup.constants,
                                .bindings = gbuffer_bindings(VK_DESCRIPTOR_TYPE_STORAGE_BUFFER)};
  pipeline.constants.push_back({CONSTANT_BRDF, static_cast<std::uint32_t>(info.brdf)});
  pipeline.bindings.push_back({4, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER});
  append(pipeline.bindings, lookup_bindings(runner.plan().lookup));
  return take(vulkan::Pipeline::graphics(device, pipeline, shaders.spirv("full_screen"),
                                         shaders.spirv(variant("forward_captured", lookup.name)),
                                         {.colors = {VK_FORMAT_R32G32B32A32_SFLOAT}}));
}

Problem problem_of(const LightingInfo& info, const DeviceTraits& traits) {
  return {.width = info.width,
          .height = info.height,
          .light_capacity = info.light_capacity,
          .options = info.options,
          .traits = traits};
}

/// Draws reach only these rows.
void limit_rows(VkCommandBuffer commands, const LightingInfo& info) {
  if (info.shaded.count == 0) return;
  const VkRect2D rows{.offset = {0, static_cast<std::int32_t>(info.shaded.first)},
                      .extent = {info.width, info.shaded.count}};
  vkCmdSetScissor(commands, 0, 1, &rows);
}

}  // namespace

std::span<const std::string_view> path_names() {
  static constexpr std::array<std::string_view, 4> NAMES{"forward", "tiled-deferred", "deferred", "standard-deferred"};
  return NAMES;
}

std::vector<std::pair<std::string, std::string>> changed_options(const Options& before, const Options& after) {
  std::vector<std::pair<std::string, std::string>> changed;
  for (const auto& [key, value] : after.all())
    if (value != before.word(key)) changed.emplace_back(key, value);
  return changed;
}

Plan plan_or_throw(const LightingInfo& info, const vulkan::Device& device) {
  return take(make_plan(*info.method, problem_of(info, device.traits)));
}

Lighting::Lighting(const vulkan::Device& device, const ShaderLibrary& shaders, const LightingInfo& info)
    : info_(info), traits_(device.traits) {
  runner_ = take(vulkan::PlanRunner::create(device, plan_or_throw(info, device), shaders.source()));
  build_shade(device, shaders);
  if (info.transparency) build_transparent(device, shaders);
  if (info.decals && info.path != ShadingPath::forward)
    decals_.emplace(device, shaders, runner_, glm::uvec2(info.width, info.height));
}

std::optional<Options> Lighting::grown(std::span<const std::uint32_t> needed) const {
  const Plan& plan = runner_.plan();
  if (needed.size() != plan.capacities.size()) return std::nullopt;
  std::optional<GrownPlan> grown = grow_plan(*info_.method, problem_of(info_, traits_), plan, needed);
  if (!grown) return std::nullopt;
  return std::move(grown->options);
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

bool Lighting::fused() const {
  // Decals must be in the G-buffer before it is lit, and need the cells for that: the cull comes first.
  return info_.path == ShadingPath::tiled_deferred && runner_.plan().fused.has_value() && !info_.decals;
}

void Lighting::build_shade(const vulkan::Device& device, const ShaderLibrary& shaders) {
  if (info_.path == ShadingPath::forward && info_.captured) {
    shade_ = captured_pipeline(device, shaders, info_, runner_);
    return;
  }
  if (info_.path == ShadingPath::forward) {
    shade_ = forward_pipeline(device, shaders, info_, runner_,
                              mesh_state(VK_COMPARE_OP_EQUAL, {VK_FORMAT_R32G32B32A32_SFLOAT}), "forward+");
    return;
  }
  assert(info_.shaded.first % SHADE_GROUP_PX == 0 && "work groups lie within tiles");
  const bool volumes = info_.path == ShadingPath::standard_deferred;
  const FusedLookUp* fused_lookup = fused() ? &*runner_.plan().fused : nullptr;
  const vulkan::BoundLookUp lookup = runner_.lookup({}, fused() ? Passes::fused : Passes::separate);
  vulkan::PipelineInfo info{.name = "deferred shading",
                            .bindings = gbuffer_bindings(VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER)};
  append(info.bindings, {{2, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE}, {4, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER}});
  info.constants = {{0, fused_lookup != nullptr ? fused_lookup->group_width : SHADE_GROUP_PX},
                    {1, fused_lookup != nullptr ? fused_lookup->group_height : SHADE_GROUP_PX},
                    {CONSTANT_BRDF, static_cast<std::uint32_t>(info_.brdf)},
                    {CONSTANT_WALK, volumes ? 0U : 1U},
                    {CONSTANT_FIRST_ROW, info_.shaded.first},
                    {CONSTANT_BOXES, info_.decals ? 1U : 0U}};
  append(info.constants, lookup.constants);
  append(info.bindings, lookup_bindings(fused_lookup != nullptr ? fused_lookup->lookup : runner_.plan().lookup));
  shade_ = take(vulkan::Pipeline::compute(device, info, shaders.spirv(variant("deferred", lookup.name))));
  if (!volumes) return;
  const vulkan::GraphicsState additive{.cull = VK_CULL_MODE_FRONT_BIT,
                                       .colors = {VK_FORMAT_R32G32B32A32_SFLOAT},
                                       .depth = VK_FORMAT_D32_SFLOAT,
                                       .depth_clamp = true,
                                       .depth_compare = VK_COMPARE_OP_LESS_OR_EQUAL,
                                       .blend = vulkan::GraphicsState::Blend::add};
  volumes_ = take(vulkan::Pipeline::graphics(device,
                                             {.name = "light volumes",
                                              .constants = {{CONSTANT_BRDF, static_cast<std::uint32_t>(info_.brdf)}},
                                              .bindings = gbuffer_bindings(VK_DESCRIPTOR_TYPE_STORAGE_BUFFER)},
                                             shaders.spirv("volume_proxy"), shaders.spirv("volume_light"), additive));
}

void Lighting::build_transparent(const vulkan::Device& device, const ShaderLibrary& shaders) {
  if (!runner_.plan().any_depth) {
    LightingInfo any_depth = info_;
    any_depth.method = take(find_method("lamplight"));
    any_depth.options = take(resolve_options(*any_depth.method, {"depth=none", "tile=32", "mean_cells=2"}));
    any_depth_runner_ = take(vulkan::PlanRunner::create(device, plan_or_throw(any_depth, device), shaders.source()));
  }
  vulkan::GraphicsState state = mesh_state(VK_COMPARE_OP_GREATER, {VK_FORMAT_R32G32B32A32_SFLOAT});
  state.depth_write = false;
  state.blend = vulkan::GraphicsState::Blend::over;
  transparent_ =
      forward_pipeline(device, shaders, info_, any_depth_runner_ ? *any_depth_runner_ : runner_, state, "transparent");
}

bool Lighting::is_cull_pass(std::string_view name) const {
  const std::vector<Pass>& passes = fused() ? runner_.plan().fused->passes : runner_.plan().passes;
  return name == vulkan::UPLOAD_PASS || name == vulkan::CLEAR_PASS ||
         std::ranges::any_of(passes, [&](const Pass& pass) { return pass.name == name; });
}

void Lighting::record_cull(vulkan::Recorder& recorder, const LightingFrame& frame) {
  static_cast<void>(take(runner_.record(recorder, frame.data.plan_inputs(frame.targets.depth.sampled()))));
}

void Lighting::record_surfaces(vulkan::Recorder& recorder, const LightingFrame& frame) {
  if (frame.kept != nullptr)
    frame.kept->record(recorder, frame.targets);
  else
    frame.geometry.record_gbuffer(recorder, frame.scene, frame.data, frame.targets);
  if (!decals_) return;
  record_cull(recorder, frame);
  const vulkan::PlanInputs inputs = frame.data.plan_inputs(frame.targets.depth.sampled());
  decals_->record(recorder, frame.data, frame.targets, runner_.lookup(inputs));
}

void Lighting::record(vulkan::Recorder& recorder, const LightingFrame& frame) {
  if (info_.path == ShadingPath::forward)
    frame.geometry.record_depth(recorder, frame.scene, frame.data, frame.targets);
  else if (!frame.surfaces_drawn || decals_)
    record_surfaces(recorder, frame);

  if (fused())
    static_cast<void>(
        take(runner_.record(recorder, frame.data.plan_inputs(frame.targets.depth.sampled()), Passes::fused)));
  else if (info_.path != ShadingPath::standard_deferred && !decals_)
    record_cull(recorder, frame);

  if (info_.path == ShadingPath::forward && info_.captured)
    shade_captured(recorder, frame);
  else if (info_.path == ShadingPath::forward)
    shade_forward(recorder, frame);
  else
    shade_compute(recorder, frame);
  if (info_.path == ShadingPath::standard_deferred) add_volumes(recorder, frame);
  if (info_.transparency) add_transparent(recorder, frame);
}

void Lighting::shade_forward(vulkan::Recorder& recorder, const LightingFrame& frame) {
  const Attachments attachments{.colors = {{&frame.targets.hdr, Load::clear, frame.scene.scene().sky}},
                                .depth = &frame.targets.depth,
                                .depth_use = Attachments::Depth::test};
  const vulkan::BoundLookUp lookup = runner_.lookup(frame.data.plan_inputs(frame.targets.depth.sampled()));
  std::vector<vulkan::Use> uses = attachment_uses(attachments);
  append(uses, lookup.buffer_uses(GRAPHICS_SHADERS));
  append(uses, {reads(frame.data.frame(), GRAPHICS_SHADERS), reads(frame.data.lights(), GRAPHICS_SHADERS),
                reads(frame.data.decals(), GRAPHICS_SHADERS)});
  recorder.begin_pass("forward+ shading", uses);
  begin_rendering(recorder.commands(), attachments, frame.targets);
  limit_rows(recorder.commands(), info_);
  draw_meshes(recorder, {.scene = &frame.scene,
                         .frame = &frame.data,
                         .draws = frame.scene.opaque(),
                         .pipeline = &shade_,
                         .more = with_decals(lookup.resources, frame)});
  vkCmdEndRendering(recorder.commands());
  recorder.end_pass();
}

void Lighting::shade_captured(vulkan::Recorder& recorder, const LightingFrame& frame) {
  const Attachments attachments{.colors = {{&frame.targets.hdr, Load::clear, frame.scene.scene().sky}}};
  const vulkan::BoundLookUp lookup = runner_.lookup(frame.data.plan_inputs(frame.targets.depth.sampled()));
  std::vector<vulkan::Bound> bound = gbuffer_bound(frame.targets);
  append(bound, {{0, frame.data.frame()}, {3, frame.data.lights()}, {4, frame.scene.surroundings()}});
  std::vector<vulkan::Use> uses = attachment_uses(attachments);
  for (const vulkan::Bound& b : bound) uses.push_back(reads(b.resource, GRAPHICS_SHADERS));
  append(uses, lookup.buffer_uses(GRAPHICS_SHADERS));
  append(bound, lookup.resources);
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
  const vulkan::PlanInputs inputs = frame.data.plan_inputs(frame.targets.depth.sampled());
  const vulkan::BoundLookUp lookup = runner_.lookup(inputs, fused() ? Passes::fused : Passes::separate);
  std::vector<vulkan::Bound> bound = gbuffer_bound(frame.targets);
  append(bound, {{0, frame.data.frame_constants()},
                 {2, frame.targets.hdr.storage()},
                 {3, frame.data.lights()},
                 {4, frame.scene.surroundings()}});
  std::vector<vulkan::Use> uses{{.resource = frame.targets.hdr.storage(),
                                 .stages = COMPUTE,
                                 .access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                                 .discard = true},
                                reads(frame.data.frame_constants(), COMPUTE),
                                reads(frame.data.lights(), COMPUTE)};
  for (const vulkan::Bound& b : gbuffer_bound(frame.targets)) uses.push_back(reads(b.resource, COMPUTE));
  // A look-up that standard deferred does not walk is bound, but nothing reads it; only decals have filled it.
  if (info_.path != ShadingPath::standard_deferred || decals_) append(uses, lookup.buffer_uses(COMPUTE));
  append(bound, lookup.resources);
  const std::uint32_t group_width = fused() ? runner_.plan().fused->group_width : SHADE_GROUP_PX;
  const std::uint32_t group_height = fused() ? runner_.plan().fused->group_height : SHADE_GROUP_PX;

  recorder.begin_pass(fused() ? "cull and shade" : "deferred shading", uses);
  recorder.bind(shade_, bound);
  const std::uint32_t rows = info_.shaded.count == 0 ? info_.height : info_.shaded.count;
  vkCmdDispatch(recorder.commands(), (info_.width + group_width - 1) / group_width,
                (rows + group_height - 1) / group_height, 1);
  recorder.end_pass();
}

void Lighting::add_volumes(vulkan::Recorder& recorder, const LightingFrame& frame) {
  const Attachments attachments{
      .colors = {{&frame.targets.hdr}}, .depth = &frame.targets.depth, .depth_use = Attachments::Depth::test};
  std::vector<vulkan::Bound> bound = gbuffer_bound(frame.targets);
  append(bound, {{0, frame.data.frame()}, {3, frame.data.lights()}});
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
  const vulkan::PlanInputs inputs = frame.data.plan_inputs(frame.targets.depth.sampled());
  vulkan::PlanRunner& runner = any_depth_runner_ ? *any_depth_runner_ : runner_;
  const bool walked = info_.path != ShadingPath::standard_deferred || decals_;
  const bool culled = !any_depth_runner_ && walked && !fused();
  recorder.name_group("transparent");
  if (!culled) static_cast<void>(take(runner.record(recorder, inputs)));
  recorder.name_group("");

  std::vector<Draw> far_to_near(frame.scene.blended().begin(), frame.scene.blended().end());
  std::ranges::sort(far_to_near, {}, [&](const Draw& draw) {
    const glm::vec3 offset = draw.center - frame.eye;
    return std::pair(-glm::dot(offset, offset), draw.first_instance);
  });
  const Attachments attachments{
      .colors = {{&frame.targets.hdr}}, .depth = &frame.targets.depth, .depth_use = Attachments::Depth::test};
  const vulkan::BoundLookUp lookup = runner.lookup(inputs);
  std::vector<vulkan::Use> uses = attachment_uses(attachments);
  append(uses, lookup.buffer_uses(GRAPHICS_SHADERS));
  append(uses, {reads(frame.data.frame(), GRAPHICS_SHADERS), reads(frame.data.lights(), GRAPHICS_SHADERS),
                reads(frame.data.decals(), GRAPHICS_SHADERS)});
  recorder.begin_pass("transparent", uses);
  begin_rendering(recorder.commands(), attachments, frame.targets);
  limit_rows(recorder.commands(), info_);
  draw_meshes(recorder, {.scene = &frame.scene,
                         .frame = &frame.data,
                         .draws = far_to_near,
                         .pipeline = &transparent_,
                         .more = with_decals(lookup.resources, frame)});
  vkCmdEndRendering(recorder.commands());
  recorder.end_pass();
}

}  // namespace lamp::app
