// Finds what would fail on a device before there is one: limits, bindings to nothing, reads of what nothing wrote.
// Promise: a plan that passes can be allocated and recorded without a further check (short of running out of memory).
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <set>
#include <string>
#include <tuple>

#include "check_traits.h"
#include "lamplight/plan.h"
#include "lamplight/shader_code.h"
#include "lamplight/shared/counters.h"

namespace lamp {
namespace {

// Bytes that one indirect command reads: VkDispatchIndirectCommand, VkDrawIndirectCommand.
constexpr std::uint64_t DISPATCH_BYTES = 12;
constexpr std::uint64_t DRAW_BYTES = 16;

bool is_buffer(const Plan& plan, ResourceId id) { return id >= PLAN_BUFFER && id - PLAN_BUFFER < plan.buffers.size(); }

bool exists(const Plan& plan, ResourceId id) { return id < PLAN_BUFFER || is_buffer(plan, id); }

const BufferDesc& buffer_of(const Plan& plan, ResourceId id) { return plan.buffers[id - PLAN_BUFFER]; }

bool is_upload(const Plan& plan, ResourceId id) {
  return is_buffer(plan, id) && buffer_of(plan, id).memory == BufferMemory::upload;
}

std::optional<Error> check_bytes(const std::string& source, std::uint64_t bytes, const DeviceTraits& traits) {
  if (bytes <= traits.max_storage_buffer_bytes) return std::nullopt;
  return Error{source, "needs " + std::to_string(bytes) + " bytes, the device's storage buffers hold at most " +
                           std::to_string(traits.max_storage_buffer_bytes)};
}

std::optional<Error> check_buffer(const Plan& plan, const BufferDesc& buffer, const DeviceTraits& traits) {
  const std::string source = "buffer " + buffer.name;
  if (buffer.bytes == 0 || buffer.bytes % 4 != 0)
    return Error{source, "size must be a positive multiple of 4 bytes, got " + std::to_string(buffer.bytes)};
  // Zeros are written on the device, after host passes have run: they would erase what those wrote.
  if (buffer.memory == BufferMemory::upload && buffer.begins_at_zero())
    return Error{source, "an upload buffer cannot be zeroed; its host pass writes all of it"};
  const CellGrid& cells = buffer.zeroed_cells;
  if (cells.px != 0 &&
      (buffer.cell_bytes % 4 != 0 || cells.count(plan.width, plan.height) * buffer.cell_bytes < buffer.bytes))
    return Error{source, "the cells that are zeroed must be all of it, in the largest picture"};
  return check_bytes(source, plan.all_bytes(buffer), traits);
}

std::optional<Error> check_shared(const std::string& source, std::uint64_t bytes, const DeviceTraits& traits) {
  if (bytes <= traits.shared_memory_bytes) return std::nullopt;
  return Error{source, "needs " + std::to_string(bytes) + " bytes of shared memory, the device has " +
                           std::to_string(traits.shared_memory_bytes)};
}

/// Of a compute pass whose shader there is.
std::optional<Error> check_shared(const std::string& source, const Pass& pass, const DeviceTraits& traits) {
  return check_shared(source, shared_bytes(find_shader(library_shaders(), pass.shader)->spirv, pass.constants), traits);
}

std::optional<Error> check_storage_buffers(const std::string& source, const std::vector<Binding>& bindings,
                                           const DeviceTraits& traits) {
  const auto buffers = std::ranges::count_if(bindings, [](const Binding& b) { return b.resource != INPUT_DEPTH; });
  if (buffers <= traits.max_storage_buffers) return std::nullopt;
  return Error{source, "binds " + std::to_string(buffers) + " storage buffers, a shader on this device sees at most " +
                           std::to_string(traits.max_storage_buffers)};
}

std::optional<Error> check_subgroups(const std::string& source, const SubgroupOperations& asks,
                                     const SubgroupOperations& has) {
  const std::tuple<bool, bool, const char*> operations[] = {
      {asks.vote, has.vote, "votes"},
      {asks.ballot, has.ballot, "ballot"},
      {asks.arithmetic, has.arithmetic, "arithmetic"},
      {asks.shuffle, has.shuffle, "shuffle"},
      {asks.shuffle_relative, has.shuffle_relative, "relative shuffle"}};
  for (const auto& [asked, there, name] : operations)
    if (asked && !there)
      return Error{source, std::string("its shader needs the subgroup operation ") + name + ", which the device lacks"};
  return std::nullopt;
}

/// The stage is the extension of the file that the shader was built from.
std::optional<Error> check_shader(const std::string& source, const std::string& name, std::string_view extension,
                                  const SubgroupOperations& has) {
  const ShaderCode* code = find_shader(library_shaders(), name);
  if (code == nullptr) return Error{source, "there is no shader named '" + name + "'"};
  if (code->source.ends_with(extension)) return check_subgroups(source, subgroup_operations(code->spirv), has);
  return Error{source, "the shader '" + name + "' is not a " + std::string(extension) + " shader"};
}

std::optional<Error> check_full_subgroups(const std::string& source, std::uint32_t threads,
                                          const DeviceTraits& traits) {
  if (threads % traits.max_subgroup_size == 0 && threads <= traits.max_group_invocations) return std::nullopt;
  return Error{source, "its work groups of " + std::to_string(threads) + " threads must be full subgroups of up to " +
                           std::to_string(traits.max_subgroup_size) + ", and at most " +
                           std::to_string(traits.max_group_invocations) + " threads"};
}

std::optional<Error> check_raster(const std::string& source, const Plan& plan, const RasterState& raster,
                                  const DeviceTraits& traits) {
  const std::uint32_t limit = traits.max_image_size;
  const CellGrid grid{.px = std::max(1U, raster.pixel)};
  const std::uint32_t width = grid.across(plan.width);
  const std::uint32_t height = grid.across(plan.height);
  if (raster.pixel == 0) return Error{source, "a pixel of its viewport must be at least one pixel of the picture"};
  if (width == 0 || height == 0 || width > limit || height > limit)
    return Error{source, "viewport must be 1 to " + std::to_string(limit) + " pixels a side, got " +
                             std::to_string(width) + "x" + std::to_string(height)};
  if (raster.conservative && !traits.conservative_raster)
    return Error{source, "needs conservative rasterization, which the device lacks"};
  if (raster.samples != 1 && raster.samples != 4)
    return Error{source, "samples must be 1 or 4, got " + std::to_string(raster.samples)};
  return std::nullopt;
}

/// In the largest frame; smaller ones take no more.
std::optional<Error> check_groups(const std::string& source, const Plan& plan, const Extent& extent,
                                  const DeviceTraits& traits) {
  if (extent.cells_per_group != 0 && extent.cells.px == 0) return Error{source, "has groups for cells, and no cells"};
  const auto counts = extent.counts(plan.width, plan.height, std::max(1U, plan.light_capacity));
  for (std::size_t axis = 0; axis < counts.size(); ++axis)
    if (counts[axis] == 0 || counts[axis] > traits.max_groups[axis])
      return Error{source, "needs " + std::to_string(counts[axis]) + " work groups along axis " + std::to_string(axis) +
                               ", the device takes 1 to " + std::to_string(traits.max_groups[axis])};
  return std::nullopt;
}

std::optional<Error> check_capacity(const Plan& plan, const Capacity& capacity) {
  const std::string source = "capacity " + std::string(capacity.option);
  if (plan.counters == NO_RESOURCE)
    return Error{source, "what was needed must be counted, and the plan has no counters"};
  if (capacity.needed_offset % 4 != 0 || capacity.needed_offset + 4 > buffer_of(plan, plan.counters).bytes)
    return Error{source, "the count at byte " + std::to_string(capacity.needed_offset) + " is not in the counters"};
  if (capacity.per_option == 0 || capacity.entries_per_count == 0) return Error{source, "must say how it grows"};
  return std::nullopt;
}

/// In smaller pictures the same shaders work on the same buffers: what else was checked holds.
std::optional<Error> check_finer(const Plan& plan, const FinerPasses& finer, const DeviceTraits& traits) {
  const std::string source = "passes for cells of " + std::to_string(finer.cells.px) + " pixels";
  if (finer.shift == 0 || finer.cells.px == 0) return Error{source, "must be for smaller cells than the plan's"};
  if (finer.most_cells > traits.max_groups[0])
    return Error{source, "are for " + std::to_string(finer.most_cells) + " cells, the device takes " +
                             std::to_string(traits.max_groups[0]) + " work groups"};
  const auto same = [](const Pass& a, const Pass& b) {
    return a.shader == b.shader && a.kind == PassKind::compute && b.kind == PassKind::compute &&
           a.extent.indirect == b.extent.indirect && a.bindings == b.bindings;
  };
  if (!std::ranges::equal(finer.passes, plan.passes, same))
    return Error{source, "must have the shaders and bindings of the plan's, of compute passes"};
  for (const Pass& pass : finer.passes) {
    if (auto error = check_shared("pass " + pass.name, pass, traits)) return error;
    if (auto error = check_full_subgroups("pass " + pass.name, pass.full_subgroups, traits)) return error;
  }
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
    const bool host = pass.kind == PassKind::host;
    if (auto error = host ? check_host(source, pass) : check_gpu(source, pass)) return error;
    if (auto error = check_bindings(source, pass.bindings)) return error;
    for (const Binding& binding : pass.bindings)
      if (binding.access != Access::read) written_.insert(binding.resource);
    return std::nullopt;
  }

