// Smoke whose particles are lit one by one in a compute shader: in the picture, hidden, behind the camera, far away.
// Lists of a picture have no lights for most of these; world-cells lists the lights of any position, and the boxes'
// pixels ask the same lists. There is too little room at first, to show how it grows.
// SPDX-License-Identifier: Apache-2.0
#include <lamplight/value_of.h>  // lamplight
#include <lamplight/vulkan.h>    // lamplight

#include <algorithm>
#include <array>
#include <cstdio>
#include <glm/ext.hpp>
#include <glm/glm.hpp>
#include <stdexcept>

#include "gpu.h"
#include "scene.h"

namespace {

constexpr std::uint32_t PLACE[] = {
#include "place.comp.inc"
};
constexpr std::uint32_t SCATTER[] = {
#include "scatter.comp.inc"
};
constexpr std::uint32_t BRUTE_FORCE_SCATTER[] = {
#include "brute_force.comp.inc"
};
constexpr std::uint32_t BOX_SHADER[] = {
#include "boxes.vert.inc"
};
constexpr std::uint32_t FORWARD[] = {
#include "forward.frag.inc"
};
constexpr std::uint32_t BRUTE_FORCE[] = {
#include "brute_force.frag.inc"
};
constexpr std::uint32_t SPRITES[] = {
#include "sprites.vert.inc"
};
constexpr std::uint32_t PUFF[] = {
#include "sprites.frag.inc"
};

constexpr vk::Extent2D SIZE{320, 180};
constexpr std::uint32_t LIGHTS = 600;
constexpr std::uint32_t PARTICLES = 6000;
constexpr std::uint32_t GROUPS = (PARTICLES + 63) / 64;

const glm::dmat4 VIEW_FROM_WORLD = glm::lookAt(glm::dvec3(-5, 5.5, 17), glm::dvec3(0, 0.4, 0), glm::dvec3(0, 1, 0));
constexpr vec3 BEHIND{-5, 0, 40};
constexpr vec3 FAR{0, 0, -400};
struct Place {  // push constants of place.comp
  std::array<vec3, 8> plumes{vec3(-6, 0, 3), vec3(-3, 0, -6), vec3(-3, 0, 9), vec3(3, 0, -3),
                             vec3(0, 0, 3),  vec3(6, 0, 4),   BEHIND,         FAR};
  float time;
};
struct Push {  // of the shaders that draw
  glm::mat4 clip_from_world;
  glm::vec2 clip_from_m;
};
struct Particle {  // as in particle.glsl
  vec3 position;
  float radius;
  float opacity;
};

/// A third of the lights circle around the plumes out of sight.
std::vector<HostLight> lights_around_plumes(std::uint32_t frame) {
  std::vector<HostLight> lights = make_lights(LIGHTS, frame);
  for (HostLight& light : lights) light.color *= 0.5F;
  for (std::uint32_t i = 0; i < LIGHTS; i += 3)
    lights[i].position = vec3(0.3F, 1.0F, 0.3F) * lights[i].position + (i % 2 == 0 ? BEHIND : FAR);
  return lights;
}

/// One of two ways to the same picture: by lists, or from all lights.
struct Way {
  Buffer scattered, picture;
  Pipeline scatter, depth, boxes, sprites;
};

struct Shaders {
  std::span<const std::uint32_t> scatter, surface;
  std::vector<VkDescriptorSetLayoutBinding> bindings;
  vk::SpecializationInfo constants;
};

Way make_way(const Gpu& gpu, const Shaders& shaders, const Buffer& lights, const Buffer& particles) {
  Way way{.scattered = gpu.make_buffer(sizeof(glm::vec4) * PARTICLES),
          .picture = gpu.make_buffer(sizeof(glm::vec4) * SIZE.width * SIZE.height)};
  const auto whole = [](const Buffer& buffer) { return vk::DescriptorBufferInfo{buffer.handle, 0, VK_WHOLE_SIZE}; };
  way.scatter = gpu.make_pipeline({.compute = shaders.scatter,
                                   .buffers = {whole(lights), whole(particles), whole(way.scattered)},
                                   .bindings = shaders.bindings,
                                   .constants = shaders.constants});
  way.depth = gpu.make_pipeline({.vertex = BOX_SHADER});
  way.boxes = gpu.make_pipeline({.vertex = BOX_SHADER,
                                 .fragment = shaders.surface,
                                 .buffers = {whole(lights)},
                                 .bindings = shaders.bindings,
                                 .constants = shaders.constants,
                                 .depth_compare = vk::CompareOp::eEqual});
  way.sprites = gpu.make_pipeline(
      {.vertex = SPRITES, .fragment = PUFF, .buffers = {whole(particles), whole(way.scattered)}, .blended = true});
  return way;
}

void draw(const Commands& commands, const Way& way, const Push& push, const Image& color, const Image& depth) {
  bind(commands, way.scatter, 0);
  commands.dispatch(GROUPS, 1, 1);
  begin_rendering(commands, {.color = &color, .depth = depth, .clear_depth = 0.0F});
  for (const Pipeline* pipeline : {&way.depth, &way.boxes}) {
    bind(commands, *pipeline, push);
    commands.draw(BOX_VERTICES, BOXES, 0, 0);
  }
  bind(commands, way.sprites, push);
  commands.draw(6, PARTICLES, 0, 0);
  commands.endRendering();
  read_back(commands, color, way.picture);
}

/// Prints what lists saved the particles. False where their light differs from that of all lights by more than 0.0001,
/// where half of the lights were walked after all, or where fewer than a fifth of the particles lie outside the picture
/// and have light there.
bool compare_particles(Pixels by_lists, Pixels brute_force, std::span<const Particle> particles, const Push& push) {
  double walked = 0;
  float difference = 0;
  std::uint32_t lit_outside = 0;
  bool same = true;
  for (std::uint32_t i = 0; i < PARTICLES; ++i) {
    const vec3 d = glm::abs(vec3(by_lists[i] - brute_force[i]));
    difference = std::max({difference, d.x, d.y, d.z});
    same = same && glm::all(glm::lessThanEqual(d, vec3(1e-4F)));  // fails for what is not a number, too
    walked += static_cast<double>(by_lists[i].w) / PARTICLES;
    const glm::vec4 clip = push.clip_from_world * glm::vec4(particles[i].position, 1);
    const bool outside = std::max(std::abs(clip.x), std::abs(clip.y)) > clip.w || clip.z < 0 || clip.z > clip.w;
    if (outside && brute_force[i].y > 0.01F) ++lit_outside;
  }
  std::printf(
      "walked %.1f lights a particle instead of %u; %u of %u have light outside the picture; largest difference %g\n",
      walked, LIGHTS, lit_outside, PARTICLES, static_cast<double>(difference));
  return same && walked > 0 && walked < 0.5 * LIGHTS && lit_outside > PARTICLES / 5;
}

/// What only smoke has lit: pixels in which no surface is. False where there are few.
bool has_smoke(Pixels brute_force) {
  const auto pixels = std::ranges::count_if(brute_force, [](glm::vec4 p) { return p.w == 0 && p.y > 0.01F; });
  std::printf("smoke in %td pixels of the sky\n", pixels);
  return pixels > 200;
}

bool run(const std::string& file) {
  Gpu gpu;
  // lamplight {
  const auto instance = value_of(lamp::vulkan::load_instance(gpu.context.getDispatcher()->vkGetInstanceProcAddr,
                                                             *gpu.instance, VK_API_VERSION_1_3));
  if (const auto lack = lamp::vulkan::check_device(instance, *gpu.physical)) throw std::runtime_error(lack->text());
  const lamp::vulkan::RequiredFeatures features;
  gpu.make_device(features.base, lamp::vulkan::useful_extensions(instance, *gpu.physical));
  // }
  if (!(gpu.physical.getFormatProperties(COLOR).optimalTilingFeatures &
        vk::FormatFeatureFlagBits::eColorAttachmentBlend))
    throw vk::FeatureNotPresentError("blending of 32-bit floats");
  const double aspect = double{SIZE.width} / SIZE.height;
  const glm::dmat4 clip_from_view = reversed_projection(-0.42 * aspect, 0.42 * aspect, -0.42, 0.42);
  const Push push{clip_from_view * VIEW_FROM_WORLD, {clip_from_view[0][0], clip_from_view[1][1]}};

  Shaders walking{.scatter = SCATTER, .surface = FORWARD};
  // lamplight {
  const auto device = value_of(lamp::vulkan::make_device(instance, *gpu.physical, *gpu.device));
  const auto view = value_of(lamp::View::create(SIZE.width, SIZE.height, clip_from_view, VIEW_FROM_WORLD));
  auto culler = value_of(lamp::vulkan::Culler::create(
      device, {.width = SIZE.width,
               .height = SIZE.height,
               .light_capacity = LIGHTS,
               .method = "world-cells",
               .options = {"mean_bricks=10"},  // too little at first; by default there is enough
               .light_layout = lamp::LightLayout::interleaved(sizeof(HostLight), offsetof(HostLight, position),
                                                              offsetof(HostLight, direction))}));
  const lamp::vulkan::BoundLookUp lookup = culler.lookup();
  const lamp::vulkan::SpecializationConstants constants = lookup.specialization();
  walking.bindings = lookup.layout_bindings(VK_SHADER_STAGE_COMPUTE_BIT | VK_SHADER_STAGE_FRAGMENT_BIT);
  walking.constants = constants.info();
  // }

  const Buffer lights = gpu.make_buffer(LIGHTS * sizeof(HostLight));
  const Buffer particles = gpu.make_buffer(PARTICLES * sizeof(Particle));
  const Image color = gpu.make_image(COLOR, SIZE);
  const Image depth = gpu.make_image(DEPTH, SIZE);
  const Pipeline place = gpu.make_pipeline({.compute = PLACE, .buffers = {{particles.handle, 0, VK_WHOLE_SIZE}}});
  const Way by_lists = make_way(gpu, walking, lights, particles);
  const Way brute_force = make_way(gpu, {.scatter = BRUTE_FORCE_SCATTER, .surface = BRUTE_FORCE}, lights, particles);
  // lamplight {
  lookup.write_to(device, *by_lists.scatter.set);
  lookup.write_to(device, *by_lists.boxes.set);
  // }

  bool good = true;
  for (std::uint32_t frame = 0; frame < 3; ++frame) {
    std::ranges::copy(lights_around_plumes(frame), lights.as<HostLight>().begin());
    std::uint64_t number = 0;
    gpu.submit(gpu.graphics, [&](const Commands& commands) {
      bind(commands, place, Place{.time = 0.05F * static_cast<float>(frame)});
      commands.dispatch(GROUPS, 1, 1);
      // lamplight {
      number = value_of(culler.record(
          *commands, {.view = &view, .lights = lights.handle, .cones = lights.handle, .light_count = LIGHTS}));
      // }
      barrier(commands);
      draw(commands, by_lists, push, color, depth);
      draw(commands, brute_force, push, color, depth);
    });
    gpu.wait();
    // lamplight {
    const std::uint32_t overflowed = culler.counters().overflowed_cells;
    if (value_of(culler.finish(number)) != lamp::vulkan::Growth::none) {
      culler.lookup().write_to(device, *by_lists.scatter.set);
      culler.lookup().write_to(device, *by_lists.boxes.set);
    }
    // }
    std::printf("%u cells had no room\n", overflowed);
    good = (overflowed != 0) == (frame == 0) && good;
    good = compare_particles(by_lists.scattered.as<glm::vec4>(), brute_force.scattered.as<glm::vec4>(),
                             particles.as<Particle>(), push) &&
           good;
    good = compare(by_lists.picture.as<glm::vec4>(), brute_force.picture.as<glm::vec4>(), file, SIZE.width) && good;
    good = has_smoke(brute_force.picture.as<glm::vec4>()) && good;
  }
  return good;
}

}  // namespace

int main(int argc, char** argv) { return run_example(argc, argv, run); }
