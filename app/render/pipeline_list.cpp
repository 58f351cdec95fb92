// Plans, and makes the pipelines of each plan and of each path through it.
// SPDX-License-Identifier: Apache-2.0
#include "render/pipeline_list.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "gpu/check.h"
#include "render/decal_pass.h"
#include "render/geometry.h"
#include "render/lighting_pipelines.h"
#include "render/mirror_pass.h"
#include "render/probe_atlas.h"
#include "render/probe_set.h"
#include "render/still_lists.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t LIGHTS = 1U << 15;  // llvmpipe's loops end after twice as many
constexpr std::uint32_t MANY_LIGHTS = 1U << 20;
constexpr std::uint64_t LEAST_BUFFER_BYTES = 1U << 30;  // of a device that has enough
constexpr std::uint32_t BVH_STACK = 40;                 // of a large scene

class PipelineLister {
 public:
  PipelineLister(const vulkan::Device& device, const ShaderLibrary& shaders) : device_(device), shaders_(shaders) {
    device_.pipelines = &store_;
    // A driver without hardware has no memory, and some buffers are small. Nothing is put into any here, so plans are
    // those of a device that has enough.
    if (device_.traits.memory_bytes == 0) device_.traits.memory_bytes = DeviceTraits().memory_bytes;
    device_.traits.max_storage_buffer_bytes = std::max(device_.traits.max_storage_buffer_bytes, LEAST_BUFFER_BYTES);
    Geometry geometry(device_, shaders);
    geometry.need_triangles(device_, shaders);
    for (const vulkan::Pipeline& pipeline : geometry.pipelines()) add("", pipeline);
    for (const vulkan::Pipeline& pipeline : ProbeAtlas::pipelines(device_, shaders)) add("", pipeline);
    for (const Brdf brdf : {Brdf::ggx, Brdf::blinn_phong}) {
      const LightingInfo info{.path = ShadingPath::standard_deferred, .brdf = brdf};
      add(use_of(info), volumes_pipeline(device_, shaders, info));
    }
  }

  void add_mirrors() {
    for (const MirrorLists lists : {MirrorLists::world_cells, MirrorLists::ikkala_grid, MirrorLists::brute_force}) {
      const MirrorInfo info{
          .settings = {.roughness = 1.0F, .lists = lists}, .width = 1920, .height = 1080, .light_capacity = LIGHTS};
      const Plan plan = mirror_plan(device_, info);
      MirrorPipelines made = mirror_pipelines(device_, shaders_, info, plan, BVH_STACK);
      for (vulkan::Pipeline* pipeline : {&made.trace, &made.surfaces, &made.shade, &made.walk})
        add(std::string("mirror, ") + std::string(mirror_list_names()[static_cast<std::size_t>(lists)]),
            std::move(*pipeline));
    }
  }

  void add_defaults(const Method& method) {
    name(method.name, "");
    LightingInfo info = info_of(method, {});
    const Plan plan = plan_or_throw(info, device_);
    add_passes(plan);
    for (const Brdf brdf : {Brdf::ggx, Brdf::blinn_phong}) {
      info.brdf = brdf;
      add_paths(info, plan);
    }
    info.brdf = Brdf::ggx;
    add_path(info, ShadingPath::standard_deferred, plan);
    info.captured = true;
    add_path(info, ShadingPath::forward, plan);
    info.captured = false;
    info.decals = true;
    add_paths(info, plan);
    add("", decal_pipeline(device_, shaders_, plan));
    info.decals = false;
    info.probes = gpu::PROBES_CAPTURED;
    info.mirror = 1.0F;  // which asks for more registers than probes alone
    add_paths(info, plan);
    info.probes = gpu::PROBES_OFF;
    info.mirror = 0.0F;
    for (const std::uint32_t still : {gpu::STILL_TRIANGLES, gpu::STILL_TREE}) {
      info.still = still;
      add_path(info, ShadingPath::forward, plan);
      add_path(info, ShadingPath::deferred, plan);
    }
    add_passes_of_many_lights(method, {});
  }

