// Lights with shadows: lamp::ShadowAtlas says which squares of one depth image are drawn in a frame, the host draws
// them, and lights leave the lists of cells that their own shadow keeps dark. Frames have a budget that the first one
// exceeds, and most lights stand still. Rays from each pixel to each light say whether shadows are where they belong.
// SPDX-License-Identifier: Apache-2.0
#include <lamplight/shader_code.h>   // lamplight
#include <lamplight/shadow_atlas.h>  // lamplight
#include <lamplight/value_of.h>      // lamplight
#include <lamplight/vulkan.h>        // lamplight

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/ext/matrix_transform.hpp>
#include <glm/glm.hpp>
#include <stdexcept>

#include "gpu.h"
#include "scene.h"

namespace {

constexpr std::uint32_t BOX_SHADER[] = {
#include "boxes.vert.inc"
};
constexpr std::uint32_t FORWARD[] = {
#include "forward.frag.inc"
};
constexpr std::uint32_t BRUTE_FORCE[] = {
#include "brute_force.frag.inc"
};
constexpr std::uint32_t SHADOW_BOXES[] = {
#include "shadow.vert.inc"
};
constexpr std::uint32_t SHADOW_DEPTH[] = {
#include "shadow.frag.inc"
};

constexpr vk::Extent2D SIZE{320, 180};
constexpr std::uint32_t HOUSE_BOXES = 87;  // as in house.glsl
constexpr std::uint32_t ROOMS = 12;
constexpr std::uint32_t MOVING = 6;  // the last ones
constexpr std::uint32_t LIGHTS = 2 * ROOMS + MOVING;
constexpr std::uint32_t FRAMES = 4;
constexpr std::uint32_t ATLAS = 2048;                              // texels a side
constexpr std::uint64_t BUDGET = 1536 * 1024;                      // texels a frame
constexpr std::uint32_t BY_MAPS = 0, BY_RAYS = 1, NO_SHADOWS = 2;  // as in brute_force.frag

/// Push constants, as in brute_force.frag.
struct Push {
  glm::mat4 clip_from_world;
  std::uint32_t light_count;
};

/// In each room a lamp and a spot, which stand still, and lights that go around in every second one.
std::vector<HostLight> lights_of_house(std::uint32_t frame) {
  std::vector<HostLight> lights(LIGHTS);
  for (std::uint32_t i = 0; i < LIGHTS; ++i) {
    const std::uint32_t room = i < 2 * ROOMS ? i % ROOMS : 2 * (i - 2 * ROOMS) + i % 2;
    const glm::vec3 middle(5.0F * static_cast<float>(room % 4) - 7.5F, 0.0F,
                           4.5F * static_cast<float>(room / 4) - 4.5F);
    const float hue = 0.9F * static_cast<float>(i);
    const glm::vec3 color = 0.65F + 0.35F * glm::cos(glm::vec3(hue, hue + 2.1F, hue + 4.2F));
    if (i < ROOMS) {
      lights[i] = {middle + glm::vec3(0.2F, 0.9F, 0.1F), 8.0F, {0, -1, 0}, -1.0F, 2.5F * color, 0.0F};
    } else if (i < 2 * ROOMS) {
      const glm::vec3 from(-2.2F, 2.1F, 1.9F);
      lights[i] = {middle + from, 5.0F, glm::normalize(glm::vec3(1.2F, 0.3F, -0.9F) - from), 0.5F, 5.0F * color, 0.0F};
    } else {
      const float angle = 0.4F * static_cast<float>(frame) + hue;
      lights[i] = {middle + glm::vec3(1.6F * std::cos(angle), 0.4F, 1.4F * std::sin(angle)),
                   3.0F,
                   {0, -1, 0},
                   -1.0F,
                   1.5F * color,
                   0.0F};
    }
  }
  return lights;
}

// lamplight {
std::vector<lamp::shared::Light> pack(const std::vector<HostLight>& lights) {
  std::vector<lamp::Light> described;
  for (const HostLight& light : lights)
    described.push_back({.type = light.outer_angle < 0 ? lamp::LightType::point : lamp::LightType::spot,
                         .position = light.position,
                         .range = light.range,
                         .direction = light.direction,
                         .outer_angle = std::max(light.outer_angle, 0.0F)});
  return lamp::pack(described);
}
// }

void write(const Gpu& gpu, const Pipeline& to, std::uint32_t binding, const Buffer& buffer) {
  const vk::DescriptorBufferInfo all{buffer.handle, 0, VK_WHOLE_SIZE};
  const vk::WriteDescriptorSet write{
      .dstSet = *to.set, .dstBinding = binding, .descriptorType = vk::DescriptorType::eStorageBuffer};
  gpu.device.updateDescriptorSets(vk::WriteDescriptorSet(write).setBufferInfo(all), {});
}
void write(const Gpu& gpu, const Pipeline& to, std::uint32_t binding, const Image& image) {
  const vk::DescriptorImageInfo all{{}, *image.view, vk::ImageLayout::eGeneral};
  const vk::WriteDescriptorSet write{
      .dstSet = *to.set, .dstBinding = binding, .descriptorType = vk::DescriptorType::eSampledImage};
  gpu.device.updateDescriptorSets(vk::WriteDescriptorSet(write).setImageInfo(all), {});
}

// lamplight {
/// What shadow_of reads, from binding `first` on: maps, the atlas, and moments, which this filter has none of.
std::vector<VkDescriptorSetLayoutBinding> shadow_bindings(std::uint32_t first) {
  return {{first, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_ALL},
          {first + 1, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, 1, VK_SHADER_STAGE_ALL},
          {first + 2, VK_DESCRIPTOR_TYPE_SAMPLED_IMAGE, 1, VK_SHADER_STAGE_ALL}};
}
// }

struct Shadows {
  Image atlas;
  Buffer maps, views, jobs, bounds;
  Pipeline draw, make_bounds;
  std::uint32_t view_count = 0, job_count = 0;
  std::vector<vk::ClearRect> squares;
};

void write_shadows(const Gpu& gpu, const Pipeline& to, std::uint32_t first, const Shadows& shadows) {
  write(gpu, to, first, shadows.maps);
  write(gpu, to, first + 1, shadows.atlas);
  write(gpu, to, first + 2, shadows.atlas);
}

Shadows make_shadows(Gpu& gpu) {
  Shadows made{.atlas = gpu.make_image(DEPTH, {ATLAS, ATLAS}),
               // lamplight {
               .maps = gpu.make_buffer(LIGHTS * sizeof(lamp::shared::ShadowMap)),
               .views = gpu.make_buffer(LIGHTS * lamp::shared::VIEWS_A_LIGHT * sizeof(lamp::shared::ShadowView)),
               .jobs = gpu.make_buffer(LIGHTS * sizeof(lamp::shared::RadialJob)),
               .bounds = gpu.make_buffer(LIGHTS * sizeof(lamp::shared::RadialBound))};
  // }
  made.draw = gpu.make_pipeline({.vertex = SHADOW_BOXES,
                                 .fragment = SHADOW_DEPTH,
                                 .buffers = {{made.views.handle, 0, VK_WHOLE_SIZE}},
                                 .depth_alone = true});
  // lamplight {
  PipelineInfo bounds{.compute = lamp::find_shader(lamp::library_shaders(), "shadow/radial_bounds")->spirv,
                      .bindings = shadow_bindings(0)};
  for (const std::uint32_t binding : {3U, 4U})
    bounds.bindings.push_back({binding, VK_DESCRIPTOR_TYPE_STORAGE_BUFFER, 1, VK_SHADER_STAGE_ALL});
  const auto constants = lamp::vulkan::BoundLookUp{}.specialization({{0, lamp::shared::SHADOW_PCF}});
  bounds.constants = constants.info();
  // }
  made.make_bounds = gpu.make_pipeline(bounds);
  write_shadows(gpu, made.make_bounds, 0, made);
  write(gpu, made.make_bounds, 3, made.jobs);
  write(gpu, made.make_bounds, 4, made.bounds);
  return made;
}

// lamplight {
lamp::ShadowCounts schedule(Shadows& shadows, lamp::ShadowAtlas& atlas, const lamp::View& view,
                            std::span<const lamp::shared::Light> lights) {
  const lamp::ShadowFrame frame =
      value_of(atlas.schedule({.views = std::span(&view, 1), .lights = lights, .budget_texels = BUDGET}));
  std::ranges::copy(frame.maps, shadows.maps.as<lamp::shared::ShadowMap>().begin());
  std::ranges::copy(frame.views, shadows.views.as<lamp::shared::ShadowView>().begin());
  std::ranges::copy(frame.radial_jobs, shadows.jobs.as<lamp::shared::RadialJob>().begin());
  shadows.view_count = static_cast<std::uint32_t>(frame.views.size());
  shadows.job_count = static_cast<std::uint32_t>(frame.radial_jobs.size());
  shadows.squares.clear();
  for (const auto& [corner, side] : frame.squares)
    shadows.squares.push_back({{{static_cast<int>(corner.x), static_cast<int>(corner.y)}, {side, side}}, 0, 1});
  return frame.counts;
}
// }

/// Draws the squares of the frame, and makes bounds of what they show.
void draw_shadows(const Commands& commands, const Shadows& shadows) {
  begin_rendering(commands, {.depth = shadows.atlas});
  bind(commands, shadows.draw, 0U);
  if (!shadows.squares.empty())
    commands.clearAttachments(vk::ClearAttachment{.aspectMask = vk::ImageAspectFlagBits::eDepth}, shadows.squares);
  commands.draw(BOX_VERTICES, HOUSE_BOXES * shadows.view_count, 0, 0);
  commands.endRendering();
  barrier(commands);
  bind(commands, shadows.make_bounds, shadows.job_count);  // lamplight
  commands.dispatch(shadows.job_count, 1, 1);              // lamplight
  barrier(commands);
}

struct Picture {
  Pipeline pipeline;
  Buffer pixels;
};

Picture make_picture(const Gpu& gpu, PipelineInfo info, std::uint32_t kind, const Shadows& shadows,
                     const lamp::vulkan::Device& device, const lamp::vulkan::BoundLookUp& lookup) {  // lamplight
  // lamplight {
  const auto constants = lookup.specialization({{lamp::SHADOW_CONSTANT, lamp::shared::SHADOW_PCF}, {0, kind}});
  info.bindings = lookup.layout_bindings(VK_SHADER_STAGE_ALL, shadow_bindings(lamp::SHADOW_BINDING));
  info.constants = constants.info();
  // }
  Picture made{gpu.make_pipeline(info), gpu.make_buffer(sizeof(glm::vec4) * SIZE.width * SIZE.height)};
  write_shadows(gpu, made.pipeline, lamp::SHADOW_BINDING, shadows);  // lamplight
  lookup.write_to(device, *made.pipeline.set);                       // lamplight
  return made;
}

/// Means over pixels and channels.
double mean_difference(const Picture& a, const Picture& b) {
  double sum = 0.0;
  const Pixels of_b = b.pixels.as<glm::vec4>();
  for (std::size_t i = 0; i < of_b.size(); ++i)
    for (int k = 0; k < 3; ++k) sum += std::abs(double{a.pixels.as<glm::vec4>()[i][k]} - double{of_b[i][k]});
  return sum / 3.0 / static_cast<double>(of_b.size());
}
double mean_walked(const Picture& picture) {
  double sum = 0.0;
  for (const glm::vec4& pixel : picture.pixels.as<glm::vec4>()) sum += double{pixel.w};
  return sum / static_cast<double>(SIZE.width * SIZE.height);
}

bool run(const std::string& file) {
  Gpu gpu;
  // lamplight {
  const auto instance = value_of(lamp::vulkan::load_instance(gpu.context.getDispatcher()->vkGetInstanceProcAddr,
                                                             *gpu.instance, VK_API_VERSION_1_3));
  if (const auto lack = lamp::vulkan::check_device(instance, *gpu.physical)) throw std::runtime_error(lack->text());
  lamp::vulkan::RequiredFeatures features;
  features.base.features.depthClamp = VK_TRUE;
  features.base.features.shaderClipDistance = VK_TRUE;
  gpu.make_device(features.base);
  const auto device = value_of(lamp::vulkan::make_device(instance, *gpu.physical, *gpu.device));
  // }
  const double aspect = double{SIZE.width} / SIZE.height;
  const glm::dmat4 clip_from_view = reversed_projection(-0.42 * aspect, 0.42 * aspect, -0.42, 0.42);
  const glm::dmat4 view_from_house = glm::lookAt(glm::dvec3(0, 17, 10), glm::dvec3(0, 0, 0.5), glm::dvec3(0, 1, 0));
  const Push push{glm::mat4(clip_from_view * view_from_house), LIGHTS};

  // lamplight {
  const auto view = value_of(lamp::View::create(SIZE.width, SIZE.height, clip_from_view, view_from_house));
  auto atlas = value_of(lamp::ShadowAtlas::create(
      {.size = ATLAS, .max_image_size = device.traits.max_image_size, .light_capacity = LIGHTS}));
  lamp::vulkan::CullerInfo info{.width = SIZE.width,
                                .height = SIZE.height,
                                .light_capacity = LIGHTS,
                                .method = "lamplight",
                                .options = {"tile=8"},
                                .light_layout = lamp::LightLayout::interleaved(
                                    sizeof(HostLight), offsetof(HostLight, position), offsetof(HostLight, direction))};
  auto culler = value_of(lamp::vulkan::Culler::create(device, info));
  info.options.emplace_back("occlusion=radial");
  auto cutting_culler = value_of(lamp::vulkan::Culler::create(device, info));
  // }
  const Buffer light_buffer = gpu.make_buffer(LIGHTS * sizeof(HostLight));
  const Image color = gpu.make_image(COLOR, SIZE);
  const Image depth = gpu.make_image(DEPTH, SIZE);
  const Pipeline draw_depth = gpu.make_pipeline({.vertex = BOX_SHADER});
  Shadows shadows = make_shadows(gpu);
  PipelineInfo shading{.vertex = BOX_SHADER,
                       .fragment = FORWARD,
                       .buffers = {{light_buffer.handle, 0, VK_WHOLE_SIZE}},
                       .depth_compare = vk::CompareOp::eEqual};
  const Picture cut = make_picture(gpu, shading, BY_MAPS, shadows, device, cutting_culler.lookup());  // lamplight
  const Picture uncut = make_picture(gpu, shading, BY_MAPS, shadows, device, culler.lookup());        // lamplight
  shading.fragment = BRUTE_FORCE;
  const auto all_lights = [&](std::uint32_t kind) { return make_picture(gpu, shading, kind, shadows, device, {}); };
  const Picture by_maps = all_lights(BY_MAPS);
  const Picture by_rays = all_lights(BY_RAYS);
  const Picture unshadowed = all_lights(NO_SHADOWS);

  bool good = true;
  for (std::uint32_t frame = 0; frame < FRAMES; ++frame) {
    const std::vector<HostLight> lights = lights_of_house(frame);
    std::ranges::copy(lights, light_buffer.as<HostLight>().begin());
    const lamp::ShadowCounts counts = schedule(shadows, atlas, view, pack(lights));  // lamplight
    std::printf("%u lights drawn, %u wait, %u without a shadow; ", counts.redrawn, counts.waiting, counts.without);
    const bool last = frame + 1 == FRAMES;
    gpu.submit(gpu.graphics, [&](const Commands& commands) {
      draw_shadows(commands, shadows);
      begin_rendering(commands, {.color = &color, .depth = depth, .clear_depth = 0.0F});
      bind(commands, draw_depth, push);
      commands.draw(BOX_VERTICES, HOUSE_BOXES, 0, 0);
      commands.endRendering();
      barrier(commands);
      // lamplight {
      lamp::vulkan::CullerFrame input{.view = &view,
                                      .lights = light_buffer.handle,
                                      .cones = light_buffer.handle,
                                      .light_count = LIGHTS,
                                      .depth_image = *depth.handle,
                                      .depth_view = *depth.view,
                                      .depth_layout = VK_IMAGE_LAYOUT_GENERAL};
      value_of(culler.record(*commands, input));
      input.radial = shadows.bounds.handle;
      value_of(cutting_culler.record(*commands, input));
      // }
      std::vector<const Picture*> pictures{&cut, &uncut, &by_maps};
      if (last) pictures.insert(pictures.end(), {&by_rays, &unshadowed});
      for (const Picture* picture : pictures) {
        begin_rendering(commands, {.color = &color, .depth = depth});
        bind(commands, picture->pipeline, push);
        commands.draw(BOX_VERTICES, HOUSE_BOXES, 0, 0);
        commands.endRendering();
        read_back(commands, color, picture->pixels);
      }
    });
    gpu.wait();
    good = compare(cut.pixels.as<glm::vec4>(), by_maps.pixels.as<glm::vec4>(), file, SIZE.width) && good;
    if (frame == 0) good = counts.waiting > 0 && good;
    if (last) good = counts.waiting == 0 && counts.without == 0 && counts.redrawn == MOVING && good;
  }
  std::printf("without the cut by shadows: ");
  good = compare(uncut.pixels.as<glm::vec4>(), by_maps.pixels.as<glm::vec4>(), "", SIZE.width) && good;
  const double stopped = mean_difference(by_rays, unshadowed);
  const double wrong = mean_difference(by_rays, by_maps);
  std::printf("shadows take %.4f of the light, on average over pixels; %.4f is not what rays say\n", stopped, wrong);
  return good && stopped > 0.01 && wrong < 0.1 * stopped && mean_walked(cut) < 0.95 * mean_walked(uncut);
}

}  // namespace

int main(int argc, char** argv) { return run_example(argc, argv, run); }
