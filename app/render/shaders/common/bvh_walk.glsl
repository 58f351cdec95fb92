// The first triangle that a ray meets, or any. Each thread has a stack in shared memory: no array lies in slow private memory, and
// nothing depends on the size of subgroups.
// Based on: Woop, Benthin, Wald, Watertight Ray/Triangle Intersection, JCGT 2:1 (2013), which meets every edge from one
// side at least.
// Needs: common/bvh_scene.glsl; BVH_THREADS.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_BVH_WALK
#define LAMP_BVH_WALK
#include "common/bvh_ray.glsl"
#include "common/exact_cross.glsl"

layout(constant_id = 30) const uint BVH_STACK = 54u;  // codes that may wait at once
shared uint s_codes[BVH_STACK * BVH_THREADS];         // each thread's are BVH_THREADS apart

const uint OUTSIDE_INSTANCES = 0xffffffffu;

// x, y and z of a vector so that z is the direction's largest.
vec3 turned(vec3 v, vec3 direction) {
  const vec3 size = abs(direction);
  if (size.x >= size.y && size.x >= size.z) return v.yzx;
  return size.y >= size.z ? v.zxy : v;
}

struct BvhMet {
  float at;  // along the direction
  float u;
  float v;
  bool front;
};

// Both sides; an edge belongs to both its triangles. With plain products, a hit on a triangle L long and w wide would be off
// by L / w times as much as its corners are.
bool meets(BvhRay ray, vec3 corner_a, vec3 corner_b, vec3 corner_c, out BvhMet met) {
  const vec3 d = turned(ray.direction, ray.direction);
  precise const vec3 shear = vec3(d.xy, 1.0) / d.z;
  precise const vec3 a = turned(corner_a - ray.origin, ray.direction);
  precise const vec3 b = turned(corner_b - ray.origin, ray.direction);
  precise const vec3 c = turned(corner_c - ray.origin, ray.direction);
  precise const vec2 at_a = a.xy - shear.xy * a.z;
  precise const vec2 at_b = b.xy - shear.xy * b.z;
  precise const vec2 at_c = c.xy - shear.xy * c.z;
  if (passes_by(at_a, at_b, at_c)) return false;
  const Halves a2 = halves_of(at_a);
  const Halves b2 = halves_of(at_b);
  const Halves c2 = halves_of(at_c);
  precise const float of_a = cross_of(at_c, at_b, c2, b2);
  precise const float of_b = cross_of(at_a, at_c, a2, c2);
  precise const float of_c = cross_of(at_b, at_a, b2, a2);
  precise const float sum = of_a + of_b + of_c;
  const bool is_out = min(of_a, min(of_b, of_c)) < 0.0 && max(of_a, max(of_b, of_c)) > 0.0;
  if (is_out || sum == 0.0) return false;
  precise const vec3 weights = vec3(of_a, of_b, of_c) / sum;  // first: products with distances could be too large
  precise const float at = (weights.x * a.z + weights.y * b.z + weights.z * c.z) * shear.z;
  met = BvhMet(at, weights.y, weights.z, (sum > 0.0) == (d.z > 0.0));
  return true;
}

// `any`: from either side. Holes are not there.
bool is_met(BvhTriangle t, BvhInstance instance, BvhMet met, bool any) {
  if (!any) {
    const bool front = met.front != ((instance.kind & BVH_FLIPPED) != 0u);
    if (!front && (instance.kind & BVH_DOUBLE_SIDED) == 0u) return false;
  }
  return (instance.kind & BVH_MASKED) == 0u || !is_hole(t, instance, vec2(met.u, met.v));
}

// The triangle and instance that the ray meets first up to `end`, m; MIRROR_SKY if none. Of two at one distance, the
// lesser. `any`: one that it meets, from whichever side.
MirrorHit walk_bvh(MirrorRay of, uint root, float end, bool any) {
  MirrorHit hit = MirrorHit(MIRROR_SKY, 0u, 0.0, 0.0);
  if (root == BVH_NOTHING) return hit;
  const uint mine = gl_LocalInvocationIndex;
  BvhRay ray = bvh_ray(of.origin, of.direction);
  uint inside = OUTSIDE_INSTANCES;
  uint waiting = 0u;
  uint waiting_outside = 0u;
  uint code = root;
  BvhInstance instance;
  while (true) {
    const uint number = code / BVH_COUNTS;
    const uint count = code % BVH_COUNTS;
    bool goes_on = false;
    if (count == 0u) {
      const BvhNode node = bvh_nodes[number];
      const float first = enters(ray, node.min_first, node.max_first, end);
      const float second = enters(ray, node.min_second, node.max_second, end);
      const float nearer = min(first, second);
      goes_on = nearer < INFINITE_RADIUS;
      const bool swaps = second < first;
      code = swaps ? node.second : node.first;
      if (max(first, second) < INFINITE_RADIUS) s_codes[mine + BVH_THREADS * waiting++] = swaps ? node.first : node.second;
    } else if (inside == OUTSIDE_INSTANCES) {
      inside = number;
      instance = bvh_instances[number];
      const vec3 from = of.origin - instance.origin;
      ray = bvh_ray(vec3(dot(instance.row_x, from), dot(instance.row_y, from), dot(instance.row_z, from)),
                    vec3(dot(instance.row_x, of.direction), dot(instance.row_y, of.direction), dot(instance.row_z, of.direction)));
      waiting_outside = waiting;
      code = instance.root;
      goes_on = true;
    } else {
      for (uint i = number; i < number + count; ++i) {
        const BvhTriangle t = bvh_triangles[i];
        BvhMet met;
        if (!meets(ray, t.a, t.b, t.c, met) || met.at <= 0.0 || met.at > end) continue;
        const bool is_nearer = met.at < end || inside < hit.instance || (inside == hit.instance && i < hit.triangle);
        if (!is_nearer || !is_met(t, instance, met, any)) continue;
        end = met.at;
        hit = MirrorHit(i, inside, met.u, met.v);
      }
    }
    if (goes_on) continue;
    if (inside != OUTSIDE_INSTANCES && waiting == waiting_outside) {
      inside = OUTSIDE_INSTANCES;
      ray = bvh_ray(of.origin, of.direction);
    }
    if (waiting == 0u) break;
    if (any) {
      if (hit.triangle != MIRROR_SKY) break;
    }
    code = s_codes[mine + BVH_THREADS * --waiting];
  }
  return hit;
}

MirrorHit first_hit(MirrorRay of, uint root) { return walk_bvh(of, root, 1e30, /*any*/ false); }

// Whether anything lies on the ray up to `end`, m.
bool is_stopped(MirrorRay of, uint root, float end) { return walk_bvh(of, root, end, /*any*/ true).triangle != MIRROR_SKY; }

#endif
