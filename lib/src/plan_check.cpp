// Finds what would fail on a device before there is one: limits, bindings to nothing, reads of what nothing wrote.
// Promise: a plan that passes can be allocated and recorded without a further check (short of running out of memory).
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <set>
#include <string>

#include "lamplight/plan.h"
#include "lamplight/shader_code.h"

namespace lamp {
namespace {

bool is_buffer(const Plan& plan, ResourceId id) {
  return id >= PLAN_BUFFER && id - PLAN_BUFFER < plan.buffers.size();
}

bool exists(const Plan& plan, ResourceId id) { return id < PLAN_BUFFER || is_buffer(plan, id); }

const BufferDesc& buffer_of(const Plan& plan, ResourceId id) { return plan.buffers[id - PLAN_BUFFER]; }

std::optional<Error> check_buffer(const BufferDesc& buffer, const DeviceTraits& traits) {
  const std::string source = "buffer " + buffer.name;
  if (buffer.bytes == 0 || buffer.bytes % 4 != 0)
    return Error{source, "size must be a positive multiple of 4 bytes, got " + std::to_string(buffer.bytes)};
  if (buffer.bytes > traits.max_storage_buffer_bytes)
    return Error{source, "needs " + std::to_string(buffer.bytes) + " bytes, the device's storage buffers hold at most " +
                             std::to_string(traits.max_storage_buffer_bytes)};
  return std::nullopt;
}

/// Walks a plan's passes in order and keeps what has been written so far.
class PassChecker {
 public:
  PassChecker(const Plan& plan, const DeviceTraits& traits) : plan_(plan), traits_(traits) {
    for (ResourceId id = 0; id < PLAN_BUFFER; ++id) written_.insert(id);
    for (std::size_t i = 0; i < plan.buffers.size(); ++i)
      if (plan.buffers[i].zeroed) written_.insert(PLAN_BUFFER + static_cast<ResourceId>(i));
  }

  std::optional<Error> check(const Pass& pass) {
    const std::string source = "pass " + pass.name;
    if (auto error = check_kind(source, pass)) return error;
    if (auto error = check_extent(source, pass)) return error;
    return check_bindings(source, pass.bindings);
  }

  std::optional<Error> check_lookup(const LookUp& lookup) {
    for (const Binding& binding : lookup.bindings)
      if (binding.access != Access::read) return Error{"look-up " + lookup.name, "its bindings must be read-only"};
    return check_bindings("look-up " + lookup.name, lookup.bindings);
  }

 private:
  std::optional<Error> check_kind(const std::string& source, const Pass& pass) {
    if (pass.kind == PassKind::host) {
      if (gpu_began_) return Error{source, "host passes must come before every GPU pass"};
      if (pass.host == nullptr) return Error{source, "has no host function"};
      for (const Binding& binding : pass.bindings)
        if (!is_buffer(plan_, binding.resource) || buffer_of(plan_, binding.resource).memory != BufferMemory::upload)
          return Error{source, "host passes may bind upload buffers only"};
      return std::nullopt;
    }
    gpu_began_ = true;
    if (find_shader(library_shaders(), pass.shader) == nullptr)
      return Error{source, "there is no shader named '" + pass.shader + "'"};
    if (pass.kind == PassKind::raster) return check_raster(source, pass.raster);
    return std::nullopt;
  }

  std::optional<Error> check_raster(const std::string& source, const RasterState& raster) const {
    if (find_shader(library_shaders(), raster.vertex_shader) == nullptr)
      return Error{source, "there is no shader named '" + raster.vertex_shader + "'"};
    if (raster.width == 0 || raster.height == 0 || raster.width > traits_.max_image_size ||
        raster.height > traits_.max_image_size)
      return Error{source, "viewport must be 1 to " + std::to_string(traits_.max_image_size) + " pixels a side, got " +
                               std::to_string(raster.width) + "x" + std::to_string(raster.height)};
    return std::nullopt;
  }