  /// `counters`: of a fused one, the one buffer that it may write.
  [[nodiscard]] std::optional<Error> check_lookup(const LookUp& lookup, ResourceId counters) const {
    const std::string source = "look-up " + lookup.name;
    if (lookup.name.empty()) return Error{"look-up", "has no name"};
    for (const Binding& binding : lookup.bindings) {
      if (binding.access != Access::read && binding.resource != counters)
        return Error{source, "its bindings must be read-only"};
      if (binding.resource == plan_.counters && is_buffer(plan_, plan_.counters) && binding.resource != counters)
        return Error{source, "binds the counters, which lie elsewhere in each frame"};
    }
    if (auto error = check_storage_buffers(source, lookup.bindings, traits_)) return error;
    return check_bindings(source, lookup.bindings);
  }

  /// After all passes.
  [[nodiscard]] std::optional<Error> check_zeros() const {
    for (std::size_t i = 0; i < plan_.buffers.size(); ++i)
      if (plan_.buffers[i].zeroed_by_pass && !written_.contains(PLAN_BUFFER + static_cast<ResourceId>(i)))
        return Error{"buffer " + plan_.buffers[i].name, "is to be zeroed by a pass, but no pass writes it"};
    return std::nullopt;
  }

 private:
  [[nodiscard]] std::optional<Error> check_host(const std::string& source, const Pass& pass) const {
    if (gpu_began_) return Error{source, "host passes must come before every GPU pass"};
    if (pass.host == nullptr) return Error{source, "has no host function"};
    for (const Binding& binding : pass.bindings)
      if (!is_upload(plan_, binding.resource)) return Error{source, "host passes may bind upload buffers only"};
    return std::nullopt;
  }

