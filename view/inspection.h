// What is known of one pixel: its cell, the lights listed there, and whether the oracle finds that one is missing.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lamplight/view.h"
#include "oracle/reference.h"
#include "render/lighting.h"
#include "render/renderer.h"
#include "render/shaders/cell_mask_data.h"
#include "render/shaders/explain_data.h"
#include "view/own_tests.h"
#include "view/still_pixels.h"

namespace lamp::app {

/// A light in the list of a pixel's cell.
struct ListedLight {
  std::uint32_t light = 0;
  bool spot = false;
  float distance_m = 0.0F;  ///< from the surface in the pixel
  float range_m = 0.0F;
  Reach reach = Reach::outside;  ///< of that surface
  double share = 0.0;            ///< of the pixel's luminance, 0 .. 1
  bool reaches_cell = false;     ///< a pixel of the cell, as the oracle says
  bool still = false;            ///< in a list of lights that stand still
  std::uint32_t passes = 0;      ///< gpu::PASSES_SIDES and so on, against the cell's pixels
};

/// Pairs of pixel and light that the oracle says reach, and those of them that a walk did not bring.
struct Proof {
  std::uint64_t pixels = 0;
  std::uint64_t pairs = 0;
  std::uint64_t missed = 0;
  std::uint64_t unfollowed = 0;  ///< pixels whose walk the device ended: nothing is known of them
  std::string first_miss;        ///< "pixel (12, 34): light 56", or empty
};
/// "0 missed of 1 234 567 pairs in 256 pixels".
[[nodiscard]] std::string words_of(const Proof& proof);
/// Of two methods, each with its side: "A: 0 missed of ...; B: 0 missed of ...".
[[nodiscard]] std::string words_of(std::span<const Proof> proofs);

/// Why a light is in the list of a method that makes these tests: "reaches the pixel", "reaches the cell", "kept by
/// sides, depths; not by exact", "larger cell: depths would drop it", or that no test would.
[[nodiscard]] std::string why_listed(const ListedLight& light, const OwnTests& own);
/// The same in whole sentences, for who does not know the tests.
[[nodiscard]] std::string explained(const ListedLight& light, const OwnTests& own);
/// The names of all tests, in the order of their bits; and those of some, with commas between.
[[nodiscard]] std::span<const std::string_view> test_names();
[[nodiscard]] std::string names_of(std::uint32_t tests);

/// The light that is looked at, listed or not, against the cell's pixels.
struct LookedAt {
  std::uint32_t light = 0;
  bool listed = false;
  std::uint32_t passes = 0;  ///< gpu::PASSES_SIDES and so on
  std::uint32_t parts = 0;   ///< of the mask, that its depths meet
};

/// A reflection probe whose volume the method lists for the pixel.
struct ListedProbe {
  std::uint32_t probe = 0;  ///< its place in the frame's order: smallest first
  std::uint32_t slot = 0;   ///< its number as the probes were made
  float volume = 0.0F;      ///< weight by its volume alone
  float weight = 0.0F;      ///< and by whether its capture sees the surface
  float share = 0.0F;       ///< of the reflection: what the mirrored ray and smaller ones leave of the weight
};

struct Inspection {
  glm::uvec2 pixel{0};  ///< of what was rendered
  bool second = false;  ///< right of the divider: of the second method
  bool sky = true;      ///< then the rest is empty
  std::uint32_t cell = 0;
  glm::vec3 position{0.0F};  ///< m, world space
  float z_view = 0.0F;       ///< m ahead of the eye
  std::uint32_t cell_pixels = 0;
  glm::uvec2 cell_min_px{0};  ///< a rectangle that holds them, to cell_end_px
  glm::uvec2 cell_end_px{0};
  float cell_near_m = 0.0F;  ///< of the surfaces in the cell's pixels, z_view
  float cell_far_m = 0.0F;
  std::vector<ListedLight> lights;  ///< ascending
  gpu::CellMask mask{};             ///< what a mask of the cell's depths holds, whether the method keeps one or not
  std::optional<LookedAt> looked_at;
  OwnTests own;                     ///< of the method
  OwnTests still_own;               ///< of lists of still lights
  Proof proof;                      ///< of all pixels of the cell
  float mirrored = 0.0F;            ///< of the reflection, by the mirrored ray
  std::vector<ListedProbe> probes;  ///< smallest first; the surroundings have the rest of the reflection

  [[nodiscard]] const OwnTests& tests_of(const ListedLight& light) const { return light.still ? still_own : own; }
};

/// What an inspection looks at: the renderer's last frame, lit by `lighting`.
struct Inspected {
  Renderer& renderer;
  Lighting& lighting;
  const ShaderLibrary& shaders;
  const GpuScene& scene;
  std::span<const shared::Light> lights;  ///< all
  std::span<const Visit> visits;          ///< of all pixels
  std::span<const float> depth;           ///< likewise
  const StillPixels* still = nullptr;     ///< null: all lights are the picture's
  std::optional<std::uint32_t> light;     ///< that is looked at

  /// The lights that the picture's lists have.
  [[nodiscard]] std::span<const shared::Light> listed() const {
    return still == nullptr ? lights : lights.first(still->first);
  }
};
[[nodiscard]] Inspection inspect(const Inspected& of, glm::uvec2 pixel);

/// What a method, with its own options, lists for a pixel.
struct OtherList {
  std::string method;
  std::vector<std::uint32_t> lights;   ///< ascending
  std::size_t reaching = 0;            ///< of them, those that reach the pixel
  std::vector<std::uint32_t> beyond;   ///< of them, those that are not in the list of the picture
  std::vector<std::uint32_t> without;  ///< that the list of the picture has, and this one has not
  std::string refused;                 ///< why this device cannot run it; or empty

  [[nodiscard]] bool has(std::uint32_t light) const { return std::ranges::binary_search(lights, light); }
};

/// Fills what tells it from the list of the picture.
void compare(OtherList& other, std::span<const ListedLight> lights);

/// The proof of all pixels, in bands; `progress` is told the share that is done.
[[nodiscard]] Proof prove(const Inspected& of, const std::function<void(float)>& progress);

}  // namespace lamp::app
