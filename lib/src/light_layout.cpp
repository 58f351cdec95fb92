// Where the lights of a host lie: bytes, and what cannot be read.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/light_layout.h"

#include <string>

namespace lamp {
namespace {

/// Shaders read 16 bytes at once.
constexpr std::uint32_t UNIT = 16;

std::uint32_t record_bytes(LightForm form) {
  return form == LightForm::record ? sizeof(shared::Light) : sizeof(shared::LightReach);
}

std::uint32_t stride_of(const RecordPlaces& places, std::uint32_t record) {
  return places.stride == 0 ? record : places.stride;
}

std::uint64_t bytes_of(const RecordPlaces& places, std::uint32_t record, std::uint64_t count) {
  return count == 0 ? 0 : places.offset + (count - 1) * stride_of(places, record) + record;
}

std::optional<Error> check_places(const std::string& which, const RecordPlaces& places, std::uint32_t record) {
  if (places.offset % UNIT != 0)
    return Error{which + " offset", "expected a multiple of 16 bytes, got " + std::to_string(places.offset)};
  const std::uint32_t stride = stride_of(places, record);
  if (stride % UNIT != 0 || stride < record)
    return Error{which + " stride", "expected a multiple of 16 bytes, at least " + std::to_string(record) + ", got " +
                                        std::to_string(stride)};
  return std::nullopt;
}

}  // namespace

LightLayout LightLayout::interleaved(std::size_t record_bytes, std::size_t position_at,
                                     std::optional<std::size_t> direction_at) {
  const auto stride = static_cast<std::uint32_t>(record_bytes);
  LightLayout layout{.form = LightForm::points, .lights = {static_cast<std::uint32_t>(position_at), stride}};
  if (!direction_at) return layout;
  layout.form = LightForm::spots;
  layout.cones = {static_cast<std::uint32_t>(*direction_at), stride};
  return layout;
}

bool LightLayout::is_standard() const {
  return form == LightForm::record && lights.offset == 0 && light_stride() == sizeof(shared::Light);
}

std::uint32_t LightLayout::light_stride() const { return stride_of(lights, record_bytes(form)); }

std::uint32_t LightLayout::cone_stride() const { return stride_of(cones, sizeof(shared::LightCone)); }

std::uint64_t LightLayout::light_bytes(std::uint64_t count) const {
  return bytes_of(lights, record_bytes(form), count);
}

std::uint64_t LightLayout::cone_bytes(std::uint64_t count) const {
  return form == LightForm::spots ? bytes_of(cones, sizeof(shared::LightCone), count) : 0;
}

std::optional<Error> LightLayout::check() const {
  if (form != LightForm::record && form != LightForm::points && form != LightForm::spots)
    return Error{"light form",
                 "expected record, points or spots, got " + std::to_string(static_cast<std::uint32_t>(form))};
  if (auto error = check_places("light", lights, record_bytes(form))) return error;
  return form == LightForm::spots ? check_places("cone", cones, sizeof(shared::LightCone)) : std::nullopt;
}

}  // namespace lamp
