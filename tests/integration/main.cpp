// A headless engine that lets Lamplight cull its lights: frames of moving lights, every pixel's count held against a
// count of its own on the CPU. Exit code 0: all equal, and no validation message.
// SPDX-License-Identifier: Apache-2.0
#include <lamplight/light.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdio>
#include <exception>
#include <glm/ext/matrix_transform.hpp>
#include <random>

#include "light_culling.h"

namespace {

constexpr std::uint32_t CLUSTERED[] = {
#include "count_clustered.inc"
};
constexpr std::uint32_t CLUSTERED_HLSL[] = {
#include "count_clustered.comp.hlsl.inc"
};
constexpr std::uint32_t TILED_BITS[] = {
#include "count_tiled_bits.inc"
};

constexpr VkExtent2D SIZE{163, 91};  // no multiple of any tile
constexpr std::uint32_t PIXELS = SIZE.width * SIZE.height;
constexpr std::uint32_t CAPACITY = 700;

/// The sum over a frame's pixels, and the pixels whose count is wrong.
struct Sums {
  std::uint64_t reached = 0;
  std::uint64_t walked = 0;
  std::uint32_t wrong = 0;
};

lamp::View make_view() {
  const glm::dmat4 projection =
      lamp::perspective(lamp::symmetric_window(1.0, double{SIZE.width} / SIZE.height), 0.1, lamp::INFINITE_FAR);
  const glm::dmat4 pose = glm::lookAt(glm::dvec3(3, 2, 6), glm::dvec3(0, 1, 0), glm::dvec3(0, 1, 0));
  return lamp::View::create(SIZE.width, SIZE.height, projection, pose).value();
}

/// A floor and boxes of noise, with sky above: what a depth pass would have left.
void draw_depth(std::span<float> depth) {
  for (std::uint32_t y = 0; y < SIZE.height; ++y)
    for (std::uint32_t x = 0; x < SIZE.width; ++x) {
      const float far_m = 3.0F + static_cast<float>((x / 7 * 31 + y / 5 * 17) % 23);
      depth[x + SIZE.width * y] = y < SIZE.height / 5 ? 0.0F : 0.1F / far_m;
    }
}

std::vector<lamp::Light> make_lights(std::uint32_t count, std::uint32_t frame) {
  std::mt19937 random(1 + frame);
  const auto between = [&](float low, float high) {
    return low + (high - low) * static_cast<float>(random()) / 4294967296.0F;
  };
  std::vector<lamp::Light> lights(count);
  for (lamp::Light& light : lights) {
    light.type = random() % 2 == 0 ? lamp::LightType::point : lamp::LightType::spot;
    light.position = {between(-8, 8), between(-6, 6), between(-20, 6)};
    light.range = between(0.5F, 3.0F);
    light.direction = {between(-1, 1), between(-1, 1), between(-1, 1)};
    light.outer_angle = between(0.1F, 1.5F);
  }
  if (count != 0) lights[0] = {.position = {0, 1, 0}};  // reaches everything
  return lights;
}

/// Not lost to this engine's -ffast-math.
bool refuses_what_is_no_number() {
  lamp::Light light;
  light.position.y = std::bit_cast<float>(0x7fc00000U);
  return lamp::check_lights(std::span(&light, 1)).has_value();
}

/// How many lights reach a position: at least `low`, at most `high`; what lies on a boundary may count or not.
struct Bounds {
  std::uint32_t low = 0;
  std::uint32_t high = 0;
};

Bounds count_on_cpu(std::span<const lamp::shared::Light> lights, const glm::dvec3& position) {
  Bounds bounds;
  for (const lamp::shared::Light& light : lights) {
    const glm::dvec3 way = position - glm::dvec3(light.position);
    double inside = 1.0 - glm::length(way) / light.range;
    if (light.type == lamp::shared::LIGHT_SPOT)
      inside = std::min(inside, glm::dot(glm::normalize(way), glm::dvec3(light.direction)) - light.cos_outer);
    bounds.low += inside > 1e-5 ? 1 : 0;
    bounds.high += inside > -1e-5 ? 1 : 0;
  }
  return bounds;
}

Sums check_counts(const lamp::View& view, std::span<const float> depth, std::span<const lamp::shared::Light> lights,
                  std::span<const glm::uvec2> counts) {
  Sums sums;
  for (std::uint32_t i = 0; i < PIXELS; ++i) {
    const std::uint32_t x = i % SIZE.width;
    const std::uint32_t y = i / SIZE.width;
    const Bounds bounds =
        depth[i] == 0.0F ? Bounds{} : count_on_cpu(lights, view.world_position(x, y, double{depth[i]}));
    sums.reached += counts[i].x;
    sums.walked += counts[i].y;
    if (counts[i].x >= bounds.low && counts[i].x <= bounds.high) continue;
    if (sums.wrong++ == 0)
      std::printf("pixel (%u, %u): counted %u, expected %u to %u\n", x, y, counts[i].x, bounds.low, bounds.high);
  }
  return sums;
}

void make_counts_visible(VkCommandBuffer commands) {
  const VkMemoryBarrier2 barrier{.sType = VK_STRUCTURE_TYPE_MEMORY_BARRIER_2,
                                 .srcStageMask = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT,
                                 .srcAccessMask = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                                 .dstStageMask = VK_PIPELINE_STAGE_2_HOST_BIT,
                                 .dstAccessMask = VK_ACCESS_2_HOST_READ_BIT};
  const VkDependencyInfo dependency{
      .sType = VK_STRUCTURE_TYPE_DEPENDENCY_INFO, .memoryBarrierCount = 1, .pMemoryBarriers = &barrier};
  vkCmdPipelineBarrier2(commands, &dependency);
}

/// What frames of one culling came to.
struct Outcome {
  std::uint32_t wrong = 0;  ///< pixels
  bool overflowed = false;
  bool overflowed_again = false;  ///< after it had grown
};

Outcome run(Engine& engine, LightCulling& culling) {
  const lamp::View view = make_view();
  const DepthImage depth = engine.make_depth_image(SIZE);
  const MappedBuffer depth_values = engine.make_buffer(PIXELS * sizeof(float), VK_BUFFER_USAGE_TRANSFER_SRC_BIT);
  const MappedBuffer lights =
      engine.make_buffer(CAPACITY * sizeof(lamp::shared::Light), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  const MappedBuffer counts = engine.make_buffer(PIXELS * sizeof(glm::uvec2), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  draw_depth(depth_values.as<float>());

  Outcome outcome;
  bool grew = false;
  for (const std::uint32_t light_count : {0U, 33U, 512U, CAPACITY, CAPACITY}) {
    const auto packed = lamp::pack(make_lights(light_count, light_count));
    std::ranges::copy(packed, lights.as<lamp::shared::Light>().begin());
    engine.submit([&](VkCommandBuffer commands) {
      engine.record_depth(commands, depth, SIZE, depth_values.buffer);
      culling.record(commands, {view, lights.buffer, light_count, depth, counts.buffer});
      make_counts_visible(commands);
    });
    const Sums sums = check_counts(view, depth_values.as<float>(), packed, counts.as<glm::uvec2>());
    std::printf("  %4u lights: %6llu pairs of pixel and light reach, %7llu walked, %3u cells overflowed, %u wrong\n",
                light_count, static_cast<unsigned long long>(sums.reached),
                static_cast<unsigned long long>(sums.walked), culling.overflowed_cells(), sums.wrong);
    outcome.wrong += sums.wrong;
    outcome.overflowed = outcome.overflowed || culling.overflowed_cells() != 0;
    outcome.overflowed_again = grew && culling.overflowed_cells() != 0;
    grew = culling.finish();
  }
  return outcome;
}

/// What a plan for other limits than this device's would take: no device is needed to know.
void print_memory() {
  const lamp::Method* method = lamp::find_method("clustered").value();
  const lamp::Plan plan = lamp::make_plan(*method, {.width = 1920,
                                                    .height = 1080,
                                                    .light_capacity = 10000,
                                                    .options = lamp::resolve_options(*method, {}).value()})
                              .value();
  for (const lamp::BufferDesc& buffer : plan.buffers)
    std::printf("%-16s %10llu bytes\n", buffer.name.c_str(), static_cast<unsigned long long>(plan.bytes_of(buffer)));
}

struct Case {
  LightCullingInfo info;
  bool overflows = false;  ///< at first
};

bool passes(Engine& engine, const Case& c) {
  LightCulling culling(engine, c.info);
  std::printf("%s, %llu bytes\n", c.info.method.c_str(), static_cast<unsigned long long>(culling.bytes()));
  const Outcome outcome = run(engine, culling);
  std::printf("  %llu bytes in the end\n", static_cast<unsigned long long>(culling.bytes()));
  return outcome.wrong == 0 && outcome.overflowed == c.overflows && !outcome.overflowed_again;
}

}  // namespace

int main() {
  try {
    print_memory();
    Engine engine;
    std::printf("%s\n", engine.device_name().c_str());
    const LightCullingInfo clustered{
        .method = "clustered", .lookup = "cluster_lists", .spirv = CLUSTERED, .size = SIZE, .light_capacity = CAPACITY};
    LightCullingInfo small = clustered;
    small.options = {"mean_capacity=1"};
    LightCullingInfo tiled = clustered;
    tiled.method = "tiled-bits";
    tiled.lookup = "tile_bits";
    tiled.spirv = TILED_BITS;
    tiled.first_binding = 3;
    tiled.first_constant = 0;
    LightCullingInfo hlsl = small;
    hlsl.spirv = CLUSTERED_HLSL;
    hlsl.set = 1;
    hlsl.first_binding = 3;
    hlsl.first_constant = 0;
    bool good = refuses_what_is_no_number();
    if (!good) std::printf("a light without a place passed its check\n");
    for (const Case& c :
         {Case{clustered}, Case{small, /* overflows= */ true}, Case{tiled}, Case{hlsl, /* overflows= */ true}})
      good = passes(engine, c) && good;
    for (const std::string& message : engine.messages()) std::printf("%s\n", message.c_str());
    return good && engine.messages().empty() ? 0 : 1;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "small_engine: %s\n", error.what());
    return 1;
  }
}