  std::optional<Error> check_extent(const std::string& source, const Pass& pass) {
    const Extent& extent = pass.extent;
    if (extent.indirect != NO_RESOURCE) {
      if (!is_buffer(plan_, extent.indirect) || !buffer_of(plan_, extent.indirect).indirect)
        return Error{source, "indirect counts must come from a buffer of the plan that is marked indirect"};
      if (extent.indirect_offset % 4 != 0 || extent.indirect_offset + 16 > buffer_of(plan_, extent.indirect).bytes)
        return Error{source, "indirect offset " + std::to_string(extent.indirect_offset) + " is outside its buffer"};
      return check_bindings(source, {{{extent.indirect, Access::read}}});
    }
    if (pass.kind != PassKind::compute) return std::nullopt;
    const std::uint32_t per_group = extent.lights_per_group;
    const std::uint32_t for_lights = per_group == 0 ? 0 : (plan_.light_capacity + per_group - 1) / per_group;
    const std::uint32_t counts[3] = {std::max(extent.x, for_lights), extent.y, extent.z};
    for (int axis = 0; axis < 3; ++axis)
      if (counts[axis] == 0 || counts[axis] > traits_.max_groups[axis])
        return Error{source, "needs " + std::to_string(counts[axis]) + " work groups along axis " + std::to_string(axis) +
                                 ", the device takes 1 to " + std::to_string(traits_.max_groups[axis])};
    return std::nullopt;
  }

  std::optional<Error> check_bindings(const std::string& source, const std::vector<Binding>& bindings) {
    for (std::size_t i = 0; i < bindings.size(); ++i) {
      const Binding& binding = bindings[i];
      if (!exists(plan_, binding.resource))
        return Error{source, "binding " + std::to_string(i) + " names resource " + std::to_string(binding.resource) +
                                 ", which does not exist"};
      if (binding.access != Access::read && binding.resource < PLAN_BUFFER)
        return Error{source, "binding " + std::to_string(i) + " writes to an input"};
      if (binding.access != Access::write && !written_.contains(binding.resource))
        return Error{source, "binding " + std::to_string(i) + " reads buffer " +
                                 buffer_of(plan_, binding.resource).name + ", which nothing has written"};
    }
    for (const Binding& binding : bindings)
      if (binding.access != Access::read) written_.insert(binding.resource);
    return std::nullopt;
  }

  const Plan& plan_;
  const DeviceTraits& traits_;
  std::set<ResourceId> written_;
  bool gpu_began_ = false;
};

std::optional<Error> check_passes(const Plan& plan, const std::vector<Pass>& passes, const LookUp& lookup,
                                  const DeviceTraits& traits) {
  PassChecker checker(plan, traits);
  for (const Pass& pass : passes)
    if (auto error = checker.check(pass)) return error;
  return checker.check_lookup(lookup);
}

}  // namespace

std::optional<Error> plan_check(const Plan& plan, const DeviceTraits& traits) {
  for (const BufferDesc& buffer : plan.buffers)
    if (auto error = check_buffer(buffer, traits)) return error;
  if (plan.counters != NO_RESOURCE && !is_buffer(plan, plan.counters))
    return Error{"counters", "must be a buffer of the plan"};
  if (plan.cells == 0) return Error{"cells", "a look-up has at least one cell"};
  if (auto error = check_passes(plan, plan.passes, plan.lookup, traits)) return error;
  if (!plan.fused) return std::nullopt;
  const FusedLookUp& fused = *plan.fused;
  if (fused.group_width * fused.group_height == 0 ||
      fused.group_width * fused.group_height > traits.max_group_invocations)
    return Error{"fused look-up " + fused.lookup.name,
                 "its work group must have 1 to " + std::to_string(traits.max_group_invocations) + " threads"};
  return check_passes(plan, fused.passes, fused.lookup, traits);
}

}  // namespace lamp
