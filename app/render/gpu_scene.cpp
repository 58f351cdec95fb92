// Uploads a scene and sorts it into draws.
// SPDX-License-Identifier: Apache-2.0
#include "render/gpu_scene.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>
#include <tuple>

#include "gpu/check.h"
#include "scene/normal_matrix.h"
#include "scene/still_surfaces.h"
#include "scene/triangles.h"

namespace lamp::app {
namespace {

gpu::TextureData texture_data(const Texture& t) {
  // KHR_texture_transform: scale, then rotate counter-clockwise as seen in the image (v points down), then offset.
  const float c = std::cos(t.rotation);
  const float s = std::sin(t.rotation);
  return {.u_row = {c * t.scale.x, s * t.scale.y},
          .v_row = {-s * t.scale.x, c * t.scale.y},
          .offset = t.offset,
          .uv = t.uv};
}

gpu::InstanceData instance_data(const Instance& instance, std::uint32_t first_triangle) {
  const glm::mat3 normal = normal_matrix(instance.world_from_object);
  return {.world_from_object = instance.world_from_object,
          .normal_x = normal[0],
          .normal_y = normal[1],
          .normal_z = normal[2],
          .first_triangle = first_triangle};
}

std::array<const Texture*, 5> textures_of(const Material& m) {
  return {&m.base_color_texture, &m.metallic_roughness_texture, &m.normal_texture, &m.occlusion_texture,
          &m.emissive_texture};
}

std::vector<std::byte> surroundings_bytes(const Scene& scene) {
  const gpu::Surroundings head{.ambient = scene.ambient,
                               .sky = scene.sky,
                               .directional_count = static_cast<std::uint32_t>(scene.directional_lights.size())};
  std::vector<std::byte> bytes(sizeof(head) + scene.directional_lights.size() * sizeof(gpu::DirectionalData));
  std::memcpy(bytes.data(), &head, sizeof(head));
  for (std::size_t i = 0; i < scene.directional_lights.size(); ++i) {
    const gpu::DirectionalData light{scene.directional_lights[i].direction, scene.directional_lights[i].illuminance};
    std::memcpy(bytes.data() + sizeof(head) + i * sizeof(light), &light, sizeof(light));
  }
  return bytes;
}

/// Where the device can. Not on a software device: Mesa's lavapipe walks every texel under a pixel one by one, and
/// under a triangle seen edge-on those have no end.
bool filters_anisotropically(const vulkan::Device& device) {
  VkPhysicalDeviceFeatures features{};
  vkGetPhysicalDeviceFeatures(device.physical, &features);
  VkPhysicalDeviceProperties properties{};
  vkGetPhysicalDeviceProperties(device.physical, &properties);
  return features.samplerAnisotropy == VK_TRUE && properties.deviceType != VK_PHYSICAL_DEVICE_TYPE_CPU;
}

glm::vec3 mesh_center(const Scene& scene, const Instance& instance) {
  const Box box = mesh_box(scene, scene.meshes[instance.mesh]);
  return glm::vec3(instance.world_from_object * glm::vec4((box.min + box.max) * 0.5F, 1.0F));
}

/// In the world.
shared::LightSphere sphere_around(const Scene& scene, const Mesh& mesh, const glm::mat4& m) {
  const Box box = mesh_box(scene, mesh);
  const glm::vec3 half = (box.max - box.min) * 0.5F;
  const float radius = glm::length(glm::vec3(m[0])) * half.x + glm::length(glm::vec3(m[1])) * half.y +
                       glm::length(glm::vec3(m[2])) * half.z;
  return {.center = glm::vec3(m * glm::vec4((box.min + box.max) * 0.5F, 1.0F)), .radius = radius};
}

}  // namespace

gpu::MaterialData material_data(const Material& m) {
  return {.base_color = m.base_color,
          .emissive = m.emissive,
          .metallic = m.metallic,
          .roughness = m.roughness,
          .normal_scale = m.normal_texture.image < 0 ? 0.0F : m.normal_scale,
          .occlusion_strength = m.occlusion_strength,
          .alpha_cutoff = m.alpha_mode == AlphaMode::mask ? drawn_alpha(m) : 0.0F,
          .least_alpha = m.alpha_mode == AlphaMode::blend ? 0.0F : 1.0F,
          .base_color_texture = texture_data(m.base_color_texture),
          .metallic_roughness_texture = texture_data(m.metallic_roughness_texture),
          .normal_texture = texture_data(m.normal_texture),
          .occlusion_texture = texture_data(m.occlusion_texture),
          .emissive_texture = texture_data(m.emissive_texture)};
}

std::vector<VkVertexInputAttributeDescription> vertex_attributes() {
  const auto at = [](std::uint32_t location, VkFormat format, std::size_t offset) {
    return VkVertexInputAttributeDescription{
        .location = location, .format = format, .offset = static_cast<std::uint32_t>(offset)};
  };
  return {at(0, VK_FORMAT_R32G32B32_SFLOAT, offsetof(Vertex, position)),
          at(1, VK_FORMAT_R32G32B32_SFLOAT, offsetof(Vertex, normal)),
          at(2, VK_FORMAT_R32G32B32A32_SFLOAT, offsetof(Vertex, tangent)),
          at(3, VK_FORMAT_R32G32_SFLOAT, offsetof(Vertex, uv)),
          at(4, VK_FORMAT_R32G32_SFLOAT, offsetof(Vertex, uv) + sizeof(glm::vec2)),
          at(5, VK_FORMAT_R8G8B8A8_UNORM, offsetof(Vertex, color))};
}

GpuScene::GpuScene(Context& context, const Scene& scene) : scene_(&scene) {
  vertices_ = upload_buffer(context, "vertices", bytes_of(scene.vertices),
                            VK_BUFFER_USAGE_VERTEX_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  indices_ = upload_buffer(context, "indices", bytes_of(scene.indices),
                           VK_BUFFER_USAGE_INDEX_BUFFER_BIT | VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  upload_materials(context);
  surroundings_ = upload_buffer(context, "surroundings", surroundings_bytes(scene), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  upload_textures(context);
  make_draws(context);
  if (scene.captured) captured_.emplace(context, *scene.captured);
}

void GpuScene::upload_materials(Context& context) {
  VkPhysicalDeviceProperties properties{};
  vkGetPhysicalDeviceProperties(context.device().physical, &properties);
  const std::uint64_t alignment = properties.limits.minUniformBufferOffsetAlignment;
  material_stride_ = (sizeof(gpu::MaterialData) + alignment - 1) / alignment * alignment;
  std::vector<std::byte> bytes(material_stride_ * scene_->materials.size());
  for (std::size_t i = 0; i < scene_->materials.size(); ++i) {
    const gpu::MaterialData data = material_data(scene_->materials[i]);
    std::memcpy(bytes.data() + i * material_stride_, &data, sizeof(data));
  }
  materials_ = upload_buffer(context, "materials", bytes, VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT);
}

void GpuScene::upload_textures(Context& context) {
  for (const Image& image : scene_->images)
    images_.push_back(upload_texture(context,
                                     {.name = image.name,
                                      .width = image.width,
                                      .height = image.height,
                                      .format = image.srgb ? VK_FORMAT_R8G8B8A8_SRGB : VK_FORMAT_R8G8B8A8_UNORM},
                                     bytes_of(image.rgba)));
  const std::vector<std::uint8_t> white(4, 255);
  images_.push_back(upload_texture(context, {.name = "white"}, bytes_of(white)));
  for (const Material& material : scene_->materials) {
    std::array<VkSampler, 5> samplers{};
    std::ranges::transform(textures_of(material), samplers.begin(),
                           [&](const Texture* t) { return sampler(context.device(), *t); });
    material_samplers_.push_back(samplers);
  }
}

VkSampler GpuScene::sampler(const vulkan::Device& device, const Texture& texture) {
  const auto u = static_cast<std::size_t>(texture.wrap_u);
  const auto v = static_cast<std::size_t>(texture.wrap_v);
  vulkan::OwnedSampler& slot = samplers_[(u * 3 + v) * 2 + (texture.nearest ? 1 : 0)];
  if (slot.get() != VK_NULL_HANDLE) return slot.get();
  constexpr std::array MODES{VK_SAMPLER_ADDRESS_MODE_REPEAT, VK_SAMPLER_ADDRESS_MODE_MIRRORED_REPEAT,
                             VK_SAMPLER_ADDRESS_MODE_CLAMP_TO_EDGE};
  const VkSamplerCreateInfo create{.sType = VK_STRUCTURE_TYPE_SAMPLER_CREATE_INFO,
                                   .magFilter = texture.nearest ? VK_FILTER_NEAREST : VK_FILTER_LINEAR,
                                   .minFilter = VK_FILTER_LINEAR,
                                   .mipmapMode = VK_SAMPLER_MIPMAP_MODE_LINEAR,
                                   .addressModeU = MODES[u],
                                   .addressModeV = MODES[v],
                                   .anisotropyEnable = filters_anisotropically(device) ? VK_TRUE : VK_FALSE,
                                   .maxAnisotropy = 4.0F,
                                   .maxLod = VK_LOD_CLAMP_NONE};
  VkSampler handle = VK_NULL_HANDLE;
  check(vkCreateSampler(device.handle, &create, nullptr, &handle), "creating a sampler");
  slot = vulkan::OwnedSampler(device.handle, handle, vkDestroySampler);
  return handle;
}

void GpuScene::make_draws(Context& context) {
  order_.resize(scene_->instances.size());
  std::iota(order_.begin(), order_.end(), 0U);
  std::ranges::sort(order_, {}, [&](std::uint32_t i) {
    const std::uint32_t mesh = scene_->instances[i].mesh;
    return std::tuple(scene_->meshes[mesh].material, mesh, i);
  });
  const std::vector<std::uint32_t> firsts = first_triangles(*scene_);
  for (std::uint32_t i = 0; i < order_.size(); ++i) {
    const Instance& instance = scene_->instances[order_[i]];
    instance_data_.push_back(instance_data(instance, firsts[order_[i]] - scene_->meshes[instance.mesh].vertex_offset));
    if (scene_->materials[scene_->meshes[instance.mesh].material].alpha_mode == AlphaMode::blend) {
      blended_.push_back(
          {.mesh = instance.mesh, .first_instance = i, .instances = 1, .center = mesh_center(*scene_, instance)});
    } else if (!opaque_.empty() && opaque_.back().mesh == instance.mesh) {
      ++opaque_.back().instances;
    } else {
      opaque_.push_back({.mesh = instance.mesh, .first_instance = i, .instances = 1});
    }
  }
  instances_ = upload_buffer(context, "instances", bytes_of(instance_data_), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
}

std::vector<shared::LightSphere> GpuScene::move(Context& context) {
  std::vector<shared::LightSphere> moved;
  for (std::size_t i = 0; i < order_.size(); ++i) {
    const Instance& instance = scene_->instances[order_[i]];
    const glm::mat4 before = glm::mat4(instance_data_[i].world_from_object);
    if (before == instance.world_from_object) continue;
    const Mesh& mesh = scene_->meshes[instance.mesh];
    moved.push_back(sphere_around(*scene_, mesh, before));
    moved.push_back(sphere_around(*scene_, mesh, instance.world_from_object));
    instance_data_[i] = instance_data(instance, instance_data_[i].first_triangle);
  }
  for (Draw& draw : blended_) draw.center = mesh_center(*scene_, scene_->instances[order_[draw.first_instance]]);
  instances_ = upload_buffer(context, "instances", bytes_of(instance_data_), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  return moved;
}

const Material& GpuScene::material_of(const Draw& draw) const {
  return scene_->materials[scene_->meshes[draw.mesh].material];
}

std::array<vulkan::Bound, 6> GpuScene::material_bound(std::uint32_t material) const {
  const std::array<const Texture*, 5> textures = textures_of(scene_->materials[material]);
  std::array<vulkan::Bound, 6> bound;
  for (std::uint32_t i = 0; i < 5; ++i) {
    const GpuImage& image =
        textures[i]->image < 0 ? images_.back() : images_[static_cast<std::size_t>(textures[i]->image)];
    bound[i] = {5 + i, image.combined(material_samplers_[material][i])};
  }
  bound[5] = {1,
              {.type = VK_DESCRIPTOR_TYPE_UNIFORM_BUFFER,
               .buffer = materials_.handle(),
               .offset = material * material_stride_,
               .range = sizeof(gpu::MaterialData)}};
  return bound;
}

void GpuScene::bind_geometry(VkCommandBuffer commands) const {
  const VkBuffer vertices = vertices_.handle();
  const VkDeviceSize offset = 0;
  vkCmdBindVertexBuffers(commands, 0, 1, &vertices, &offset);
  vkCmdBindIndexBuffer(commands, indices_.handle(), 0, VK_INDEX_TYPE_UINT32);
}

void GpuScene::draw(VkCommandBuffer commands, const Draw& draw) const {
  const Mesh& mesh = scene_->meshes[draw.mesh];
  vkCmdDrawIndexed(commands, mesh.index_count, draw.instances, mesh.first_index,
                   static_cast<std::int32_t>(mesh.vertex_offset), draw.first_instance);
}

}  // namespace lamp::app
