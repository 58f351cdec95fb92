// Where the lights of a host lie: bytes, and what cannot be read.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/light_layout.h"

#include <algorithm>
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

/// What does not fit 32 bits: no multiple of 16, so it remains an error.
constexpr std::uint32_t TOO_MUCH = ~0U;

std::uint32_t narrowed(std::size_t number) {
  return static_cast<std::uint32_t>(std::min<std::size_t>(number, TOO_MUCH));
}

/// A host's record: where in it lie position and range, and direction and angle, 16 bytes each.
struct HostRecord {
  std::uint32_t bytes = 0;
  std::uint32_t position_at = 0;
  std::optional<std::uint32_t> direction_at;
};

Error wrong(const char* element, const std::string& expected, std::uint32_t got) {
  return {element, "expected " + expected + ", got " + std::to_string(got) + (got == TOO_MUCH ? " or more" : "")};
}

std::optional<Error> check_record(const HostRecord& record) {
  if (record.bytes == 0 || record.bytes % UNIT != 0)
    return wrong("record of a light", "a multiple of 16 bytes, 16 to 4294967280", record.bytes);
  const std::uint32_t last = record.bytes - UNIT;
  const std::string within = "a multiple of 16, at most " + std::to_string(last) + " in a record of " +
                             std::to_string(record.bytes) + " bytes";
  const auto fits = [&](std::uint32_t at) { return at % UNIT == 0 && at <= last; };
  if (!fits(record.position_at)) return wrong("position in the record of a light", within, record.position_at);
  if (!record.direction_at) return std::nullopt;
  const char* direction = "direction in the record of a light";
  if (!fits(*record.direction_at)) return wrong(direction, within, *record.direction_at);
  if (*record.direction_at != record.position_at) return std::nullopt;
  return wrong(direction, "other 16 bytes than those of position and range", *record.direction_at);
}

}  // namespace

/// Of form `none`, the places are the numbers of the record as they were given: offsets, and the lights' stride its
/// bytes; the cones' stride is 0 where no direction was given.
LightLayout LightLayout::interleaved(std::size_t record_bytes, std::size_t position_at,
                                     std::optional<std::size_t> direction_at) {
  const std::uint32_t stride = narrowed(record_bytes);
  LightLayout layout{.form = LightForm::points, .lights = {narrowed(position_at), stride}};
  HostRecord record{.bytes = stride, .position_at = layout.lights.offset};
  if (direction_at) {
    layout.form = LightForm::spots;
    layout.cones = {narrowed(*direction_at), stride};
    record.direction_at = layout.cones.offset;
  }
  if (check_record(record)) layout.form = LightForm::none;
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
  if (form == LightForm::none)
    if (auto error = check_record({.bytes = lights.stride,
                                   .position_at = lights.offset,
                                   .direction_at = cones.stride == 0 ? std::nullopt : std::optional(cones.offset)}))
      return error;
  if (form != LightForm::record && form != LightForm::points && form != LightForm::spots)
    return Error{"light form",
                 "expected record, points or spots, got " + std::to_string(static_cast<std::uint32_t>(form))};
  if (auto error = check_places("light", lights, record_bytes(form))) return error;
  return form == LightForm::spots ? check_places("cone", cones, sizeof(shared::LightCone)) : std::nullopt;
}

}  // namespace lamp
