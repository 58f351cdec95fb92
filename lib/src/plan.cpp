// Plans: adding buffers, counting bytes, who binds what.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/plan.h"

#include <algorithm>

namespace lamp {
namespace {

bool binds_any(const std::vector<Binding>& bindings, ResourceId id) {
  return std::ranges::find(bindings, id, &Binding::resource) != bindings.end();
}

bool binds_any(const std::vector<Pass>& passes, ResourceId id) {
  return std::ranges::any_of(passes, [id](const Pass& pass) { return binds_any(pass.bindings, id); });
}

std::uint64_t divide_up(std::uint64_t value, std::uint64_t by) { return (value + by - 1) / by; }

}  // namespace

std::array<std::uint64_t, 3> Extent::counts(std::uint32_t width, std::uint32_t height, std::uint32_t lights) const {
  // Of a draw, the lights are its instances.
  if (lights_per_group != 0) return {divide_up(lights, lights_per_group), y, z};
  if (cells_per_group != 0) return {divide_up(cells.count(width, height), cells_per_group) + x, y, z};
  if (cells.px != 0) return {cells.across(width), cells.across(height), z};
  return {x, y, z};
}

ResourceId Plan::add(BufferDesc buffer) {
  buffers.push_back(std::move(buffer));
  return PLAN_BUFFER + static_cast<ResourceId>(buffers.size() - 1);
}

std::uint64_t Plan::view_bytes(const BufferDesc& buffer) const {
  // 256 is the largest alignment of descriptors; elements have 4, 8, 12, 16, 24, 32, 48 or 64 bytes.
  constexpr std::uint64_t UNIT = 768;
  const bool is_one = (views == 1 || buffer.all_views) && buffer.memory != BufferMemory::counts;
  return is_one ? buffer.bytes : divide_up(buffer.bytes, UNIT) * UNIT;
}

std::uint64_t Plan::all_bytes(const BufferDesc& buffer) const {
  return view_bytes(buffer) * (buffer.all_views ? 1 : views);
}

std::uint64_t Plan::bytes_of(const BufferDesc& buffer) const {
  switch (buffer.memory) {
    case BufferMemory::upload:
      return all_bytes(buffer) * (1 + frames_in_flight);
    case BufferMemory::counts:
      return all_bytes(buffer) * frames_in_flight;
    case BufferMemory::device:
      break;
  }
  return all_bytes(buffer);
}

std::uint64_t Plan::bytes() const {
  std::uint64_t sum = 0;
  for (const BufferDesc& buffer : buffers) sum += bytes_of(buffer);
  return sum;
}

std::uint32_t Plan::cell_shift(std::uint32_t frame_width, std::uint32_t frame_height) const {
  const auto fits = [&](const FinerPasses& one) {
    return one.cells.count(frame_width, frame_height) <= one.most_cells;
  };
  const auto finest = std::ranges::find_if(finer, fits);
  return finest == finer.end() ? 0 : finest->shift;
}

bool Plan::binds(ResourceId id) const {
  return binds_any(passes, id) || binds_any(lookup.bindings, id) ||
         (fused && (binds_any(fused->passes, id) || binds_any(fused->lookup.bindings, id)));
}

}  // namespace lamp
