// The noise behind the procedural textures, and the way from texels to images.
// Based on: value noise over a few octaves; Worley, A Cellular Texture Basis Function, SIGGRAPH 1996.
// Promise: the same bytes for the same input; normal maps follow the heights in metres (green is up).
// SPDX-License-Identifier: Apache-2.0
#include "scene/procedural_textures.h"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "scene/procedural_random.h"

namespace lamp::app::procedural {
namespace {

constexpr std::uint32_t NOISE_SIZE = 512;
constexpr std::uint32_t NOISE_OCTAVES = 6;
constexpr std::uint32_t NOISE_FIRST = 4;  // cells of the first octave

/// Adds one octave of value noise with `count` cells a side.
void add_octave(std::vector<float>& table, std::uint32_t count, float weight) {
  tbb::parallel_for(0U, NOISE_SIZE, [&](std::uint32_t y) {
    for (std::uint32_t x = 0; x < NOISE_SIZE; ++x) {
      const glm::vec2 p = glm::vec2(x, y) * (static_cast<float>(count) / static_cast<float>(NOISE_SIZE));
      const glm::uvec2 cell(p);
      const glm::vec2 f = glm::fract(p);
      const glm::vec2 t = f * f * (3.0F - 2.0F * f);
      const auto corner = [&](std::uint32_t dx, std::uint32_t dy) {
        return hash_unit((cell.x + dx) % count, (cell.y + dy) % count, count);
      };
      const float top = std::lerp(corner(0, 0), corner(1, 0), t.x);
      const float bottom = std::lerp(corner(0, 1), corner(1, 1), t.x);
      table[y * NOISE_SIZE + x] += weight * std::lerp(top, bottom, t.y);
    }
  });
}

std::vector<float> make_noise() {
  std::vector<float> table(NOISE_SIZE * NOISE_SIZE);
  for (std::uint32_t octave = 0; octave < NOISE_OCTAVES; ++octave) {
    add_octave(table, NOISE_FIRST << octave, std::pow(0.5F, static_cast<float>(octave)));
  }
  const auto [low, high] = std::minmax_element(table.begin(), table.end());
  const float offset = *low;
  const float scale = 1.0F / (*high - *low);
  for (float& value : table) value = (value - offset) * scale;
  return table;
}

/// Linear 0 .. 1 to sRGB 0 .. 255, as IEC 61966-2-1, from a table of 4096 steps.
std::uint8_t encode_srgb(float linear) {
  static const std::vector<std::uint8_t> table = [] {
    std::vector<std::uint8_t> made(4096);
    for (std::size_t i = 0; i < made.size(); ++i) {
      const float x = static_cast<float>(i) / 4095.0F;
      const float y = x <= 0.0031308F ? 12.92F * x : 1.055F * std::pow(x, 1.0F / 2.4F) - 0.055F;
      made[i] = static_cast<std::uint8_t>(std::lround(y * 255.0F));
    }
    return made;
  }();
  return table[static_cast<std::size_t>(std::lround(std::clamp(linear, 0.0F, 1.0F) * 4095.0F))];
}

std::uint8_t encode_unit(float value) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(value, 0.0F, 1.0F) * 255.0F));
}

void write_texel(Image& image, std::size_t pixel, const std::array<std::uint8_t, 4>& rgba) {
  std::copy(rgba.begin(), rgba.end(), image.rgba.begin() + static_cast<std::ptrdiff_t>(pixel * 4));
}

Image blank(const Surface& surface, const char* what, bool srgb) {
  Image image;
  image.name = surface.name + " " + what;
  image.width = surface.size;
  image.height = surface.size;
  image.rgba.resize(std::size_t{4} * surface.size * surface.size);
  image.srgb = srgb;
  return image;
}

struct Baked {
  Image color, normal, metallic_roughness, emission;
};

