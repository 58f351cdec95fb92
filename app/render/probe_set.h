// The reflection probes of a renderer's frames, on the GPU, and what shading binds of them.
// Promise: in the order of their ids (by_volume, scene/probe.h); a slot is the number of a probe as it was made.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "gpu/context.h"
#include "lamplight/entity.h"
#include "lamplight/vulkan.h"
#include "render/probe_atlas.h"
#include "render/shaders/probe_data.h"
#include "scene/probe.h"

namespace lamp::app {

/// Constants and bindings of common/probes.glsl, besides those of the atlas.
inline constexpr std::uint32_t CONSTANT_PROBES = 20;
inline constexpr std::uint32_t CONSTANT_MIRROR_LIMIT = 21;
inline constexpr std::uint32_t BINDING_PROBES = 30;

/// The GPU's records of probes, in the order of their ids.
[[nodiscard]] std::vector<gpu::ProbeData> pack(const std::vector<Probe>& probes);
/// Their volumes, for the oracle and for the light buffer.
[[nodiscard]] std::vector<shared::OrientedBox> boxes_of(std::span<const gpu::ProbeData> probes);
[[nodiscard]] EntityShape shape_of(const gpu::ProbeData& probe);
[[nodiscard]] std::vector<EntityShape> shapes_of(std::span<const gpu::ProbeData> probes);
/// The first probe that cannot be, by its number as it was made ("probe 3: ..."); or nothing.
[[nodiscard]] std::optional<lamp::Error> check_probes(const std::vector<Probe>& probes);

class ProbeSet {
 public:
  /// No probe. `atlas`: what is bound in place of captures, which must live on.
  ProbeSet(Context& context, const ProbeAtlas& atlas) : ProbeSet(context, atlas, gpu::PROBES_OFF, {}) {}
  /// `kind`: what they show, PROBES_FLAT or PROBES_CAPTURED. Throws Error where the device has no such buffer.
  ProbeSet(Context& context, const ProbeAtlas& atlas, std::uint32_t kind, std::vector<gpu::ProbeData> probes);

  [[nodiscard]] std::uint32_t kind() const { return kind_; }
  [[nodiscard]] std::span<const gpu::ProbeData> probes() const { return probes_; }
  /// Records and captures, as shading binds and reads them.
  [[nodiscard]] std::vector<vulkan::Bound> bound() const;

 private:
  std::uint32_t kind_;
  const ProbeAtlas* atlas_;
  std::vector<gpu::ProbeData> probes_;
  vulkan::Buffer records_;
};

/// Probes that show a colour each: nothing is captured.
struct FlatProbes {
  FlatProbes(Context& context, const ShaderLibrary& shaders, std::vector<gpu::ProbeData> probes)
      : no_captures(context, shaders, 0), set(context, no_captures, gpu::PROBES_FLAT, std::move(probes)) {}
  FlatProbes(const FlatProbes&) = delete;
  FlatProbes& operator=(const FlatProbes&) = delete;

  ProbeAtlas no_captures;
  ProbeSet set;  ///< refers to it
};

/// Adds the constants and the bindings to those of a pipeline that shades with probes of a kind, or without
/// (PROBES_OFF), and leaves the reflection of surfaces that are less rough than `mirror` to rays; 0: of none.
void add_probes(vulkan::PipelineInfo& pipeline, std::uint32_t kind, float mirror = 0.0F);
/// As a constant of a shader.
[[nodiscard]] vulkan::Constant mirror_limit_constant(float roughness);

}  // namespace lamp::app
