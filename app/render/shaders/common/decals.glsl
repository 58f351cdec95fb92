// Paints the decals of a pixel's cell onto its surface, in the order of their ids: the last lies on top.
// Needs: a look-up, `frame`.
// Promise: a surface that no decal's box holds keeps its bits; a longer list paints the same.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_DECALS
#define LAMP_DECALS
#include "common/boxes.glsl"
#include "common/brdf.glsl"
#include "common/decal_patterns.glsl"
#include "common/frame.glsl"
#include "lookup/parts/each.glsl"

layout(set = 0, binding = 10, scalar) readonly buffer DecalBuffer { DecalData decals[]; };

uint end_of_decals() { return min(first_probe(frame), light_count_of(frame)); }

// Metres that a pixel is wide at a depth.
float pixel_width(float z_view) {
  const mat4 m = frame.clip_from_view;
  return abs(2.0 * (m[3][3] - m[2][3] * z_view) / (float(frame.size_px.x) * m[0][0]));
}

// The slope of the relief turns the normal; z points out of the surface.
vec3 bent_normal(vec3 normal, DecalData d, vec2 p, float soft, float height, float share) {
  const float step_m = max(soft, 0.002);
  precise const float along_x = paint_of(d, p + vec2(step_m, 0.0), soft).height - height;
  precise const float along_y = paint_of(d, p + vec2(0.0, step_m), soft).height - height;
  precise const vec3 slope = (d.box.axis_x * along_x + d.box.axis_y * along_y) * (d.relief / step_m);
  return normalize(normal - slope * share);
}

// Whether anything of the decal is seen there.
bool paint_decal(inout Surface s, vec3 facing, DecalData d, float soft) {
  const vec3 local = box_local(d.box, s.position);
  if (!box_holds(d.box, local)) return false;
  precise const float fade = clamp((dot(facing, d.box.axis_z) - d.cos_none) * d.fade_scale, 0.0, 1.0);
  if (fade <= 0.0) return false;
  const Paint paint = paint_of(d, local.xy, soft);
  precise const float share = paint.alpha * d.opacity * fade;
  if (share <= 0.0) return false;
  s.base_color = mix(s.base_color, clamp(paint.color, 0.0, 1.0), share);
  if (d.relief > 0.0) s.normal = bent_normal(s.normal, d, local.xy, soft, paint.height, share);
  return true;
}

// Lists in no order: each round finds the least id that is left of those whose box holds the surface.
bool apply_decals_of_any_order(inout Surface s, vec3 facing, uvec2 pixel, float z_view, float soft) {
  bool painted = false;
  const uint first = first_box(frame);
  for (uint next = first; next < end_of_decals();) {
    uint least = end_of_decals();
    uint id;
    LOOKUP_FEW_IN(id, pixel, z_view, next, least) {
      const OrientedBox box = decals[id - first].box;
      if (box_holds(box, box_local(box, s.position))) least = id;
    }
    if (least < end_of_decals()) painted = paint_decal(s, facing, decals[least - first], soft) || painted;
    next = least + 1u;
  }
  return painted;
}

bool apply_decals(inout Surface s, uvec2 pixel, float z_view) {
  const vec3 facing = s.normal;
  const float soft = pixel_width(z_view);
  if (!BOXES_ASCEND) return apply_decals_of_any_order(s, facing, pixel, z_view, soft);
  bool painted = false;
  const uint first = first_box(frame);
  uint id;
  LOOKUP_FEW_IN(id, pixel, z_view, first, end_of_decals())
    painted = paint_decal(s, facing, decals[id - first], soft) || painted;
  return painted;
}

#endif
