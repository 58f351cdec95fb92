// The first triangle that a ray meets. Each thread has a stack in shared memory: no array lies in slow private memory, and
// nothing depends on the size of subgroups.
// Based on: Woop, Benthin, Wald, Watertight Ray/Triangle Intersection, JCGT 2:1 (2013), which meets every edge from one
// side at least; Ize, Robust BVH Ray Traversal, JCGT 2:2 (2013): boxes are met although rounding says that they are not.
// Needs: common/bvh_alpha.glsl; BVH_THREADS.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_BVH_WALK
#define LAMP_BVH_WALK

layout(constant_id = 30) const uint BVH_STACK = 54u;  // codes that may wait at once
shared uint s_codes[BVH_STACK * BVH_THREADS];         // each thread's are BVH_THREADS apart

const uint OUTSIDE_INSTANCES = 0xffffffffu;

// A ray as it is in the space of a level.
struct BvhRay {
  vec3 origin;
  vec3 direction;
  vec3 inverse;  // of the direction, without infinities
  vec3 low;      // the origin and more, from which lower faces of boxes are seen
  vec3 high;     // and less, for upper faces
};

BvhRay bvh_ray(vec3 origin, vec3 direction) {
  BvhRay ray;
  ray.origin = origin;
  ray.direction = direction;
  const vec3 least = vec3(1e-12) * max(abs(direction.x), max(abs(direction.y), abs(direction.z)));
  const vec3 signs = mix(vec3(1.0), vec3(-1.0), lessThan(direction, vec3(0.0)));
  ray.inverse = signs / max(abs(direction), max(least, vec3(1e-30)));
  const float room = 1e-6 * (abs(origin.x) + abs(origin.y) + abs(origin.z));
  ray.low = origin + room;
  ray.high = origin - room;
  return ray;
}

// Where the ray enters a box; infinite if it passes by, or only further on than `end`.
float enters(BvhRay ray, vec3 box_min, vec3 box_max, float end) {
  const vec3 a = (box_min - ray.low) * ray.inverse;
  const vec3 b = (box_max - ray.high) * ray.inverse;
  const vec3 near = min(a, b);
  const vec3 far = max(a, b);
  const float first = max(max(near.x, near.y), max(near.z, 0.0));
  const float last = min(min(far.x, far.y), min(far.z, end)) * 1.000001;
  return first <= last ? first : INFINITE_RADIUS;
}

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

// In two parts of half the bits, whose products are exact.
// Based on: Dekker, A Floating-Point Technique for Extending the Available Precision, Numerische Mathematik 18 (1971).
struct Halves {
  vec2 high;
  vec2 low;
};

Halves halves_of(vec2 v) {
  precise const vec2 scaled = 4097.0 * v;  // 2^12 + 1
  precise const vec2 high = scaled - (scaled - v);
  precise const vec2 low = v - high;
  return Halves(high, low);
}

// What rounding took from p * q = `rounded`; the same of q and p.
float lost_of(float rounded, float p_high, float p_low, float q_high, float q_low) {
  precise const float lost = (p_high * q_high - rounded) + (p_high * q_low + p_low * q_high) + p_low * q_low;
  return lost;
}

// p.x q.y - p.y q.x, about as near as 32 bits can say. Of q and p it is the same number with the other sign, however sums
// are rounded: so the two triangles at an edge agree on who has a ray.
float cross_of(vec2 p, vec2 q, Halves p2, Halves q2) {
  precise const vec2 rounded = p * q.yx;
  precise const float lost_x = lost_of(rounded.x, p2.high.x, p2.low.x, q2.high.y, q2.low.y);
  precise const float lost_y = lost_of(rounded.y, p2.high.y, p2.low.y, q2.high.x, q2.low.x);
  precise const float of_edge = (rounded.x - rounded.y) + (lost_x - lost_y);
  return of_edge;
}

float largest_of(vec2 a, vec2 b, vec2 c) {
  const vec2 most = max(abs(a), max(abs(b), abs(c)));
  return max(most.x, most.y);
}

// Whether a ray through 0 passes by a triangle, so far that rounding of plain products cannot matter.
bool passes_by(vec2 a, vec2 b, vec2 c) {
  const float size = largest_of(a, b, c);
  const float room = 1e-6 * size * size;  // two products and their difference are off by half of it, however rounded
  const vec3 of_edges = vec3(c.x * b.y - c.y * b.x, a.x * c.y - a.y * c.x, b.x * a.y - b.y * a.x);
  return min(of_edges.x, min(of_edges.y, of_edges.z)) < -room && max(of_edges.x, max(of_edges.y, of_edges.z)) > room;
}

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

bool is_met(BvhTriangle t, BvhInstance instance, BvhMet met) {
  const bool front = met.front != ((instance.kind & BVH_FLIPPED) != 0u);
  if (!front && (instance.kind & BVH_DOUBLE_SIDED) == 0u) return false;
  return (instance.kind & BVH_MASKED) == 0u || !is_hole(t, instance, vec2(met.u, met.v));
}

// The triangle and instance that the ray meets first; MIRROR_SKY if none. Of two at one distance, the lesser.
MirrorHit first_hit(MirrorRay of, uint root) {
  MirrorHit hit = MirrorHit(MIRROR_SKY, 0u, 0.0, 0.0);
  if (root == BVH_NOTHING) return hit;
  const uint mine = gl_LocalInvocationIndex;
  float end = 1e30;
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
        if (!is_nearer || !is_met(t, instance, met)) continue;
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
    code = s_codes[mine + BVH_THREADS * --waiting];
  }
  return hit;
}

#endif