  void add_option(const Method& method, const std::string& setting) {
    name(method.name, setting);
    const LightingInfo info = info_of(method, {setting});
    const Result<Plan> plan = make_plan(method, problem_of(info, device_.traits));
    if (!plan) return;
    add_passes(plan.value());
    add_paths(info, plan.value());
    add_passes_of_many_lights(method, {setting});
  }

  std::vector<ListedPipeline> take_all() { return std::move(listed_); }

 private:
  static LightingInfo info_of(const Method& method, const std::vector<std::string>& settings) {
    return {.method = &method,
            .options = take(resolve_options(method, settings)),
            .width = 1920,
            .height = 1080,
            .light_capacity = LIGHTS};
  }

  void name(std::string_view method, std::string_view option) {
    method_ = method;
    option_ = option;
  }

  /// "forward, Blinn-Phong"
  static std::string use_of(const LightingInfo& info) {
    std::string use(path_names()[static_cast<std::size_t>(info.path)]);
    if (info.brdf == Brdf::blinn_phong) use += ", Blinn-Phong";
    if (info.captured) use += ", captured";
    if (info.decals) use += ", decals";
    if (info.probes != gpu::PROBES_OFF) use += ", probes";
    if (info.still == gpu::STILL_TRIANGLES) use += ", triangle lists";
    if (info.still == gpu::STILL_TREE) use += ", world tree";
    return use;
  }

  void add(const std::string& use, vulkan::Pipeline pipeline) {
    if (seen_.insert(pipeline.handle()).second) listed_.push_back({method_, option_, use, std::move(pipeline)});
  }

  void add_passes(const std::vector<Pass>& passes, const std::string& use) {
    for (const Pass& pass : passes)
      if (pass.kind != PassKind::host) add(use, take(vulkan::make_pipeline(device_, pass, shaders_.source())));
  }

  void add_passes(const Plan& plan, const std::string& use = "") {
    add_passes(plan.passes, use);
    if (plan.fused) add_passes(plan.fused->passes, use);
  }

  /// Some methods have other passes then. Some cannot have so many on this device.
  void add_passes_of_many_lights(const Method& method, const std::vector<std::string>& settings) {
    LightingInfo info = info_of(method, settings);
    info.light_capacity = MANY_LIGHTS;
    const Result<Plan> plan = make_plan(method, problem_of(info, device_.traits));
    if (plan) add_passes(plan.value(), fmt::format("{} lights", MANY_LIGHTS));
  }

  void add_path(LightingInfo info, ShadingPath path, const Plan& plan) {
    info.path = path;
    add(use_of(info), shading_pipeline(device_, shaders_, info, plan));
  }

  /// The paths that walk a look-up.
  void add_paths(LightingInfo info, const Plan& plan) {
    for (const ShadingPath path : {ShadingPath::deferred, ShadingPath::tiled_deferred, ShadingPath::forward})
      add_path(info, path, plan);
    const std::optional<AnyDepthPlan> any_depth = any_depth_plan(info, plan, device_);
    if (any_depth) add_passes(any_depth->plan);
    info.path = ShadingPath::forward;
    add(use_of(info), transparent_pipeline(device_, shaders_, info, any_depth ? any_depth->plan : plan));
  }

  vulkan::PipelineStore store_;
  vulkan::Device device_;
  const ShaderLibrary& shaders_;
  std::string method_;  ///< whose pipelines are added now
  std::string option_;
  std::vector<ListedPipeline> listed_;
  std::set<VkPipeline> seen_;
};

}  // namespace

std::vector<ListedPipeline> list_pipelines(const vulkan::Device& device, const ShaderLibrary& shaders,
                                           std::span<const Method> of) {
  PipelineLister lister(device, shaders);
  lister.add_mirrors();
  for (const Method& method : of) lister.add_defaults(method);
  for (const Method& method : of)
    for (const OptionSpec& spec : method.options)
      for (const std::string& value : sample_values(spec))
        lister.add_option(method, fmt::format("{}={}", spec.key, value));
  return lister.take_all();
}

}  // namespace lamp::app
