// Cameras to views: a scene's cameras by name, frames of its flight, and the projections that tests ask for.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lamplight/view.h"
#include "scene/scene.h"

namespace lamp::app {

/// The camera at a frame of a flight (wraps around), on a closed Catmull-Rom loop through its keys, with +Y up.
/// Throws Error for a flight without keys or frames.
[[nodiscard]] Camera flight_camera(const Flight& flight, std::uint32_t frame);

/// The camera at a frame of the scene's flight, for somebody who names it: throws Error where there is no flight, and
/// for a frame behind its last.
[[nodiscard]] Camera frame_camera(const Scene& scene, int frame);

/// Projections of `--projection`: `camera` (as the camera says), `perspective` (finite far), `infinite`,
/// `orthographic` (a window that shows about the same part of the scene), `off-centre` (a window that is not
/// symmetric).
[[nodiscard]] std::span<const std::string_view> projection_names();

/// The view of a camera for a picture. Throws Error for an unknown projection (with the nearest names) or a bad size.
[[nodiscard]] View view_of(const Camera& camera, std::uint32_t width, std::uint32_t height,
                           std::string_view projection);

/// The views of two eyes beside a view, left and right, so many metres apart and looking the same way. Each has the
/// size and projection of `view`.
[[nodiscard]] std::vector<View> both_eyes(const View& view, double apart_m);

/// `view` and others that stand where it does, turned about its vertical by equal parts of a circle.
[[nodiscard]] std::vector<View> all_around(const View& view, std::uint32_t count);

/// The scene's camera of that name, or its first when the name is empty. Throws Error with the names there are.
[[nodiscard]] const Camera& find_camera(const Scene& scene, std::string_view name);

}  // namespace lamp::app
