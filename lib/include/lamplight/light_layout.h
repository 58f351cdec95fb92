// How a host keeps its lights: what culling reads of them, and where that lies.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "lamplight/error.h"
#include "lamplight/export.h"
#include "lamplight/shared/light.h"

namespace lamp {

/// What a host brings of each light.
enum class LightForm : std::uint32_t {
  record = shared::FORM_RECORD,  ///< shared::Light in the light buffer
  points = shared::FORM_POINTS,  ///< shared::LightReach in the light buffer; all are point lights
  spots = shared::FORM_SPOTS,    ///< that, and shared::LightCone in the cone buffer; point lights may be among them
  none = ~0U,  ///< no layout: `LightLayout::interleaved` of what is no record. `LightLayout::check` says what is wrong
};

/// Where records lie in a buffer: that of light i at byte offset + i * stride.
struct RecordPlaces {
  std::uint32_t offset = 0;  ///< bytes, a multiple of 16
  std::uint32_t stride = 0;  ///< bytes, a multiple of 16, not less than the record has; 0: as many as the record has

  friend bool operator==(const RecordPlaces&, const RecordPlaces&) = default;
};

struct LAMPLIGHT_API LightLayout {
  LightForm form = LightForm::record;
  RecordPlaces lights;  ///< in the light buffer
  RecordPlaces cones;   ///< in the cone buffer, of form spots

  /// Of a host's record of so many bytes: where in it lie position and range, and direction and outer angle, if there
  /// are spots, for which the light buffer is given as the cone buffer too. Each takes 16 bytes of the record, at a
  /// multiple of 16; the record has a multiple of 16 bytes, less than 2^32. Else `check` of the layout, which
  /// `make_plan` calls, says what was wrong.
  [[nodiscard]] static LightLayout interleaved(std::size_t record_bytes, std::size_t position_at,
                                               std::optional<std::size_t> direction_at = std::nullopt);

  /// Records one behind the other: what every pass reads as it is.
  [[nodiscard]] bool is_standard() const;
  /// Bytes from one light to the next.
  [[nodiscard]] std::uint32_t light_stride() const;
  [[nodiscard]] std::uint32_t cone_stride() const;
  /// Bytes from the beginning of a buffer to the end of the last of so many lights; 0 for none.
  [[nodiscard]] std::uint64_t light_bytes(std::uint64_t count) const;
  [[nodiscard]] std::uint64_t cone_bytes(std::uint64_t count) const;
  /// What is wrong with an offset, a stride, or the numbers that `interleaved` was given; or nothing.
  [[nodiscard]] std::optional<Error> check() const;
};

}  // namespace lamp
