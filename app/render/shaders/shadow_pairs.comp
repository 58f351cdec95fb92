// Of pairs of pixel and light: the light that would arrive without shadows, what the look-up leaves of it, whether the
// light's radial bound lets it reach the pixel, and its mesh holds it, and what the texels around say.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#include "lamplight/shared/frame.h"
#include "shadow_pair_data.h"

layout(local_size_x = 64) in;
layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 2, scalar) readonly buffer PairBuffer { ShadowPair pairs[]; };
layout(set = 0, binding = 8, scalar) writeonly buffer AnswerBuffer { ShadowAnswer answers[]; };
layout(push_constant, scalar) uniform Push { ShadowQuestion question; };
#include "common/deferred_surface.glsl"
#include "common/lights.glsl"
#include "common/unshadowed.glsl"
#define RADIAL_BINDING 9
#include "common/radial_bounds.glsl"
#define MESH_BINDING 10
#include "common/light_mesh_holds.glsl"
#include "shadow/parts/radial_reach.glsl"

bool radial_reaches_point(uint light, vec3 position) {
  if (radial_bounds[light].kind == RADIAL_NONE) return true;
  vec3 rel = position - radial_bounds[light].position;
  if (radial_bounds[light].kind == RADIAL_SPOT) {
    const vec3 x = radial_bounds[light].axis_x;
    const vec3 z = radial_bounds[light].axis_z;
    rel = transpose(mat3(x, cross(z, x), z)) * rel;
  }
  const float slack = 8.0 * ROUND_POSITION * (length(position) + length(radial_bounds[light].position));
  return radial_reaches_sphere(light, rel, slack);
}

// But for rounding of the position, by which what draws the mesh widens it: as common/light_mesh_view.glsl has it, all that
// is nearer than that over the spread is inside.
bool mesh_may_hold(uint light, vec3 position) {
  if (light >= uint(meshes.length()) || meshes[light].kind == MESH_NONE) return true;
  const vec3 rel = position - meshes[light].position;
  const float slack = 4.0 * ROUND_POSITION * (length(position) + length(meshes[light].position));
  const float distance_m = length(rel);
  if (distance_m <= slack / MESH_SPREAD) return true;
  return mesh_holds(light, meshes[light].position + rel * (1.0 - slack / distance_m));
}

// Of vsm and evsm: the blur of comparisons in place of that of moments.
float blur_of_comparisons(uint light, ShadowPlace place) {
  const vec2 corner = place.texel - 0.5;
  const ivec2 low = shadow_texel_of(corner);
  const int step = blur_step(int(shadow_maps[light].side));
  float lit = 0.0;
  for (int i = 0; i < 4 * 9 * 9; ++i) {
    const ivec2 tap = ivec2(i / 4 % 9, i / 36);
    const ivec2 between = ivec2(i & 1, i / 2 & 1);
    const vec2 shares = mix(1.0 - (corner - low), corner - low, vec2(between));
    lit += BLUR_WEIGHTS[tap.x] * BLUR_WEIGHTS[tap.y] * shares.x * shares.y *
           shadow_is_lit(light, place, low + between + (tap - 4) * step);
  }
  return lit;
}

float compared_by_taps(uint light, vec3 position, vec3 normal, float share) {
  if (!radial_has_moments() || shadow_maps[light].kind == SHADOW_NONE) return share;
  const ShadowPlace place = shadow_moved_place(light, position, normal);
  return place.w > 0.0 ? blur_of_comparisons(light, place) : share;
}

// Whether all texels that have a say in the look-up say the same of its point, each compared by itself.
uint texels_say(uint light, vec3 position, vec3 normal) {
  if (shadow_maps[light].kind == SHADOW_NONE) return TEXELS_DIFFER;
  const ShadowPlace place = shadow_moved_place(light, position, normal);
  if (!(place.w > 0.0)) return TEXELS_DIFFER;
  const ivec2 low = shadow_texel_of(place.texel - radial_taps(light));
  const ivec2 high = shadow_texel_of(place.texel + radial_taps(light));
  const float first = shadow_is_lit(light, place, low);
  for (int y = low.y; y <= high.y; ++y)
    for (int x = low.x; x <= high.x; ++x)
      if (shadow_is_lit(light, place, ivec2(x, y)) != first) return TEXELS_DIFFER;
  return first > 0.0 ? TEXELS_LIT : TEXELS_DARK;
}

void main() {
  const uint i = gl_GlobalInvocationID.x;
  if (i >= question.pairs) return;
  const uvec2 pixel = uvec2(pairs[i].pixel % frame.size_px.x, pairs[i].pixel / frame.size_px.x);
  const uint light = pairs[i].light;
  shadow_seed = seed_of_pixel(pixel);
  const Surface s = read_surface(ivec2(pixel), z_view_of(frame, texelFetch(depth_image, ivec2(pixel), 0).x));
  Way way;
  answers[i].light = unshadowed_luminance(reflector(s), emitter_at(light), way);
  const float share = shadow_of(light, s.position, s.normal, shadow_seed);
  answers[i].share = share;
  const bool texels = question.texels != 0u;
  answers[i].compared = !texels ? share : compared_by_taps(light, s.position, s.normal, share);
  answers[i].reached = radial_reaches_point(light, s.position) ? 1u : 0u;
  answers[i].held = mesh_may_hold(light, s.position) ? 1u : 0u;
  answers[i].texels = !texels ? TEXELS_DIFFER : texels_say(light, s.position, s.normal);
}
