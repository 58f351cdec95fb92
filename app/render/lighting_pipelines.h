// How a picture is lit: one method, one shading path; and the pipelines that it takes.
// Promise: they are made from a plan alone, before any buffer or image is there.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "lamplight/method.h"
#include "lamplight/shadow_atlas.h"
#include "render/host_depth.h"
#include "render/shader_library.h"

namespace lamp::app {

enum class ShadingPath : std::uint8_t {
  forward,            ///< Forward+: fragments walk their cell
  tiled_deferred,     ///< one fused dispatch where the method has one and there are no decals, else as `deferred`
  deferred,           ///< cull, then shade in compute
  standard_deferred,  ///< no cull: one volume a light, added up by blending
};
/// Of all shaders that shade: a Brdf (common/brdf.glsl).
inline constexpr std::uint32_t CONSTANT_BRDF = 10;
enum class Brdf : std::uint32_t { ggx = 0, blinn_phong = 1 };

/// "forward", "tiled-deferred", "deferred", "standard-deferred", in the order of ShadingPath.
[[nodiscard]] std::span<const std::string_view> path_names();

/// Rows of a picture; 0 rows: all of it.
struct Rows {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

/// Who records the cull, and of what size its buffers are: hosts differ in that.
enum class Host : std::uint8_t {
  plan,           ///< a plan runner, made for the frame's size
  culler,         ///< a Culler, made for it
  host_barriers,  ///< likewise, between barriers of its host's
  larger_plan,    ///< a plan runner for frames twice as wide and high
  changing_size,  ///< likewise, and no frame has the size of the one before
};
/// "plan", "culler", "host-barriers", "larger-plan", "changing-size", in the order of Host.
[[nodiscard]] std::span<const std::string_view> host_names();
[[nodiscard]] bool has_culler(Host host);

struct LightingInfo {
  const Method* method = nullptr;
  Options options;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t light_capacity = 0;  ///< decals and probes included
  ShadingPath path = ShadingPath::deferred;
  Brdf brdf = Brdf::ggx;
  HostDepth depth;  ///< of the frames
  Host host = Host::plan;
  bool transparency = false;            ///< the scene has blended surfaces
  bool captured = false;                ///< the scene is a captured frame
  bool decals = false;                  ///< the frames have decals
  std::uint32_t probes = 0;             ///< what probes of the frames show (probe_data.h); 0: there are none
  float mirror = 0.0F;                  ///< where there are probes: MirrorSettings::roughness of the frames
  std::optional<ShadowFilter> shadows;  ///< lights cast shadows, filtered so
  std::uint32_t still = 0;              ///< how lights that stand still are looked up (still_data.h)
  /// Of the options, those that room was made with, for what did not fit with the ones asked for.
  std::vector<std::pair<std::string, std::string>> grown;
  /// Of the lists that transparent surfaces have of their own (AnyDepthPlan), where room was made for what did not fit.
  std::optional<Options> any_depth_options;
  /// What is shaded: a reference picture may need a part alone. `first` is a multiple of 8; not with a fused look-up.
  Rows shaded;
};

[[nodiscard]] Problem problem_of(const LightingInfo& info, const DeviceTraits& traits);
/// A method's plan for these traits, or its error thrown.
[[nodiscard]] Plan plan_or_throw(const LightingInfo& info, const vulkan::Device& device);
/// A plan whose look-up holds at any depth of a pixel, and what it was made of.
struct AnyDepthPlan {
  const Method* method = nullptr;
  Problem problem;
  Plan plan;
};
/// The plan whose look-up transparent surfaces walk, if that of `plan` does not hold at any depth.
[[nodiscard]] std::optional<AnyDepthPlan> any_depth_plan(const LightingInfo& info, const Plan& plan,
                                                         const vulkan::Device& device);

/// Whether shaders ask which of several views they draw (common/shown_view.glsl).
[[nodiscard]] vulkan::Constant shown_view_constant(const Plan& plan);

/// Whether one dispatch culls and shades.
[[nodiscard]] bool is_fused(const LightingInfo& info, const Plan& plan);

/// Threads of a work group of deferred shading, along x and y.
[[nodiscard]] glm::uvec2 shade_group(const LightingInfo& info, const Plan& plan);

/// Of opaque surfaces, by their path.
[[nodiscard]] vulkan::Pipeline shading_pipeline(const vulkan::Device& device, const ShaderLibrary& shaders,
                                                const LightingInfo& info, const Plan& plan);
/// Of standard deferred shading's light volumes.
[[nodiscard]] vulkan::Pipeline volumes_pipeline(const vulkan::Device& device, const ShaderLibrary& shaders,
                                                const LightingInfo& info);
/// Of surfaces that are blended over the opaque ones.
[[nodiscard]] vulkan::Pipeline transparent_pipeline(const vulkan::Device& device, const ShaderLibrary& shaders,
                                                    const LightingInfo& info, const Plan& any_depth);

}  // namespace lamp::app
