// A ray against the boxes of a hierarchy.
// Based on: Ize, Robust BVH Ray Traversal, JCGT 2:2 (2013): boxes are met although rounding says that they are not.
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_BVH_RAY
#define LAMP_BVH_RAY

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

#endif
