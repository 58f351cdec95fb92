// Entities: what cells hold. Lights have the first ids, boxes (decals, reflection probes) the ids behind them, so that
// one structure serves all and each kind is a range of ids that a shader walks alone (lookup/parts/each.glsl).
// Promise: every method culls boxes as it culls lights, by the bounding sphere, and with option boxes=shape by the
// shape as well; no method knows of kinds.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "lamplight/error.h"
#include "lamplight/export.h"
#include "lamplight/shared/entity.h"
#include "lamplight/shared/light.h"

namespace lamp {

/// Ids first .. end - 1.
struct EntityRange {
  std::uint32_t first = 0;
  std::uint32_t end = 0;

  [[nodiscard]] std::uint32_t count() const { return end - first; }
};

/// The ids of a frame's entities, kind by kind.
struct EntityRanges {
  EntityRange lights;
  EntityRange boxes;   ///< of all kinds
  EntityRange decals;  ///< the first of the boxes
  EntityRange probes;  ///< the last of the boxes
};
/// All boxes are decals.
[[nodiscard]] LAMPLIGHT_API EntityRanges entity_ranges(std::uint32_t light_count, std::uint32_t box_count);
/// Lights, then decals, then probes: of a Frame whose box_count is that of decals and probes, and whose probe_count
/// that of probes.
[[nodiscard]] LAMPLIGHT_API EntityRanges entity_ranges(std::uint32_t light_count, std::uint32_t decal_count,
                                                       std::uint32_t probe_count);

/// What an OrientedBox covers.
enum class EntityShape : std::uint8_t {
  box,
  ellipsoid,  ///< with the half extents for half axes
};

/// The first box with a number that is not finite, a half extent that is not > 0, or axes that are not unit and at
/// right angles within 1e-4, as an error that names it ("box 3: ..."); or nothing.
[[nodiscard]] LAMPLIGHT_API std::optional<Error> check_boxes(std::span<const shared::OrientedBox> boxes);

/// The record that stands for a checked box in the light buffer: a point light of no intensity, whose range is the
/// radius of a sphere that encloses the box and what rounding may add to it. What a point light leaves unread says the
/// shape (shared/entity.h), which option boxes=shape reads.
[[nodiscard]] LAMPLIGHT_API shared::Light bounding_light(const shared::OrientedBox& box);
/// The same of a box or of an ellipsoid, whose sphere is as large as its longest half axis.
[[nodiscard]] LAMPLIGHT_API shared::Light bounding_light(const shared::OrientedBox& box, EntityShape shape);

/// A frame's light buffer: the lights, then a record for each box.
[[nodiscard]] LAMPLIGHT_API std::vector<shared::Light> entity_records(std::span<const shared::Light> lights,
                                                                      std::span<const shared::OrientedBox> boxes);

}  // namespace lamp
