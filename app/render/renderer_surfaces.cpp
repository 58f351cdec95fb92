// The surfaces of a view: drawn, kept, forgotten and read back.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cassert>

#include "gpu/transfer.h"
#include "render/gbuffer_texels.h"
#include "render/renderer.h"

namespace lamp::app {

void Renderer::light_still(const StillLists* lists) {
  still_ = lists;
  const bool numbered = lists != nullptr && lists->kind() == gpu::STILL_TRIANGLES;
  if (numbered == targets_->numbered) return;
  if (numbered) {
    geometry_.need_triangles(device(), shaders_);
    targets_->need_triangles(device());
  }
  targets_->numbered = numbered;
  forget_surfaces();
}

void Renderer::forget_surfaces() {
  surfaces_drawn_ = false;
  if (kept_) std::ranges::for_each(kept_->buffers(), [&](const vulkan::Buffer* buffer) { forget(*buffer); });
  kept_.reset();
}

template <class Texel>
std::vector<Texel> Renderer::read_texels(const GpuImage& image) {
  const std::size_t pixels = std::size_t{targets_->width} * targets_->height;
  const vulkan::Buffer buffer = readback_buffer(context_.device(), "texel read-back", pixels * sizeof(Texel));
  context_.submit([&](VkCommandBuffer commands) {
    vulkan::Recorder recorder(context_.device(), commands, tracker_);
    record_readback(recorder, image, buffer);
  });
  tracker_.forget(buffer.handle());
  return first_values<Texel>(buffer, pixels);
}

std::vector<float> Renderer::read_depth() { return read_texels<float>(targets_->depth); }

std::vector<std::uint32_t> Renderer::read_triangles() {
  assert(targets_->numbered && "of lists of triangles");
  need_surfaces();
  return read_texels<std::uint32_t>(targets_->triangles);
}

void Renderer::draw_surfaces(Lighting* decals) {
  submit(decals, [&](VkCommandBuffer commands) {
    vulkan::Recorder recorder(context_.device(), commands, tracker_);
    record_upload(recorder);
    if (decals != nullptr)
      decals->record_surfaces(recorder, lighting_frame());
    else
      geometry_.record_gbuffer(recorder, scene_, data_, *targets_);
  });
  surfaces_drawn_ = decals == nullptr;
}

void Renderer::need_surfaces() {
  if (!surfaces_drawn_) draw_surfaces();
}

void Renderer::keep_surfaces() {
  if (kept_ || targets_->numbered) return;
  need_surfaces();
  kept_.emplace(context_.device(), *targets_);
  context_.submit([&](VkCommandBuffer commands) {
    vulkan::Recorder recorder(context_.device(), commands, tracker_);
    kept_->record_keep(recorder, *targets_);
  });
}

std::vector<float> Renderer::draw_depth() {
  draw_surfaces();
  return read_depth();
}

CapturedFrame Renderer::capture(Lighting* decals) {
  draw_surfaces(decals);
  return decode(shown_view_, {.depth = read_depth(),
                              .base_color = read_texels<glm::u8vec4>(targets_->base_color),
                              .surface = read_texels<glm::uvec2>(targets_->surface),
                              .emission = read_texels<glm::u16vec4>(targets_->emission)});
}

}  // namespace lamp::app
