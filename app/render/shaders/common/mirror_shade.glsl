// Lights what mirror rays met, and adds what the pixel's surface sends of it to the eye. What ambient light's specular
// part stood for is taken away as far as the ray takes its place.
// Needs: a look-up, and mirror_walk_begin(position).
// SPDX-License-Identifier: Apache-2.0
#include "mirror_data.h"

layout(local_size_x = 8, local_size_y = 8) in;
layout(set = 0, binding = 0, scalar) uniform FrameBuffer { Frame frame; };
layout(set = 0, binding = 2, rgba32f) uniform image2D hdr_image;
layout(set = 0, binding = 4, scalar) readonly buffer SurroundingsBuffer {
  Surroundings surroundings;
  DirectionalData directional_lights[];
};
layout(set = 0, binding = 8, scalar) readonly buffer HitBuffer { MirrorHit hits[]; };
layout(set = 0, binding = 9, scalar) readonly buffer MirrorSurfaceBuffer { MirrorSurface surfaces[]; };
layout(set = 0, binding = 10, std430) writeonly buffer WalkedBuffer { uint walked[]; };  // lights at each pixel's hit
layout(push_constant, scalar) uniform Push { MirrorPush push; };
layout(constant_id = 31) const bool WALKS_ALONE = false;  // nothing is lit: for the time of look-ups
#include "common/box.glsl"
#include "common/deferred_surface.glsl"
#include "common/lights.glsl"
#include "common/mirror.glsl"
#include "common/mixed.glsl"
#include "common/srgb.glsl"
#include "common/surroundings.glsl"

Surface surface_of(MirrorSurface m, vec3 to_eye) {
  const vec4 factors = unpackUnorm4x8(m.factors);
  return Surface(m.position, from_octahedral(m.normal), to_eye, linear_of_srgb(unpackUnorm4x8(m.base_color).rgb), factors.x,
                 max(factors.y, 0.045), factors.z);
}

uint seed_of_position(vec3 position) {
  const uvec3 bits = floatBitsToUint(position);
  return mixed(bits.x + mixed(bits.y + mixed(bits.z)));
}

// Towards the mirror.
vec3 light_of_hit(MirrorSurface m, vec3 to_eye) {
  const Surface s = surface_of(m, to_eye);
  const Reflector r = reflector(s);
  shadow_seed = seed_of_position(s.position);
  vec3 sum = shade_surroundings(s, r, vec3(unpackHalf2x16(m.emission.x), unpackHalf2x16(m.emission.y).x));
  const uint end = first_box(frame);  // decals behind the lights are no lights
  uint light;
  for (Walk walk = mirror_walk_begin(s.position); walk_next(walk, light);)
    if (light < end) add_light(sum, r, light);
  return sum;
}

uint lights_at(vec3 position) {
  uint count = 0u;
  uint light;
  for (Walk walk = mirror_walk_begin(position); walk_next(walk, light);) ++count;
  return count;
}

void main() {
  const uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, frame.size_px))) return;
  const uint number = pixel.y * frame.size_px.x + pixel.x;
  const MirrorHit hit = hits[number];
  if (WALKS_ALONE) {
    walked[number] = hit.triangle < MIRROR_ENDED ? lights_at(surfaces[number].position) : 0u;
    return;
  }
  if (hit.triangle == MIRROR_NO_RAY) return;
  const float z_view = z_view_of(frame, texelFetch(depth_image, ivec2(pixel), 0).x);
  const Surface s = read_surface(ivec2(pixel), z_view);
  const Reflector r = reflector(s);
  const MirrorRay ray = mirror_ray(s, z_view);
  const float weight = mirror_weight_of(s, push.roughness);
  vec3 mirrored = surroundings.sky;
  if (hit.triangle < MIRROR_ENDED) mirrored = light_of_hit(surfaces[number], -ray.direction);
  const vec4 before = imageLoad(hdr_image, ivec2(pixel));
  precise const vec3 ambient = (reflect_surroundings(r, surroundings.ambient) - surroundings.ambient * r.diffuse) * s.occlusion;
  precise const vec3 change = (mirrored * mirror_share(r) - ambient) * weight;
  precise const vec3 sum = max(before.rgb + change, 0.0);
  imageStore(hdr_image, ivec2(pixel), vec4(sum, before.a));
}
