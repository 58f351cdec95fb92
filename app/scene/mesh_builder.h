// Parts of procedural scenes: boxes, prisms, lathes, tubes, arches and grids, appended to a growing triangle list.
// Promises: counter-clockwise front faces, outward unit normals, unit tangents along +u, uv in metres (v runs down, as
// glTF's images do), cross(normal, tangent) up in the image.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <numbers>
#include <span>
#include <vector>

#include "scene/scene.h"

namespace lamp::app::procedural {

inline constexpr float PI = std::numbers::pi_v<float>;

/// A triangle list in its own object space, metres.
struct Geometry {
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
};

/// A convex planar polygon, corners counter-clockwise; the uv is its place in its plane.
void add_polygon(Geometry& geometry, std::span<const glm::vec3> corners);
void add_quad(Geometry& geometry, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c, const glm::vec3& d);

/// A quad whose uv runs from (u0, 0) at `a` to (u0 + size.x, -size.y) at the opposite corner, whatever its place.
struct UvQuad {
  glm::vec3 corner{0.0F};       ///< bottom left, seen from the front
  glm::vec3 right{1.0F, 0, 0};  ///< to the bottom right
  glm::vec3 up{0, 1.0F, 0};     ///< to the top left
  glm::vec2 uv{0.0F};           ///< at the corner, m
};
void add_uv_quad(Geometry& geometry, const UvQuad& quad);

/// All six sides of an axis-aligned box.
void add_box(Geometry& geometry, const glm::vec3& min, const glm::vec3& max);

/// A rectangular ring with mitred corners; its top and underside may slope from the inner to the outer edge.
struct Frame {
  glm::vec2 inner;  ///< half sizes, x and z
  glm::vec2 outer;
  glm::vec2 bottom;  ///< y at the inner edge, at the outer edge
  glm::vec2 top;
};

void add_frame(Geometry& geometry, const Frame& frame);

/// A counter-clockwise outline in x and y, star-shaped around its centroid, extruded from z0 to z1 > z0, with caps.
void add_prism(Geometry& geometry, std::span<const glm::vec2> outline, float z0, float z1);

/// A profile of (radius, y) turned around the y axis, bottom to top on the outside; it may start and end at radius 0.
/// Profile corners sharper than 40 degrees stay sharp.
struct Lathe {
  std::span<const glm::vec2> profile;
  std::uint32_t segments = 24;
  float around_m = 0.0F;  ///< u of a full turn; 0: the largest circumference
};
void add_lathe(Geometry& geometry, const Lathe& lathe);

/// A closed cylinder along y.
void add_cylinder(Geometry& geometry, float radius, float y0, float y1, std::uint32_t segments);
void add_sphere(Geometry& geometry, const glm::vec3& center, float radius, std::uint32_t segments);

/// A round tube along a path with a radius at each point; ends are closed.
struct Tube {
  std::span<const glm::vec3> path;
  std::span<const float> radii;  ///< one for each point of the path, > 0
  std::uint32_t sides = 8;
};
void add_tube(Geometry& geometry, const Tube& tube);

/// A smooth surface over (u, v) in 0 .. 1: u to the right, v up, seen from the front.
struct Grid {
  std::uint32_t columns = 1;
  std::uint32_t rows = 1;
  glm::vec2 size_m{1.0F};  ///< uv runs over this; (0, 0) is the top left
  std::function<glm::vec3(glm::vec2)> surface;
};
void add_grid(Geometry& geometry, const Grid& grid);

/// A wall in the plane z = 0, `depth` thick around it, `width` wide around x = 0, from `bottom` to `top`, with a round
/// opening of `radius` whose circle begins at height `spring` >= bottom. Front, back, the opening's sides and the
/// underside of the feet; no left, right and top sides (what stands beside it covers them).
struct ArchWall {
  float width = 0.0F;
  float depth = 0.0F;
  float bottom = 0.0F;
  float top = 0.0F;
  float spring = 0.0F;
  float radius = 0.0F;
  std::uint32_t segments = 20;
};
void add_arch_wall(Geometry& geometry, const ArchWall& wall);

/// A half ring (voussoirs) around z from angle 0 to pi at height `spring`, closed on all sides.
struct ArchRing {
  float inner = 0.0F;
  float outer = 0.0F;
  float depth = 0.0F;
  float spring = 0.0F;
  std::uint32_t segments = 20;
};
void add_arch_ring(Geometry& geometry, const ArchRing& ring);

/// Appends a transformed copy; `transform` is a rotation, a translation and a uniform positive scale.
void append(Geometry& geometry, const Geometry& part, const glm::mat4& transform);

/// Multiplies the colour of every vertex.
void tint(Geometry& geometry, const glm::vec3& color);

/// Transforms of parts: translation, and translation after a turn around +Y (radians) and a uniform scale.
[[nodiscard]] glm::mat4 at(float x, float y, float z);
[[nodiscard]] glm::mat4 at(const glm::vec3& position, float turn_y, float scale = 1.0F);

/// Adds the geometry to the scene as a mesh and returns its number.
std::uint32_t add_mesh(Scene& scene, const Geometry& geometry, std::uint32_t material);

/// Draws a mesh once more.
void place(Scene& scene, std::uint32_t mesh, const glm::mat4& world_from_object);

/// A mesh that is drawn once, where it is.
void add_once(Scene& scene, const Geometry& geometry, std::uint32_t material);

}  // namespace lamp::app::procedural
