// Records the faces of a probe.
// SPDX-License-Identifier: Apache-2.0
#include "render/probe_capture.h"

#include <algorithm>
#include <cassert>
#include <glm/glm.hpp>
#include <utility>

#include "gpu/check.h"

namespace lamp::app {
namespace {

constexpr double NEAR_M = 0.02;
constexpr std::uint32_t GROUP_PX = 8;

LightingInfo lighting_info(const ProbeCaptureInfo& info, const GpuScene& scene) {
  LightingInfo lighting{.method = info.method,
                        .options = info.options,
                        .width = gpu::PROBE_SIDE,
                        .height = gpu::PROBE_SIDE,
                        .light_capacity = info.light_capacity + info.decal_capacity,
                        .path = ShadingPath::deferred,
                        .brdf = info.brdf,
                        .transparency = !scene.blended().empty(),
                        .decals = info.decal_capacity != 0};
  if (info.shadows) lighting.shadows = info.shadows->filter;
  if (info.method != nullptr) return lighting;
  lighting.method = take(find_method("world-cells"));
  lighting.options = take(resolve_options(*lighting.method, {}));
  return lighting;
}

vulkan::Pipeline face_pipeline(const vulkan::Device& device, const ShaderLibrary& shaders) {
  return take(vulkan::Pipeline::compute(
      device,
      {.name = "probe face",
       .bindings = {{0}, {1, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE}, {2, VK_DESCRIPTOR_TYPE_STORAGE_IMAGE}, {3}},
       .push_constant_bytes = sizeof(gpu::ProbePush)},
      shaders.spirv("probe_face")));
}

}  // namespace

std::vector<View> probe_views(const glm::vec3& position) {
  const glm::dvec3 eye(position);
  std::vector<View> views;
  for (std::uint32_t face = 0; face < gpu::PROBE_FACES; ++face) {
    glm::dvec3 forward(0.0);
    forward[static_cast<int>(face / 2)] = face % 2 == 0 ? 1.0 : -1.0;
    const glm::dvec3 up = face / 2 == 1 ? glm::dvec3(0.0, 0.0, 1.0) : glm::dvec3(0.0, 1.0, 0.0);
    const glm::dvec3 right = glm::cross(forward, up);
    glm::dmat4 world_from_view(1.0);
    world_from_view[0] = {right, 0.0};
    world_from_view[1] = {up, 0.0};
    world_from_view[2] = {-forward, 0.0};
    world_from_view[3] = {eye, 1.0};
    views.push_back(
        take(View::create(gpu::PROBE_SIDE, gpu::PROBE_SIDE, perspective({-1.0, 1.0, -1.0, 1.0}, NEAR_M, INFINITE_FAR),
                          DMat4(glm::inverse(world_from_view)))));
  }
  return views;
}

ProbeCapture::ProbeCapture(Context& context, const ShaderLibrary& shaders, const GpuScene& scene,
                           const ProbeCaptureInfo& info)
    : context_(context),
      scene_(scene),
      targets_(context.device(), gpu::PROBE_SIDE, gpu::PROBE_SIDE),
      data_(context.device(), info.light_capacity, info.decal_capacity),
      geometry_(context.device(), shaders),
      no_shadows_(context.device()),
      no_captures_(std::make_unique<ProbeAtlas>(context, shaders, 0)),
      no_probes_(context, *no_captures_),
      no_still_(context),
      lighting_(context.device(), shaders, lighting_info(info, scene)),
      face_(face_pipeline(context.device(), shaders)),
      depths_{targets_.depth.sampled()} {
  assert(scene.captured() == nullptr && "a captured frame is seen from one place alone");
  if (!info.shadows) return;
  ShadowSettings settings = *info.shadows;
  settings.budget_texels = ALL_TEXELS;
  shadows_.emplace(context, shaders, scene, settings, info.light_capacity);
}

void ProbeCapture::set(std::span<const shared::Light> lights, std::span<const gpu::DecalData> decals) {
  lights_ = lights;
  decals_ = decals;
}

void ProbeCapture::capture(const glm::vec3& position, const ProbeAtlas& atlas, std::uint32_t slot) {
  assert(slot < atlas.slots() && "a slot of the atlas");
  const std::vector<View> views = probe_views(position);
  data_.set({views.data(), 1}, lights_, decals_);
  if (shadows_) {
    shadows_->restart();
    shadows_->schedule(views, lights_);
  }
  for (std::uint32_t face = 0; face < gpu::PROBE_FACES; ++face) draw_face(face, views, atlas);
  context_.submit([&](VkCommandBuffer commands) {
    vulkan::Recorder recorder(context_.device(), commands, tracker_);
    tracker_.assume(atlas.image().sampled());
    atlas.record(recorder, slot);
  });
}

LightingFrame ProbeCapture::frame(const View& view, bool culled) const {
  const vulkan::PlanInputs inputs = data_.plan_inputs(depths_);
  return {.scene = scene_,
          .data = data_,
          .targets = targets_,
          .geometry = geometry_,
          .inputs = inputs,
          .views = {&view, 1},
          .eye = glm::vec3(glm::dmat4(view.world_from_view())[3]),
          .shadows = shadows_ ? shadows_->bound() : no_shadows_.bound(),
          .still = no_still_.words(),
          .probes = no_probes_.bound(),
          .culled = culled};
}

void ProbeCapture::draw_face(std::uint32_t face, std::span<const View> views, const ProbeAtlas& atlas) {
  const bool culled = face != 0 && lighting_.info().method->any_point;
  if (!culled) ++culls_;
  data_.set_view(views[face]);
  context_.submit([&](VkCommandBuffer commands) {
    vulkan::Recorder recorder(context_.device(), commands, tracker_);
    data_.record_upload(recorder);
    if (shadows_) shadows_->record(recorder);
    lighting_.record(recorder, frame(views[face], culled));
    record_face(recorder, face, atlas);
  });
  lighting_.finish();
}

void ProbeCapture::record_face(vulkan::Recorder& recorder, std::uint32_t face, const ProbeAtlas& atlas) {
  constexpr VkPipelineStageFlags2 COMPUTE = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  const vulkan::Resource picture = targets_.hdr.storage();
  const vulkan::Resource faces = vulkan::Resource::storage(atlas.faces().handle());
  const gpu::ProbePush push{.level = face};
  recorder.begin_pass(
      "probe face",
      std::vector<vulkan::Use>{reads(data_.frame(), COMPUTE),
                               reads(targets_.depth.sampled(), COMPUTE),
                               {.resource = picture, .stages = COMPUTE, .access = VK_ACCESS_2_SHADER_STORAGE_READ_BIT},
                               {.resource = faces, .stages = COMPUTE, .access = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT}});
  recorder.bind(
      face_, std::vector<vulkan::Bound>{{0, data_.frame()}, {1, targets_.depth.sampled()}, {2, picture}, {3, faces}});
  vkCmdPushConstants(recorder.commands(), face_.layout(), VK_SHADER_STAGE_ALL, 0, sizeof(push), &push);
  vkCmdDispatch(recorder.commands(), gpu::PROBE_SIDE / GROUP_PX, gpu::PROBE_SIDE / GROUP_PX, 1);
  recorder.end_pass();
}

}  // namespace lamp::app
