// Packs and uploads probes.
// SPDX-License-Identifier: Apache-2.0
#include "render/probe_set.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <utility>

#include "error.h"
#include "gpu/transfer.h"
#include "scene/procedural_random.h"

namespace lamp::app {
namespace {

bool finite(const glm::vec3& v) { return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z); }

shared::OrientedBox box_at(const Probe& probe, const glm::vec3& center, const glm::vec3& half_extents) {
  const glm::mat3 axes = glm::mat3_cast(glm::normalize(probe.orientation));
  return {.center = center, .axis_x = axes[0], .axis_y = axes[1], .axis_z = axes[2], .half_extents = half_extents};
}

/// A colour to know a probe by.
glm::vec3 flat_radiance(std::uint32_t slot) {
  procedural::Random random(slot);
  const float red = random.between(0.05F, 1.0F);
  const float green = random.between(0.05F, 1.0F);
  return {red, green, random.between(0.05F, 1.0F)};
}

gpu::ProbeData packed(const Probe& probe, std::uint32_t slot) {
  return {.volume = box_at(probe, probe.center, probe.half_extents),
          .parallax_center = probe.parallax_center,
          .parallax_half_extents = probe.parallax_half_extents,
          .capture = probe.capture,
          .blend = probe.blend_m,
          .ellipsoid = probe.shape == ProbeShape::ellipsoid ? 1U : 0U,
          .slot = slot,
          .flat_radiance = flat_radiance(slot)};
}

}  // namespace

std::vector<gpu::ProbeData> pack(const std::vector<Probe>& probes) {
  std::vector<gpu::ProbeData> ordered;
  ordered.reserve(probes.size());
  for (const std::uint32_t i : by_volume(probes)) ordered.push_back(packed(probes[i], i));
  return ordered;
}

std::vector<shared::OrientedBox> boxes_of(std::span<const gpu::ProbeData> probes) {
  std::vector<shared::OrientedBox> boxes;
  boxes.reserve(probes.size());
  std::ranges::transform(probes, std::back_inserter(boxes), &gpu::ProbeData::volume);
  return boxes;
}

EntityShape shape_of(const gpu::ProbeData& probe) {
  return probe.ellipsoid != 0 ? EntityShape::ellipsoid : EntityShape::box;
}

std::vector<EntityShape> shapes_of(std::span<const gpu::ProbeData> probes) {
  std::vector<EntityShape> shapes;
  shapes.reserve(probes.size());
  std::ranges::transform(probes, std::back_inserter(shapes), shape_of);
  return shapes;
}

std::optional<lamp::Error> check_probes(const std::vector<Probe>& probes) {
  for (std::size_t i = 0; i < probes.size(); ++i) {
    const Probe& probe = probes[i];
    const std::string name = fmt::format("probe {}", i);
    const shared::OrientedBox volumes[] = {box_at(probe, probe.center, probe.half_extents),
                                           box_at(probe, probe.parallax_center, probe.parallax_half_extents)};
    for (std::size_t k = 0; k < 2; ++k)
      if (const auto error = check_boxes({&volumes[k], 1}))
        return lamp::Error{name, (k == 0 ? "volume: " : "parallax volume: ") + error->message};
    if (!std::isfinite(probe.blend_m) || probe.blend_m < 0.0F)
      return lamp::Error{name, fmt::format("blend distance must be finite and >= 0 m, got {}", probe.blend_m)};
    if (!finite(probe.capture)) return lamp::Error{name, "the place of its capture must be finite"};
  }
  return std::nullopt;
}

ProbeSet::ProbeSet(Context& context, const ProbeAtlas& atlas, std::uint32_t kind, std::vector<gpu::ProbeData> probes)
    : kind_(kind), atlas_(&atlas), probes_(std::move(probes)) {
  const std::vector<gpu::ProbeData> nothing(1);
  const std::span<const gpu::ProbeData> records = probes_.empty() ? nothing : probes_;
  if (const std::uint64_t most = context.device().traits.max_storage_buffer_bytes; records.size_bytes() > most)
    throw Error(fmt::format("--probes: the probes take {} bytes, expected at most the {} of a buffer of this device",
                            records.size_bytes(), most));
  records_ = upload_buffer(context, "probes", std::as_bytes(records), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
}

std::vector<vulkan::Bound> ProbeSet::bound() const {
  std::vector<vulkan::Bound> bound{{BINDING_PROBES, vulkan::Resource::storage(records_.handle())}};
  const ProbeBound atlas = atlas_->bound();
  bound.insert(bound.end(), atlas.begin(), atlas.end());
  return bound;
}

vulkan::Constant mirror_limit_constant(float roughness) {
  return {CONSTANT_MIRROR_LIMIT, std::bit_cast<std::uint32_t>(roughness)};
}

void add_probes(vulkan::PipelineInfo& pipeline, std::uint32_t kind, float mirror) {
  pipeline.constants.push_back({CONSTANT_PROBES, kind});
  pipeline.constants.push_back(mirror_limit_constant(mirror));
  pipeline.bindings.push_back({BINDING_PROBES, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER});
  add_probe_atlas(pipeline);
}

}  // namespace lamp::app