Baked bake(const Surface& surface) {
  Baked baked{blank(surface, "base colour", true),
              blank(surface, "normal", false),
              blank(surface, "metallic-roughness", false),
              {}};
  if (surface.glows) baked.emission = blank(surface, "emission", true);
  const std::uint32_t size = surface.size;
  std::vector<float> heights(std::size_t{size} * size);
  tbb::parallel_for(0U, size, [&](std::uint32_t y) {
    for (std::uint32_t x = 0; x < size; ++x) {
      const std::size_t pixel = std::size_t{y} * size + x;
      const Texel t = surface.texel((glm::vec2(x, y) + 0.5F) / static_cast<float>(size));
      heights[pixel] = t.height;
      write_texel(baked.color, pixel,
                  {encode_srgb(t.color.r), encode_srgb(t.color.g), encode_srgb(t.color.b), encode_unit(t.alpha)});
      write_texel(baked.metallic_roughness, pixel, {255, encode_unit(t.roughness), encode_unit(t.metallic), 255});
      if (surface.glows) {
        write_texel(baked.emission, pixel,
                    {encode_srgb(t.emission.r), encode_srgb(t.emission.g), encode_srgb(t.emission.b), 255});
      }
    }
  });
  const glm::vec2 per_m = static_cast<float>(size) / surface.tile_m;
  tbb::parallel_for(0U, size, [&](std::uint32_t y) {
    for (std::uint32_t x = 0; x < size; ++x) {
      const auto height = [&](std::uint32_t dx, std::uint32_t dy) {
        return heights[std::size_t{(y + dy) % size} * size + (x + dx) % size];
      };
      const float right = (height(1, 0) - height(size - 1, 0)) * 0.5F * per_m.x;
      const float down = (height(0, 1) - height(0, size - 1)) * 0.5F * per_m.y;
      const glm::vec3 normal = glm::normalize(glm::vec3(-right, down, 1.0F)) * 0.5F + 0.5F;
      write_texel(baked.normal, std::size_t{y} * size + x,
                  {encode_unit(normal.x), encode_unit(normal.y), encode_unit(normal.z), 255});
    }
  });
  return baked;
}

}  // namespace

float noise(glm::vec2 p) {
  // Isolated: a thread that waits for make_noise's own tasks must not take up a task that asks for this table again.
  static const std::vector<float> table = [] {
    std::vector<float> made;
    tbb::this_task_arena::isolate([&] { made = make_noise(); });
    return made;
  }();
  const glm::vec2 scaled = glm::fract(p) * static_cast<float>(NOISE_SIZE);
  const glm::uvec2 cell(scaled);
  const glm::vec2 f = scaled - glm::vec2(cell);
  const auto value = [&](std::uint32_t dx, std::uint32_t dy) {
    return table[((cell.y + dy) % NOISE_SIZE) * NOISE_SIZE + (cell.x + dx) % NOISE_SIZE];
  };
  return std::lerp(std::lerp(value(0, 0), value(1, 0), f.x), std::lerp(value(0, 1), value(1, 1), f.x), f.y);
}

Brick brick_at(glm::vec2 p, glm::uvec2 count, float shift, glm::vec2 tile_m) {
  const glm::vec2 scaled = glm::fract(p) * glm::vec2(count);
  const auto row = std::min(static_cast<std::uint32_t>(scaled.y), count.y - 1);
  const float x = scaled.x + (row % 2 == 1 ? shift : 0.0F);
  const auto column = static_cast<std::uint32_t>(x) % count.x;
  Brick brick;
  brick.local = {x - std::floor(x), scaled.y - static_cast<float>(row)};
  const glm::vec2 size = tile_m / glm::vec2(count);
  const glm::vec2 edge = glm::min(brick.local, 1.0F - brick.local) * size;
  brick.edge_m = std::min(edge.x, edge.y);
  brick.id = hash_unit(column, row, count.x * 31 + count.y);
  return brick;
}

Material use_surface(Scene& scene, const Surface& surface) {
  Baked baked = bake(surface);
  const auto add = [&](Image& image) {
    scene.images.push_back(std::move(image));
    return Texture{.image = static_cast<std::int32_t>(scene.images.size() - 1), .scale = 1.0F / surface.tile_m};
  };
  Material material;
  material.name = surface.name;
  material.metallic = 1.0F;
  material.base_color_texture = add(baked.color);
  material.normal_texture = add(baked.normal);
  material.metallic_roughness_texture = add(baked.metallic_roughness);
  if (surface.glows) {
    material.emissive = glm::vec3(1.0F);
    material.emissive_texture = add(baked.emission);
  }
  return material;
}

Material plain_material(const Plain& plain) {
  Material material;
  material.name = plain.name;
  material.base_color = glm::vec4(plain.color, 1.0F);
  material.roughness = plain.roughness;
  material.metallic = plain.metallic;
  material.emissive = plain.emissive;
  return material;
}

std::uint32_t add_material(Scene& scene, Material material) {
  scene.materials.push_back(std::move(material));
  return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

Material tinted(Material material, const std::string& name, const glm::vec3& color) {
  material.name = name;
  material.base_color = glm::vec4(color, material.base_color.a);
  return material;
}

}  // namespace lamp::app::procedural
