// The words of walks.comp for a pixel.
// Needs: `frame`, `words`, a look-up, lookup/parts/each.glsl, common/frame.glsl, walks_hash.glsl.
// SPDX-License-Identifier: Apache-2.0
const uint WORDS = 11u;

void main() {
  lookup_prepare();
  const uvec2 pixel = gl_GlobalInvocationID.xy;
  if (any(greaterThanEqual(pixel, frame.size_px))) return;
  const float z_view = z_view_of(frame, test_depth(pixel));
  const vec3 position = world_position(frame, vec2(pixel) + 0.5, z_view);
  const uint third = frame.light_count / 3u;
  const uint first = WORDS * (pixel.x + frame.size_px.x * pixel.y);
  words[first] = lookup_cell(pixel, z_view);
  words[first + 1u] = floatBitsToUint(z_view);
  words[first + 2u] = floatBitsToUint(position.x);
  words[first + 3u] = floatBitsToUint(position.y);
  words[first + 4u] = floatBitsToUint(position.z);
  words[first + 5u] = plain_hash(pixel, z_view);
  words[first + 6u] = each_hash(pixel, z_view);
  words[first + 7u] = each_in_hash(pixel, z_view, third, 2u * third);
  words[first + 8u] = few_in_hash(pixel, z_view, third, 2u * third);
  words[first + 9u] = taken_hash(pixel, z_view);
  words[first + 10u] = by_type_hash(pixel, z_view);
}