  std::optional<Error> check_gpu(const std::string& source, const Pass& pass) {
    gpu_began_ = true;
    const bool raster = pass.kind == PassKind::raster;
    for (std::size_t i = 0; i < pass.bindings.size(); ++i)
      if (pass.bindings[i].access != Access::read && is_upload(plan_, pass.bindings[i].resource))
        return Error{source, "binding " + std::to_string(i) + " writes to an upload buffer, which only the host may"};
    if (pass.on_projection_change)
      for (const Binding& binding : pass.bindings)
        if (is_buffer(plan_, binding.resource) && buffer_of(plan_, binding.resource).begins_at_zero())
          return Error{source, "is not recorded in every frame, but binds buffer " +
                                   buffer_of(plan_, binding.resource).name + ", which is zeroed in every frame"};
    if (auto error = check_views(source, pass)) return error;
    if (auto error = check_extent(source, pass)) return error;
    if (auto error = check_storage_buffers(source, pass.bindings, traits_)) return error;
    if (auto error = check_full_subgroups(source, pass.full_subgroups, traits_)) return error;
    if (!raster) {
      if (auto error = check_shader(source, pass.shader, ".comp", traits_.compute_subgroups)) return error;
      return check_shared(source, pass, traits_);
    }
    if (auto error = check_raster(source, plan_, pass.raster, traits_)) return error;
    if (auto error = check_shader(source, pass.raster.vertex_shader, ".vert", {})) return error;
    return check_shader(source, pass.shader, ".frag", traits_.fragment_subgroups);
  }

