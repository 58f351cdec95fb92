// A scene as every source of scenes (built in, glTF, capture) describes it: meshes, materials, lights, cameras.
// Conventions of docs/conventions.md: metres, radians, candela and lux, linear Rec. 709, right-handed, +Y up.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lamplight/light.h"
#include "scene/captured_frame.h"
#include "scene/decal.h"
#include "scene/probe.h"

namespace lamp::app {

/// Of anything from the origin: squares of distances must fit 32-bit numbers.
inline constexpr float FURTHEST_M = 1e15F;

/// cd of a light, lux of a directional one, of each channel: at FURTHEST_M such a light still gives one lux. Pictures
/// are of 32-bit numbers, and hold the sum of many of these.
inline constexpr float LARGEST_INTENSITY = 1e30F;

struct Vertex {
  glm::vec3 position{0.0F};
  glm::vec3 normal{0.0F, 1.0F, 0.0F};
  glm::vec4 tangent{1.0F, 0.0F, 0.0F, 1.0F};  ///< w: handedness, as glTF
  std::array<glm::vec2, 2> uv{};
  glm::u8vec4 color{255};  ///< multiplies the base colour, linear
};
static_assert(sizeof(Vertex) == 60);

enum class Wrap : std::uint8_t { repeat, mirror, clamp };

/// Eight-bit RGBA, row by row from the top. Mip levels are made at upload.
struct Image {
  std::string name;
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::vector<std::uint8_t> rgba;
  bool srgb = false;  ///< base colour and emissive images; decoded by the sampler
};

/// A use of an image by a material.
struct Texture {
  std::int32_t image = -1;  ///< index into Scene::images; -1: none, reads as white (normal: flat)
  std::uint32_t uv = 0;     ///< 0 or 1
  Wrap wrap_u = Wrap::repeat;
  Wrap wrap_v = Wrap::repeat;
  bool nearest = false;    ///< magnification filter
  glm::vec2 offset{0.0F};  ///< KHR_texture_transform
  float rotation = 0.0F;   ///< radians, counter-clockwise as the extension defines
  glm::vec2 scale{1.0F};
};

enum class AlphaMode : std::uint8_t { opaque, mask, blend };

/// Metallic-roughness, as glTF 2.0.
struct Material {
  std::string name;
  glm::vec4 base_color{1.0F};
  float metallic = 0.0F;
  float roughness = 1.0F;
  glm::vec3 emissive{0.0F};
  float normal_scale = 1.0F;
  float occlusion_strength = 1.0F;
  AlphaMode alpha_mode = AlphaMode::opaque;
  float alpha_cutoff = 0.5F;
  bool double_sided = false;
  Texture base_color_texture;
  Texture metallic_roughness_texture;  ///< G roughness, B metallic
  Texture normal_texture;
  Texture occlusion_texture;  ///< R
  Texture emissive_texture;
};

/// A triangle list: indices[first_index .. first_index + index_count) each plus vertex_offset.
struct Mesh {
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;
  std::uint32_t vertex_offset = 0;
  std::uint32_t material = 0;
};

/// Alpha from which a masked surface is drawn: the cutoff, less what interpolation in 32 bits may round away.
[[nodiscard]] inline float drawn_alpha(const Material& material) { return material.alpha_cutoff * (1.0F - 0x1p-20F); }

struct Instance {
  std::uint32_t mesh = 0;
  glm::mat4 world_from_object{1.0F};
};

struct DirectionalLight {
  glm::vec3 direction{0.0F, -1.0F, 0.0F};  ///< unit, the way the light travels
  glm::vec3 illuminance{0.0F};             ///< lux times colour
};

struct Camera {
  std::string name;
  glm::mat4 world_from_camera{1.0F};  ///< rigid; looks down -Z
  bool orthographic = false;
  float fov_y = 1.0F;        ///< radians (perspective)
  float half_height = 1.0F;  ///< metres (orthographic); the half width follows from the picture's aspect
  float near_m = 0.05F;
  float far_m = 0.0F;  ///< 0: infinite (perspective only)
};

/// A camera path: smooth through its keys, one pass over the path is `frames` frames.
struct FlightKey {
  glm::vec3 eye;
  glm::vec3 target;
};
struct Flight {
  std::vector<FlightKey> keys;
  std::uint32_t frames = 300;
  float fov_y = 1.0F;
  float near_m = 0.05F;
};

/// Axis-aligned, world space, metres.
struct Box {
  glm::vec3 min{0.0F};
  glm::vec3 max{0.0F};
};
[[nodiscard]] inline Box joined(const Box& a, const Box& b) { return {glm::min(a.min, b.min), glm::max(a.max, b.max)}; }

/// How a scene wants generated lights to be, where it is not as everywhere: in open air (open_air.h), ranges close to
/// each other, spots of ordinary angles.
struct LightPlacement {
  std::optional<Box> box;    ///< lights are in here, whatever else is
  float max_range = 0.0F;    ///< m, of automatic ranges; 0: as everywhere
  float range_ratio = 0.0F;  ///< of automatic ranges: the largest over the smallest, > 1, few large; 0: as everywhere
  float spot_angle = 0.0F;   ///< radians, half-angle of every spot's outer cone; 0: as everywhere
  float spot_reach = 1.0F;   ///< automatic range of a spot over that of a point light
};

struct Scene {
  std::string name;
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  std::vector<Mesh> meshes;
  std::vector<Instance> instances;
  std::vector<Material> materials;  ///< at least one
  std::vector<Image> images;
  std::vector<Light> lights;  ///< point and spot lights, world space
  std::vector<Decal> decals;  ///< shown only as far as asked for (place_decals)
  std::vector<Probe> probes;  ///< likewise (place_probes), as they were made
  std::vector<DirectionalLight> directional_lights;
  std::vector<Camera> cameras;  ///< at least one after loading; the first is the default
  std::optional<Flight> flight;
  LightPlacement placement;                  ///< of generated lights
  glm::vec3 sky{0.0F};                       ///< radiance of pixels that nothing covers
  glm::vec3 ambient{0.0F};                   ///< irradiance from everywhere, so that unlit surfaces are not black
  std::optional<CapturedFrame> captured;     ///< then there are no meshes, and this is the only camera's view
  std::vector<std::string> notes;            ///< what a loader left out or replaced, one line each
  std::vector<std::filesystem::path> files;  ///< that it was read from, none of a built-in one
};

/// World-space bounds of all instances; an empty scene gives a unit box around the origin.
[[nodiscard]] Box bounds(const Scene& scene);

/// What lamp::check_lights finds, or the first light that is brighter than LARGEST_INTENSITY.
[[nodiscard]] std::optional<lamp::Error> check_shown_lights(std::span<const Light> lights);

}  // namespace lamp::app
