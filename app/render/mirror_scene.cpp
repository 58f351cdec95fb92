// Uploads what rays read.
// SPDX-License-Identifier: Apache-2.0
#include "render/mirror_scene.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cstring>

#include "gpu/check.h"
#include "render/gpu_scene.h"
#include "render/mirror_images.h"
#include "render/pass_uses.h"

namespace lamp::app {
namespace {

constexpr VkBufferUsageFlags STORAGE = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;

std::uint32_t wrap_of(Wrap wrap) {
  return wrap == Wrap::repeat   ? gpu::MIRROR_WRAP_REPEAT
         : wrap == Wrap::mirror ? gpu::MIRROR_WRAP_MIRROR
                                : gpu::MIRROR_WRAP_CLAMP;
}

gpu::MirrorTexture mirror_texture(const gpu::TextureData& place, const Texture& texture) {
  return {.place = place,
          .image = texture.image < 0 ? gpu::MIRROR_NO_IMAGE : static_cast<std::uint32_t>(texture.image),
          .wrap_u = wrap_of(texture.wrap_u),
          .wrap_v = wrap_of(texture.wrap_v)};
}

gpu::MirrorMaterial mirror_material(const Material& m) {
  const gpu::MaterialData factors = material_data(m);
  return {.factors = factors,
          .base_color = mirror_texture(factors.base_color_texture, m.base_color_texture),
          .metallic_roughness = mirror_texture(factors.metallic_roughness_texture, m.metallic_roughness_texture),
          .normal = mirror_texture(factors.normal_texture, m.normal_texture),
          .occlusion = mirror_texture(factors.occlusion_texture, m.occlusion_texture),
          .emissive = mirror_texture(factors.emissive_texture, m.emissive_texture)};
}

}  // namespace

MirrorScene::MirrorScene(Context& context, const GpuScene& drawn) : drawn_(drawn), bvh_(make_bvh(drawn.scene())) {
  upload_bvh(context);
  std::vector<gpu::MirrorMaterial> materials;
  for (const Material& material : drawn.scene().materials) materials.push_back(mirror_material(material));
  materials_ = upload_buffer(context, "materials of rays", bytes_of(materials), STORAGE);
  upload_images(context, drawn.scene());
}

void MirrorScene::upload_bvh(Context& context) {
  const std::uint64_t most = context.device().traits.max_storage_buffer_bytes;
  const std::uint64_t largest = std::max(bytes_of(bvh_.triangles).size(), bytes_of(bvh_.nodes).size());
  if (largest > most)
    throw Error(fmt::format("rays through the scene: {} triangles take {} MB, expected at most {} on this device",
                            bvh_.triangles.size(), largest / 1'000'000, most / 1'000'000));
  triangles_ = upload_buffer(context, "triangles of rays", bytes_of(bvh_.triangles), STORAGE);
  nodes_ = upload_buffer(context, "nodes of rays", bytes_of(bvh_.nodes), STORAGE | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  instances_ =
      upload_buffer(context, "instances of rays", bytes_of(bvh_.instances), STORAGE | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
}

void MirrorScene::upload_images(Context& context, const Scene& scene) {
  first_levels_ = levels_that_fit(scene, context.device().traits.max_storage_buffer_bytes / sizeof(std::uint32_t));
  std::vector<std::vector<std::uint32_t>> texels(scene.images.size());
  std::vector<gpu::MirrorImage> images(scene.images.size());
  tbb::parallel_for(std::size_t{0}, texels.size(), [&](std::size_t i) {
    const Image& image = scene.images[i];
    images[i] = {.width = side_at(image.width, first_levels_[i]),
                 .height = side_at(image.height, first_levels_[i]),
                 .is_srgb = image.srgb ? 1U : 0U};
    texels[i] = texels_of(image, first_levels_[i], images[i].levels);
  });
  std::vector<std::uint32_t> all;
  for (std::size_t i = 0; i < texels.size(); ++i) {
    images[i].first = static_cast<std::uint32_t>(all.size());
    all.insert(all.end(), texels[i].begin(), texels[i].end());
  }
  const auto coarser = std::ranges::count_if(first_levels_, [](std::uint32_t first) { return first != 0; });
  if (coarser != 0) {
    const std::vector<bool> holes = cuts_holes(scene);
    std::size_t of_holes = 0;
    for (std::size_t i = 0; i < holes.size(); ++i) of_holes += holes[i] && first_levels_[i] != 0 ? 1U : 0U;
    notes_.push_back(fmt::format("{} images of {} do not fit the device's largest buffer: mirrors show them coarser{}",
                                 coarser, scene.images.size(),
                                 of_holes == 0 ? "" : fmt::format("; {} of them cut holes", of_holes)));
  }
  images_ = upload_buffer(context, "images of rays", bytes_of(images), STORAGE);
  texels_ = upload_buffer(context, "texels of rays", bytes_of(all), STORAGE);
}

void MirrorScene::move(Context& context, const Scene& scene) {
  if (!refit(bvh_, scene)) return upload_bvh(context);
  const std::span<const std::byte> instances = bytes_of(bvh_.instances);
  const std::span<const std::byte> nodes = std::as_bytes(std::span(bvh_.nodes).subspan(bvh_.first_upper));
  if (staging_.bytes() < instances.size() + nodes.size())
    staging_ = take(vulkan::Buffer::create(context.device(), {.name = "moved instances",
                                                              .bytes = instances.size() + nodes.size(),
                                                              .usage = VK_BUFFER_USAGE_TRANSFER_SRC_BIT,
                                                              .memory = vulkan::MemoryUse::upload}));
  if (instances.empty()) return;
  std::memcpy(staging_.mapped().data(), instances.data(), instances.size());
  if (!nodes.empty()) std::memcpy(staging_.mapped().subspan(instances.size()).data(), nodes.data(), nodes.size());
  moved_ = true;
}

void MirrorScene::record_upload(vulkan::Recorder& recorder) {
  if (!std::exchange(moved_, false)) return;
  recorder.barrier({copies_to(vulkan::Resource::storage(instances_.handle())),
                    copies_to(vulkan::Resource::storage(nodes_.handle()))});
  const std::uint64_t instances = bvh_.instances.size() * sizeof(gpu::BvhInstance);
  const std::uint64_t first = bvh_.first_upper * sizeof(gpu::BvhNode);
  const std::uint64_t nodes = bvh_.nodes.size() * sizeof(gpu::BvhNode) - first;
  const VkBufferCopy of_instances{.size = instances};
  const VkBufferCopy of_nodes{.srcOffset = instances, .dstOffset = first, .size = nodes};
  vkCmdCopyBuffer(recorder.commands(), staging_.handle(), instances_.handle(), 1, &of_instances);
  if (nodes != 0) vkCmdCopyBuffer(recorder.commands(), staging_.handle(), nodes_.handle(), 1, &of_nodes);
}

std::uint64_t MirrorScene::bytes() const {
  std::uint64_t sum = 0;
  for (const vulkan::Buffer* buffer : {&nodes_, &triangles_, &instances_, &materials_, &images_, &texels_})
    sum += buffer->bytes();
  return sum;
}

std::vector<vulkan::Bound> MirrorScene::bound(std::uint32_t first) const {
  const auto storage = [](const vulkan::Buffer& buffer) { return vulkan::Resource::storage(buffer.handle()); };
  return {{first, storage(nodes_)},       {first + 1, storage(triangles_)}, {first + 2, storage(instances_)},
          {first + 3, drawn_.vertices()}, {first + 4, drawn_.indices()},    {first + 5, storage(materials_)},
          {first + 6, storage(images_)},  {first + 7, storage(texels_)}};
}

}  // namespace lamp::app
