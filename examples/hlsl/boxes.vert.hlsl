// The boxes of the scene, as common/shaders/box.glsl has them.
// SPDX-License-Identifier: Apache-2.0
struct Box {
  float3 center;
  float3 half_extent;
  uint material;
};
[[vk::push_constant]] cbuffer Push { row_major float4x4 clip_from_world; };  // rows are the columns of GLSL

struct Surface {
  float4 pixel : SV_Position;
  float3 position : POSITION;
  nointerpolation float3 normal : NORMAL;
  nointerpolation float3 albedo : COLOR;
};

static const float2 QUAD[6] = {float2(-1, -1), float2(1, -1), float2(1, 1), float2(-1, -1), float2(1, 1), float2(-1, 1)};
static const float3 ALBEDOS[5] = {float3(0.7, 0.7, 0.7), float3(0.9, 0.5, 0.4), float3(0.4, 0.8, 0.5),
                                  float3(0.5, 0.6, 0.9), float3(0.9, 0.9, 0.9)};

Box box_of(uint instance) {
  Box box;
  const uint x = (instance - 1) % 8;
  const uint z = (instance - 1) / 8;
  const float height = 0.3 + 0.35 * float((x * 5 + z * 3) % 7);
  const float width = 0.35 + 0.05 * float((x + 2 * z) % 4);
  box.center = instance == 0 ? float3(0, -0.5, 0) : float3(3.0 * float(x) - 10.5, height, 3.0 * float(z) - 10.5);
  box.half_extent = instance == 0 ? float3(14, 0.5, 14) : float3(width, height, width);
  box.material = instance == 0 ? 0 : 1 + (x + z) % 4;
  return box;
}

Surface main(uint vertex : SV_VertexID, uint instance : SV_InstanceID) {
  const Box box = box_of(instance);
  const uint axis = vertex / 12;
  float3 normal = float3(0, 0, 0);
  normal[axis] = (vertex / 6) % 2 == 0 ? -1.0 : 1.0;
  float3 corner = normal;
  corner[(axis + 1) % 3] = QUAD[vertex % 6].x;
  corner[(axis + 2) % 3] = QUAD[vertex % 6].y;
  Surface surface;
  surface.position = box.center + box.half_extent * corner;
  surface.normal = normal;
  surface.albedo = ALBEDOS[box.material];
  surface.pixel = mul(float4(surface.position, 1.0), clip_from_world);
  return surface;
}
