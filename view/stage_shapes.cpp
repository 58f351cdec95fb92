// Shapes around lights and the squares of a shadow map, read back from the frame that was drawn.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "gpu/transfer.h"
#include "lamplight/shared/proxy.h"
#include "render/light_outlines.h"
#include "render/pass_uses.h"
#include "render/shadow_squares.h"
#include "view/shadow_overlay.h"
#include "view/stage_kept.h"

namespace lamp::app {
namespace {

constexpr float EVERYWHERE_M = 1e6F;  // as in common/light_proxy.glsl: larger lights cover the screen
constexpr std::uint32_t DRAWS = 4;

std::optional<ResourceId> find_buffer(const Plan& plan, std::string_view name) {
  const auto found = std::ranges::find(plan.buffers, name, &BufferDesc::name);
  if (found == plan.buffers.end()) return std::nullopt;
  return PLAN_BUFFER + static_cast<ResourceId>(found - plan.buffers.begin());
}

/// The lights that a state asks for; all, if it asks for those of a cell that there is not.
bool is_asked_for(const ViewState& state, const Shown& shown, std::uint32_t light) {
  if (state.proxies == LightMarks::all) return true;
  return shown.inspection &&
         std::ranges::find(shown.inspection->lights, light, &ListedLight::light) != shown.inspection->lights.end();
}

}  // namespace

ShownProxies Stage::read_proxies(const ViewState& state, const Lighting& lighting, const Shown& shown) {
  const vulkan::PlanRunner& runner = lighting.runner();
  const auto proxies = find_buffer(runner.plan(), "light proxies");
  const auto drawn = find_buffer(runner.plan(), "drawn lights");
  const auto draws = find_buffer(runner.plan(), "draws");
  ShownProxies read;
  if (!proxies || !drawn || !draws) {
    read.refused = fmt::format("{} rasterises no lights; drobot-raster-tile and drobot-raster-cluster do",
                               lighting.info().method->name);
    return read;
  }
  const auto count =
      static_cast<std::uint32_t>(runner.plan().buffers[*draws - PLAN_BUFFER].bytes / sizeof(shared::ProxyDraw));
  const std::size_t capacity = runner.plan().buffers[*drawn - PLAN_BUFFER].bytes / sizeof(std::uint32_t) / count;
  const std::vector<std::uint32_t> words = read_words(runner.buffer(*draws), std::size_t{DRAWS} * count);
  const std::vector<std::uint32_t> lights = read_words(runner.buffer(*drawn), capacity * count);
  const EntityRange are_lights = renderer_->entities().lights;
  for (std::uint32_t which = 0; which < count; ++which) {
    const std::uint32_t instances = words[DRAWS * which + 1];
    for (std::uint32_t i = 0; i < instances; ++i) {
      const std::uint32_t light = lights[which * capacity + i];
      if (light < are_lights.first || light >= are_lights.end) continue;  // a decal's or a probe's sphere
      const bool cut = which >= shared::CUT_OUTSIDE;
      const bool inside = which == shared::PROXIES_INSIDE || which == shared::CUT_INSIDE;
      ++read.drawn;
      read.cut += cut ? 1 : 0;
      read.inside += inside ? 1 : 0;
      if (!is_asked_for(state, shown, light) || lights_->lights->all()[light].range > EVERYWHERE_M) continue;
      read.shapes.push_back({.light = light, .cut = cut, .inside = inside, .corners = {}});
    }
  }
  std::ranges::sort(read.shapes, {}, &LightShape::light);
  if (read.shapes.size() > MOST_SHAPES) read.shapes.resize(MOST_SHAPES);
  std::vector<gpu::OutlineJob> jobs;
  for (const LightShape& shape : read.shapes)
    jobs.push_back({.light = shape.light, .shape = shape.cut ? gpu::OUTLINE_CUT : gpu::OUTLINE_PROXY});
  std::vector<Outline> found = outlines(*renderer_, shaders_, runner.buffer(*proxies), jobs);
  for (std::size_t i = 0; i < found.size(); ++i) read.shapes[i].corners = std::move(found[i]);
  return read;
}

std::vector<float> Stage::read_square(const shared::ShadowMap& map, std::uint32_t square) {
  const GpuImage& atlas = renderer_->shadows()->atlas();
  const std::size_t texels = std::size_t{map.side} * map.side;
  const vulkan::Buffer read = readback_buffer(context_.device(), "square of a shadow map", texels * sizeof(float));
  const UVec2 corner = square_at(map, square).corner;
  VkBufferImageCopy part = atlas.whole();
  part.imageOffset = {static_cast<std::int32_t>(corner.x), static_cast<std::int32_t>(corner.y), 0};
  part.imageExtent = {map.side, map.side, 1};
  renderer_->also([&](vulkan::Recorder& recorder) {
    const vulkan::Resource to = vulkan::Resource::storage(read.handle());
    recorder.barrier({copies_from(atlas.transfer_source()), copies_to(to)});
    vkCmdCopyImageToBuffer(recorder.commands(), atlas.handle(), VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL, read.handle(), 1,
                           &part);
    recorder.barrier({host_reads(to)});
  });
  renderer_->forget(read);
  return first_values<float>(read, texels);
}

std::optional<ShownShadow> Stage::read_shadow(const ViewState& state) {
  const Shadows* shadows = renderer_->shadows();
  if (shadows == nullptr || !state.light || *state.light >= lights_->lights->size()) return std::nullopt;
  ShownShadow read{.light = *state.light};
  const std::uint32_t record = renderer_->record_of(read.light);
  if (record >= shadows->maps().size()) return read;
  read.map = shadows->maps()[record];
  if (read.map.kind == shared::SHADOW_NONE) return read;
  if (record < shadows->ages().size()) read.age = shadows->ages()[record];
  constexpr std::uint32_t MOST_SIDE = 48;  // of a picture
  read.side = std::min(MOST_SIDE, read.map.side);
  for (std::uint32_t square = 0; square < squares_of(read.map); ++square)
    read.squares.push_back(picture_of_square(state.palette, read.map, read_square(read.map, square), read.side));
  if (state.shadow_shape == ShadowShape::none) return read;
  const bool mesh = state.shadow_shape == ShadowShape::mesh;
  renderer_->make_reach(mesh ? ShadowReach::Kind::meshes : ShadowReach::Kind::radial);
  const gpu::OutlineJob job{.light = record, .shape = mesh ? gpu::OUTLINE_MESH : gpu::OUTLINE_BOUND};
  read.shape = {.light = read.light,
                .corners = std::move(outlines(*renderer_, shaders_, VK_NULL_HANDLE, {&job, 1}).front())};
  return read;
}

}  // namespace lamp::app
