// Inside the built-in scenes: one maker a scene, and what they share for cameras and flights.
// Based on: nothing.
// Promise: each maker returns a complete scene, the same every time.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <string>

#include "scene/scene.h"

namespace lamp::app::procedural {

[[nodiscard]] Scene make_atrium();
[[nodiscard]] Scene make_blocks();
[[nodiscard]] Scene make_posts();
[[nodiscard]] Scene make_corridor();
[[nodiscard]] Scene make_plane();
[[nodiscard]] Scene make_one_tile();
[[nodiscard]] Scene make_near_plane();
[[nodiscard]] Scene make_huge_and_tiny();
[[nodiscard]] Scene make_needles();
[[nodiscard]] Scene make_wall();
[[nodiscard]] Scene make_stack();

/// A perspective camera that stands at `eye`, looks at `target`, +Y up; infinite far.
[[nodiscard]] Camera camera_at(const std::string& name, const glm::vec3& eye, const glm::vec3& target, float fov_y);

}  // namespace lamp::app::procedural