  /// What runs once writes what is there once, and touches nothing that each view has its own of.
  [[nodiscard]] std::optional<Error> check_views(const std::string& source, const Pass& pass) const {
    for (const Binding& binding : pass.bindings) {
      const bool of_views = binding.resource == INPUT_DEPTH ||
                            (is_buffer(plan_, binding.resource) && !buffer_of(plan_, binding.resource).all_views);
      if (pass.once && of_views) return Error{source, "runs once for all views, but binds what each has its own of"};
      if (!pass.once && binding.access != Access::read && !of_views && is_buffer(plan_, binding.resource))
        return Error{source, "runs for each view, but writes buffer " + buffer_of(plan_, binding.resource).name +
                                 ", which is one for all"};
    }
    return std::nullopt;
  }

  [[nodiscard]] std::optional<Error> check_extent(const std::string& source, const Pass& pass) const {
    if (pass.extent.indirect != NO_RESOURCE) return check_indirect(source, pass);
    if (pass.kind == PassKind::raster) return std::nullopt;
    return check_groups(source, plan_, pass.extent, traits_);
  }

  [[nodiscard]] std::optional<Error> check_indirect(const std::string& source, const Pass& pass) const {
    const ResourceId id = pass.extent.indirect;
    const std::uint64_t offset = pass.extent.indirect_offset;
    if (!is_buffer(plan_, id) || !buffer_of(plan_, id).indirect)
      return Error{source, "indirect counts must come from a buffer of the plan that is marked indirect"};
    const std::uint64_t needed = pass.kind == PassKind::raster ? DRAW_BYTES : DISPATCH_BYTES;
    const std::uint64_t bytes = buffer_of(plan_, id).bytes;
    if (offset % 4 != 0 || offset > bytes || bytes - offset < needed)
      return Error{source, "indirect offset " + std::to_string(offset) + " is outside its buffer"};
    if (!written_.contains(id))
      return Error{source,
                   "its indirect counts come from buffer " + buffer_of(plan_, id).name + ", which nothing has written"};
    return std::nullopt;
  }

  [[nodiscard]] std::optional<Error> check_bindings(const std::string& source,
                                                    const std::vector<Binding>& bindings) const {
    for (std::size_t i = 0; i < bindings.size(); ++i) {
      const Binding& binding = bindings[i];
      const std::string name = "binding " + std::to_string(i);
      if (!exists(plan_, binding.resource))
        return Error{source, name + " names resource " + std::to_string(binding.resource) + ", which does not exist"};
      if (binding.access != Access::read && binding.resource < PLAN_BUFFER)
        return Error{source, name + " writes to an input"};
      if (binding.access != Access::write && !written_.contains(binding.resource))
        return Error{source,
                     name + " reads buffer " + buffer_of(plan_, binding.resource).name + ", which nothing has written"};
    }
    return std::nullopt;
  }

