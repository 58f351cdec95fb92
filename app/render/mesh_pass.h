// Raster passes over the scene's meshes: attachments, pipelines by material, draws.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "render/frame_data.h"
#include "render/gpu_scene.h"
#include "render/pass_uses.h"
#include "render/shader_library.h"
#include "render/targets.h"

namespace lamp::app {

/// Where a raster pass draws, and what is there before.
struct Attachments {
  struct Color {
    const GpuImage* image = nullptr;
    Load load = Load::keep;
    glm::vec3 clear{0.0F};
  };
  std::vector<Color> colors;
  const GpuImage* depth = nullptr;
  enum class Depth : std::uint8_t { clear, test } depth_use = Depth::clear;
  float sky = 0.0F;  ///< what depth is cleared to
};

/// The uses that attachments declare.
[[nodiscard]] std::vector<vulkan::Use> attachment_uses(const Attachments& attachments);
void begin_rendering(VkCommandBuffer commands, const Attachments& attachments, const Targets& targets);

/// Bindings 0 .. 9 that mesh.vert and material.glsl read (frame, materials, instances, lights, surroundings, textures).
[[nodiscard]] std::vector<vulkan::DescriptorBinding> mesh_bindings();

/// Vertex layout, culling and depth of a mesh pipeline. Depth is written unless it is compared for equality.
[[nodiscard]] vulkan::GraphicsState mesh_state(VkCompareOp compare, std::vector<VkFormat> colors);

/// Draws meshes with one pipeline for all materials, or another for opaque ones.
struct MeshDraws {
  const GpuScene* scene = nullptr;
  const FrameData* frame = nullptr;
  std::span<const Draw> draws;
  const vulkan::Pipeline* pipeline = nullptr;
  const vulkan::Pipeline* opaque_pipeline = nullptr;  ///< null: the same
  std::vector<vulkan::Bound> more;                    ///< further descriptors: a look-up's
};
void draw_meshes(vulkan::Recorder& recorder, const MeshDraws& what);

}  // namespace lamp::app
