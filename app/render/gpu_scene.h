// A scene on the GPU: vertices, materials, instances, textures, and the draws it consists of.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <optional>
#include <vector>

#include "gpu/transfer.h"
#include "lamplight/shared/light.h"
#include "render/captured_surfaces.h"
#include "render/shaders/scene_data.h"
#include "scene/scene.h"

namespace lamp::app {

/// All instances of one mesh.
struct Draw {
  std::uint32_t mesh = 0;
  std::uint32_t first_instance = 0;
  std::uint32_t instances = 0;
  glm::vec3 center{0.0F};  ///< world space, of the first instance; transparent draws are sorted by it
};

class GpuScene {
 public:
  GpuScene(Context& context, const Scene& scene);

  [[nodiscard]] const Scene& scene() const { return *scene_; }
  [[nodiscard]] std::span<const Draw> opaque() const { return opaque_; }    ///< opaque and masked, by material
  [[nodiscard]] std::span<const Draw> blended() const { return blended_; }  ///< one instance each
  /// Of a captured frame, which is drawn instead of meshes; or null.
  [[nodiscard]] const CapturedSurfaces* captured() const { return captured_ ? &*captured_ : nullptr; }
  [[nodiscard]] const Material& material_of(const Draw& draw) const;

  [[nodiscard]] vulkan::Resource vertices() const { return vulkan::Resource::storage(vertices_.handle()); }
  [[nodiscard]] vulkan::Resource indices() const { return vulkan::Resource::storage(indices_.handle()); }
  [[nodiscard]] vulkan::Resource instances() const { return vulkan::Resource::storage(instances_.handle()); }
  [[nodiscard]] vulkan::Resource surroundings() const { return vulkan::Resource::storage(surroundings_.handle()); }
  /// A material: its uniform block at binding 1, its five textures at bindings 5 .. 9.
  [[nodiscard]] std::array<vulkan::Bound, 6> material_bound(std::uint32_t material) const;

  /// The scene's instances have moved: uploads them, waiting. Spheres around where each was and is.
  std::vector<shared::LightSphere> move(Context& context);

  void bind_geometry(VkCommandBuffer commands) const;
  void draw(VkCommandBuffer commands, const Draw& draw) const;

 private:
  void upload_materials(Context& context);
  void upload_textures(Context& context);
  void make_draws(Context& context);
  [[nodiscard]] VkSampler sampler(const vulkan::Device& device, const Texture& texture);

  const Scene* scene_;
  vulkan::Buffer vertices_;
  vulkan::Buffer indices_;
  vulkan::Buffer materials_;
  std::uint64_t material_stride_ = 0;  ///< bytes from one uniform block to the next
  std::vector<std::uint32_t> order_;   ///< of the scene's instances, as they are drawn
  std::vector<gpu::InstanceData> instance_data_;
  vulkan::Buffer instances_;
  vulkan::Buffer surroundings_;
  std::vector<GpuImage> images_;  ///< the scene's, then one white texel
  std::array<vulkan::OwnedSampler, 18> samplers_;
  std::vector<std::array<VkSampler, 5>> material_samplers_;
  std::vector<Draw> opaque_;
  std::vector<Draw> blended_;
  std::optional<CapturedSurfaces> captured_;
};

/// A material as shaders read it, without its images.
[[nodiscard]] gpu::MaterialData material_data(const Material& material);

/// The vertex attributes of mesh.vert.
[[nodiscard]] std::vector<VkVertexInputAttributeDescription> vertex_attributes();

}  // namespace lamp::app
