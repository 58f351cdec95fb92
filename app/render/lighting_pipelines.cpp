// Builds the pipelines of the four shading paths.
// SPDX-License-Identifier: Apache-2.0
#include "render/lighting_pipelines.h"

#include <array>
#include <cassert>

#include "gpu/check.h"
#include "render/box_shapes.h"
#include "render/decal_pass.h"
#include "render/mesh_pass.h"
#include "render/probe_set.h"
#include "render/shadows.h"
#include "render/still_lists.h"

namespace lamp::app {
namespace {

/// In cells of the picture. These are long far away, where more lights make long lists of them; cells of the world are
/// not. H200, atrium, 1080p: 65 536 lights take 1.6 ms to cull and shade at any depth in either, 262 144 take 3.8 in
/// cells of the picture and 2.4 in those of the world, a million 71 and 3.3.
constexpr std::uint32_t MOST_LIGHTS_AT_ANY_DEPTH = 131072;

constexpr std::uint32_t CONSTANT_WALK = 11;
constexpr std::uint32_t CONSTANT_FIRST_ROW = 12;
constexpr std::uint32_t CONSTANT_SEVERAL_VIEWS = 18;
constexpr std::uint32_t SHADE_GROUP_PX = 8;  // without a fused cull: a subgroup lies within the smallest tile

template <class T>
void append(std::vector<T>& to, const std::vector<T>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

std::string variant(const char* shader, std::string_view lookup) {
  return std::string(shader) + "@" + std::string(lookup);
}

std::uint32_t has_boxes(const LightingInfo& info) { return info.decals || info.probes != gpu::PROBES_OFF ? 1 : 0; }

std::vector<vulkan::DescriptorBinding> gbuffer_bindings(VkDescriptorType frame) {
  return {{0, frame},
          {1, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE},
          {3, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
          {5, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE},
          {6, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE},
          {7, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE}};
}

vulkan::Pipeline forward_pipeline(const vulkan::Device& device, const ShaderLibrary& shaders, const LightingInfo& info,
                                  const Plan& plan, const vulkan::GraphicsState& state, const char* name) {
  vulkan::PipelineInfo pipeline{
      .name = name, .constants = vulkan::lookup_constants(plan.lookup), .bindings = mesh_bindings()};
  append(pipeline.constants, {{CONSTANT_BRDF, static_cast<std::uint32_t>(info.brdf)},
                              {CONSTANT_BOXES, has_boxes(info)},
                              {CONSTANT_BOXES_ASCEND, plan.ordered ? 1U : 0U},
                              shown_view_constant(plan),
                              {CONSTANT_STILL, info.still}});
  pipeline.bindings.push_back({BINDING_DECALS, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER});
  pipeline.bindings.push_back({BINDING_STILL, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER});
  add_shadows(pipeline, info.shadows);
  add_probes(pipeline, info.probes, info.mirror);
  append(pipeline.bindings, vulkan::lookup_bindings(plan.lookup));
  return take(vulkan::Pipeline::graphics(device, pipeline, shaders.spirv("mesh"),
                                         shaders.spirv(variant("forward", plan.lookup.name)), state));
}

vulkan::Pipeline captured_pipeline(const vulkan::Device& device, const ShaderLibrary& shaders, const LightingInfo& info,
                                   const Plan& plan) {
  vulkan::PipelineInfo pipeline{.name = "forward+, captured",
                                .constants = vulkan::lookup_constants(plan.lookup),
                                .bindings = gbuffer_bindings(VK_DESCRIPTOR_TYPE_STORAGE_BUFFER)};
  append(pipeline.constants, {{CONSTANT_BRDF, static_cast<std::uint32_t>(info.brdf)},
                              {CONSTANT_BOXES, has_boxes(info)},
                              {CONSTANT_BOXES_ASCEND, plan.ordered ? 1U : 0U},
                              shown_view_constant(plan)});
  pipeline.bindings.push_back({4, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER});
  add_shadows(pipeline, info.shadows);
  add_probes(pipeline, info.probes);
  append(pipeline.bindings, vulkan::lookup_bindings(plan.lookup));
  return take(vulkan::Pipeline::graphics(device, pipeline, shaders.spirv("full_screen"),
                                         shaders.spirv(variant("forward_captured", plan.lookup.name)),
                                         {.colors = {VK_FORMAT_R32G32B32A32_SFLOAT}}));
}

vulkan::Pipeline deferred_pipeline(const vulkan::Device& device, const ShaderLibrary& shaders, const LightingInfo& info,
                                   const Plan& plan) {
  assert(info.shaded.first % SHADE_GROUP_PX == 0 && "work groups lie within tiles");
  const LookUp& lookup = is_fused(info, plan) ? plan.fused->lookup : plan.lookup;
  const glm::uvec2 group = shade_group(info, plan);
  const bool walks = info.path != ShadingPath::standard_deferred;
  vulkan::PipelineInfo pipeline{.name = "deferred shading",
                                .bindings = gbuffer_bindings(VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER)};
  append(pipeline.bindings, {{2, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE},
                             {4, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER},
                             {BINDING_TRIANGLES, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE}});
  pipeline.constants = {{0, group.x},
                        {1, group.y},
                        {CONSTANT_BRDF, static_cast<std::uint32_t>(info.brdf)},
                        {CONSTANT_WALK, walks ? 1U : 0U},
                        {CONSTANT_FIRST_ROW, info.shaded.first},
                        {CONSTANT_BOXES, has_boxes(info)},
                        {CONSTANT_BOXES_ASCEND, plan.ordered ? 1U : 0U},
                        shown_view_constant(plan),
                        {CONSTANT_STILL, info.still}};
  pipeline.bindings.push_back({BINDING_STILL, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER});
  add_shadows(pipeline, info.shadows);
  add_probes(pipeline, info.probes, info.mirror);
  append(pipeline.constants, vulkan::lookup_constants(lookup));
  append(pipeline.bindings, vulkan::lookup_bindings(lookup));
  return take(vulkan::Pipeline::compute(device, pipeline, shaders.spirv(variant("deferred", lookup.name))));
}

}  // namespace

std::span<const std::string_view> path_names() {
  static constexpr std::array<std::string_view, 4> NAMES{"forward", "tiled-deferred", "deferred", "standard-deferred"};
  return NAMES;
}

std::span<const std::string_view> host_names() {
  static constexpr std::array<std::string_view, 5> NAMES{"plan", "culler", "host-barriers", "larger-plan",
                                                         "changing-size"};
  return NAMES;
}

bool has_culler(Host host) { return host == Host::culler || host == Host::host_barriers; }

Problem problem_of(const LightingInfo& info, const DeviceTraits& traits) {
  const std::uint32_t sides = info.host == Host::larger_plan || info.host == Host::changing_size ? 2 : 1;
  return {.width = info.width * sides,
          .height = info.height * sides,
          .views = info.depth.views,
          .light_capacity = info.light_capacity,
          .options = info.options,
          .traits = traits,
          .depth_samples = info.depth.samples,
          .smaller_frames = sides > 1};
}

Plan plan_or_throw(const LightingInfo& info, const vulkan::Device& device) {
  return take(make_plan(*info.method, problem_of(info, device.traits)));
}

std::optional<AnyDepthPlan> any_depth_plan(const LightingInfo& info, const Plan& plan, const vulkan::Device& device) {
  if (plan.any_depth) return std::nullopt;
  LightingInfo any_depth = info;
  // Cells of the world are asked at a pixel's centre: surfaces that cover single samples want cells of the picture.
  const bool world = info.light_capacity > MOST_LIGHTS_AT_ANY_DEPTH && info.depth.samples == 1;
  any_depth.method = take(find_method(world ? "world-cells" : "lamplight"));
  const std::vector<std::string> of_picture{"depth=none", "tile=32", "mean_cells=2"};
  const std::vector<std::string> settings =
      with_box_shapes(*any_depth.method, world ? std::vector<std::string>() : of_picture, culls_shapes(info.options));
  any_depth.options =
      info.any_depth_options ? *info.any_depth_options : take(resolve_options(*any_depth.method, settings));
  Problem problem = problem_of(any_depth, device.traits);
  problem.smaller_frames = false;  // the frame's record has the cells of the other plan
  Plan made = take(make_plan(*any_depth.method, problem));
  return AnyDepthPlan{.method = any_depth.method, .problem = std::move(problem), .plan = std::move(made)};
}

vulkan::Constant shown_view_constant(const Plan& plan) { return {CONSTANT_SEVERAL_VIEWS, plan.views > 1 ? 1U : 0U}; }

bool is_fused(const LightingInfo& info, const Plan& plan) {
  // Decals must be in the G-buffer before it is lit, and need the cells for that: the cull comes first.
  return info.path == ShadingPath::tiled_deferred && plan.fused.has_value() && !info.decals && !has_culler(info.host);
}

glm::uvec2 shade_group(const LightingInfo& info, const Plan& plan) {
  return is_fused(info, plan) ? glm::uvec2(plan.fused->group_width, plan.fused->group_height)
                              : glm::uvec2(SHADE_GROUP_PX);
}

vulkan::Pipeline shading_pipeline(const vulkan::Device& device, const ShaderLibrary& shaders, const LightingInfo& info,
                                  const Plan& plan) {
  if (info.path != ShadingPath::forward) return deferred_pipeline(device, shaders, info, plan);
  if (info.captured) return captured_pipeline(device, shaders, info, plan);
  return forward_pipeline(device, shaders, info, plan, mesh_state(VK_COMPARE_OP_EQUAL, {VK_FORMAT_R32G32B32A32_SFLOAT}),
                          "forward+");
}

vulkan::Pipeline volumes_pipeline(const vulkan::Device& device, const ShaderLibrary& shaders,
                                  const LightingInfo& info) {
  const vulkan::GraphicsState additive{.cull = VK_CULL_MODE_FRONT_BIT,
                                       .colors = {VK_FORMAT_R32G32B32A32_SFLOAT},
                                       .depth = VK_FORMAT_D32_SFLOAT,
                                       .depth_clamp = true,
                                       .depth_compare = info.depth.not_nearer(),
                                       .blend = vulkan::GraphicsState::Blend::add};
  vulkan::PipelineInfo pipeline{.name = "light volumes",
                                .constants = {{CONSTANT_BRDF, static_cast<std::uint32_t>(info.brdf)}},
                                .bindings = gbuffer_bindings(VK_DESCRIPTOR_TYPE_STORAGE_BUFFER)};
  add_shadows(pipeline, info.shadows);
  return take(vulkan::Pipeline::graphics(device, pipeline, shaders.spirv("volume_proxy"), shaders.spirv("volume_light"),
                                         additive));
}

vulkan::Pipeline transparent_pipeline(const vulkan::Device& device, const ShaderLibrary& shaders,
                                      const LightingInfo& info, const Plan& any_depth) {
  vulkan::GraphicsState state = mesh_state(info.depth.nearer(), {VK_FORMAT_R32G32B32A32_SFLOAT});
  state.depth_write = false;
  state.blend = vulkan::GraphicsState::Blend::over;
  LightingInfo without_rays = info;
  without_rays.mirror = 0.0F;
  return forward_pipeline(device, shaders, without_rays, any_depth, state, "transparent");
}

}  // namespace lamp::app
