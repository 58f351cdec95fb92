// Shadows against rays: how much light a filter lets through that something stops, and how much it stops that arrives.
// Promise: rays are in double precision against the scene's triangles; what hangs on where they end is counted apart.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>
#include <string>

#include "oracle/occluders.h"
#include "oracle/reference.h"
#include "render/renderer.h"

namespace lamp::app {

/// How far a depth sample may lie off its triangle along the eye's ray. Rasterizers round, and have a triangle that is
/// far larger than the picture off by centimetres. Shares of the distance ahead, and of the largest coordinate.
inline constexpr double OFF_OF_DISTANCE = 0.01;
inline constexpr double OFF_OF_COORDINATES = 0x1p-20;

/// Where a ray ends before the surface and before the light.
struct RayEnd {
  double m = 0.0;
  double most = 0.0;  ///< of the ray's length
};
/// Rays start where the eye's ray meets the pixel's triangle. Pairs whose answer is another with the second end are
/// left out.
inline constexpr RayEnd RAY_END{.m = 0.002, .most = 1.0 / 64.0};
inline constexpr RayEnd RAY_SECOND_END{.m = 0.008, .most = 1.0 / 16.0};

/// A pair lies away from the edge of a shadow if rays from four pixels so far away, right, left, above and below, have
/// the same answer, those of sky aside.
inline constexpr int EDGE_PX = 8;

/// Light is luminance towards the eye.
struct ShadowLight {
  double arriving = 0.0;  ///< that no ray stops
  double stopped = 0.0;   ///< that rays stop
  double leaked = 0.0;    ///< of the stopped, what the filter lets through
  double bled = 0.0;      ///< of the leaked, what is more than the filter's taps would leave if each compared depths
  double lost = 0.0;      ///< of the arriving, what the filter stops: false shadows

  void add(const ShadowLight& more);
  [[nodiscard]] double leaks() const { return stopped > 0.0 ? leaked / stopped : 0.0; }
  [[nodiscard]] double bleeding() const { return stopped > 0.0 ? bled / stopped : 0.0; }
  [[nodiscard]] double false_shadows() const { return arriving > 0.0 ? lost / arriving : 0.0; }

  friend bool operator==(const ShadowLight&, const ShadowLight&) = default;
};

/// Of pairs of pixel and light whose light reaches the pixel and faces it, where nothing else is said.
struct ShadowFindings {
  std::uint64_t pairs = 0;
  std::uint64_t unclear = 0;       ///< of them, left out: other ends of the ray give another answer
  std::uint64_t thinned = 1;       ///< one pair of so many was looked at; of several pictures the most
  std::uint64_t in_shadow = 0;     ///< by rays
  std::uint64_t dark = 0;          ///< to which the look-up leaves no light
  std::uint64_t cut = 0;           ///< of these, beyond the light's radial bound
  std::uint64_t lost = 0;          ///< beyond the bound although the look-up lights them, from behind as well: a fault
  std::uint64_t behind = 0;        ///< pairs whose light is behind the surface, which maps nearly always leave dark
  std::uint64_t cut_behind = 0;    ///< of these, beyond the light's radial bound
  bool has_meshes = false;         ///< a method was cut by them
  std::uint64_t outside = 0;       ///< of the dark, outside the light's mesh
  std::uint64_t lost_outside = 0;  ///< likewise, outside the mesh
  ShadowLight all;
  ShadowLight away;    ///< of the pairs away from edges
  ShadowLight beyond;  ///< of the pairs beyond the filter's reach: all texels with a say are as dark or lit as the ray

  /// Of another picture of the frame.
  void add(const ShadowFindings& more);
  /// Whether cuts lose nothing that the look-up lights.
  [[nodiscard]] bool is_right() const { return lost + lost_outside == 0; }
  /// Part of the stopped light that is beyond the filter's reach, 0 .. 1.
  [[nodiscard]] double stopped_beyond() const { return all.stopped > 0.0 ? beyond.stopped / all.stopped : 0.0; }
};

/// Told what is done now, and how much of that, 0 .. 1.
using ShadowProgress = std::function<void(const std::string& what, double done)>;

/// Of the picture that a renderer shows, which casts shadows; the occluders are its scene's.
[[nodiscard]] ShadowFindings check_shadows(Renderer& renderer, const ShaderLibrary& shaders, const Occluders& occluders,
                                           std::span<const shared::Light> lights, const ShadowProgress& progress = {});

/// Whether a method's lights are cut by what their shadow maps hold.
[[nodiscard]] bool is_cut(const Renderer& renderer, const Lighting& lighting);

/// The pairs of a truth that the frame's look-up of shadows leaves some light: what lists must hold of lights that are
/// cut by their radial bounds. Of a renderer that casts shadows.
[[nodiscard]] Truth lit_truth(Renderer& renderer, const ShaderLibrary& shaders, const Truth& truth);

}  // namespace lamp::app