  const Plan& plan_;
  const DeviceTraits& traits_;
  std::set<ResourceId> written_;
  bool gpu_began_ = false;
};

std::optional<Error> check_passes(const Plan& plan, const std::vector<Pass>& passes, const LookUp& lookup,
                                  ResourceId counters, const DeviceTraits& traits) {
  PassChecker checker(plan, traits);
  for (const Pass& pass : passes)
    if (auto error = checker.check(pass)) return error;
  if (auto error = checker.check_zeros()) return error;
  return checker.check_lookup(lookup, counters);
}

std::optional<Error> check_counters(const Plan& plan) {
  if (plan.counters == NO_RESOURCE) return std::nullopt;
  if (!is_buffer(plan, plan.counters)) return Error{"counters", "must be a buffer of the plan"};
  const BufferDesc& buffer = buffer_of(plan, plan.counters);
  if (buffer.memory != BufferMemory::counts || buffer.all_views)
    return Error{"counters", "must be in memory of counts, of each view"};
  if (buffer.bytes >= sizeof(shared::Counters) && buffer.begins_at_zero()) return std::nullopt;
  return Error{"counters", "must be a zeroed buffer of at least " + std::to_string(sizeof(shared::Counters)) +
                               " bytes, got " + std::to_string(buffer.bytes) +
                               (buffer.begins_at_zero() ? "" : ", not zeroed")};
}

/// A kept pass that has run with one list of passes has run for the other.
std::optional<Error> check_kept(const std::vector<Pass>& passes, const std::vector<Pass>& others) {
  for (const Pass& pass : passes)
    if (pass.on_projection_change && std::ranges::find(others, pass.name, &Pass::name) == others.end())
      return Error{"pass " + pass.name, "is kept, so the passes with and those without a fused look-up must have it"};
  return std::nullopt;
}

}  // namespace

std::optional<Error> plan_check(const Plan& plan, const DeviceTraits& traits) {
  if (auto error = check_traits(traits)) return error;
  for (const BufferDesc& buffer : plan.buffers)
    if (auto error = check_buffer(plan, buffer, traits)) return error;
  const LightLayout& layout = plan.light_layout;
  if (auto error = check_bytes("light buffer", layout.light_bytes(plan.light_capacity), traits)) return error;
  if (auto error = check_bytes("cone buffer", layout.cone_bytes(plan.light_capacity), traits)) return error;
  if (plan.bytes() > traits.memory_bytes)
    return Error{"memory", "all buffers together need " + std::to_string(plan.bytes()) + " bytes, the device has " +
                               std::to_string(traits.memory_bytes)};
  if (auto error = check_counters(plan)) return error;
  for (const Capacity& capacity : plan.capacities)
    if (auto error = check_capacity(plan, capacity)) return error;
  if (plan.cells == 0) return Error{"cells", "a look-up has at least one cell"};
  if (auto error = check_passes(plan, plan.passes, plan.lookup, NO_RESOURCE, traits)) return error;
  for (const FinerPasses& finer : plan.finer)
    if (auto error = check_finer(plan, finer, traits)) return error;
  if (!plan.fused) return std::nullopt;
  const FusedLookUp& fused = *plan.fused;
  const std::uint64_t threads = std::uint64_t{fused.group_width} * fused.group_height;
  if (threads == 0 || threads > traits.max_group_invocations)
    return Error{"fused look-up " + fused.lookup.name,
                 "its work group must have 1 to " + std::to_string(traits.max_group_invocations) + " threads"};
  if (auto error = check_shared("fused look-up " + fused.lookup.name, fused.shared_bytes, traits)) return error;
  if (auto error = check_kept(plan.passes, fused.passes)) return error;
  if (auto error = check_kept(fused.passes, plan.passes)) return error;
  return check_passes(plan, fused.passes, fused.lookup, plan.counters, traits);
}

}  // namespace lamp
