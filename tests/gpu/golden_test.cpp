// Small pictures against stored ones, so that a change of scenes, lights, shading or tone mapping does not pass unseen.
// What each picture shows and how far it may be off stands in tests/golden/golden.json: tolerances let another device's
// texture filtering and rasterisation pass, but not a light that is missing or moved (checked below).
// To accept a change: LAMPLIGHT_UPDATE_GOLDEN=1 test_gpu --gtest_filter='*Golden*', then look at the new pictures.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "gpu/method_check.h"
#include "gpu/test_scenes.h"
#include "render/heatmap.h"
#include "scene/flight.h"
#include "scene/place_lights.h"

namespace lamp::app {
namespace {

namespace fs = std::filesystem;

/// Devices filter textures and cover edges differently (a GPU's anisotropic filter is sharper than what a software
/// device does); that averages out over a block. A light does not.
constexpr std::uint32_t BLOCK_PX = 20;

fs::path golden_folder() { return fs::path(LAMPLIGHT_SOURCE_DIR) / "tests/golden"; }

/// A row of golden.json.
struct Golden {
  std::string name;
  std::string scene;
  std::uint32_t width = 0, height = 0;
  std::uint32_t lights = 0;
  std::uint64_t seed = 1;
  std::string method;
  std::string path;
  float exposure = 1.0F;      ///< 0: a heat map instead of a picture
  double mean_levels = 0.0;   ///< largest mean difference of a channel, of 255
  double block_levels = 0.0;  ///< largest difference of blocks' mean channels, root mean square over the picture
};

std::vector<Golden> golden_rows() {
  const nlohmann::json rows = nlohmann::json::parse(std::ifstream(golden_folder() / "golden.json"));
  std::vector<Golden> parsed;
  for (const nlohmann::json& row : rows)
    parsed.push_back({.name = row.at("name"),
                      .scene = row.at("scene"),
                      .width = row.at("width"),
                      .height = row.at("height"),
                      .lights = row.at("lights"),
                      .seed = row.at("seed"),
                      .method = row.at("method"),
                      .path = row.at("path"),
                      .exposure = row.at("exposure"),
                      .mean_levels = row.at("mean_levels"),
                      .block_levels = row.at("block_levels")});
  return parsed;
}

void PrintTo(const Golden& golden, std::ostream* out) { *out << golden.name; }

std::vector<Light> lights_of(const Golden& golden) {
  const TestScene& scene = builtin_test_scene(golden.scene);
  std::vector<Light> lights = scene.scene.lights;
  const std::vector<Light> placed = place_lights(scene.air, {.count = golden.lights, .seed = golden.seed});
  lights.insert(lights.end(), placed.begin(), placed.end());
  return lights;
}

/// A picture, and how many of its pixels each light reaches.
struct Drawn {
  LdrImage image;
  std::vector<std::uint32_t> pixels_reached;
};

Drawn draw(const Golden& golden, const std::vector<Light>& lights) {
  const TestScene& scene = builtin_test_scene(golden.scene);
  const View view = view_of(find_camera(scene.scene, ""), golden.width, golden.height, "camera");
  const auto count = static_cast<std::uint32_t>(lights.size());
  const std::vector<shared::Light> packed = pack(lights);
  const Method& method = *take(find_method(golden.method));
  Renderer renderer(test_context(), shader_library(), scene.gpu, golden.width, golden.height, count);
  Lighting lighting(
      renderer.device(), shader_library(),
      {.method = &method,
       .options = take(resolve_options(method, {})),
       .width = golden.width,
       .height = golden.height,
       .light_capacity = count,
       .path = static_cast<ShadingPath>(std::ranges::find(path_names(), golden.path) - path_names().begin()),
       .transparency = !scene.gpu.blended().empty()});
  renderer.set_frame(view, packed);
  const HdrImage hdr = renderer.render(lighting).image;
  const std::vector<float> depth = renderer.read_depth();
  Drawn drawn{.pixels_reached = std::vector<std::uint32_t>(count)};
  for (const std::uint32_t light :
       truth({.view = view, .depth = depth, .lights = packed, .rows = golden.height}).lights)
    ++drawn.pixels_reached[light];
  if (golden.exposure > 0.0F) {
    drawn.image = tone_map(hdr, golden.exposure);
    return drawn;
  }
  std::vector<std::uint32_t> counts;
  for (const Visit& visit : renderer.visit(lighting, empty_truth(golden.width, golden.height)))
    counts.push_back(visit.cell == SKY_CELL ? SKY_CELL : visit.visited);
  drawn.image = draw_heatmap({.width = golden.width, .height = golden.height, .counts = counts, .scale_max = 64});
  return drawn;
}

struct Difference {
  double mean_levels = 0.0;
  double block_levels = 0.0;
};

/// The mean of a block of pixels, by channel.
glm::dvec3 block_mean(const LdrImage& image, glm::uvec2 block) {
  glm::dvec3 sum(0.0);
  for (std::uint32_t y = 0; y < BLOCK_PX; ++y)
    for (std::uint32_t x = 0; x < BLOCK_PX; ++x)
      sum += glm::dvec3(image.pixels[(block.y * BLOCK_PX + y) * image.width + block.x * BLOCK_PX + x]);
  return sum / static_cast<double>(BLOCK_PX * BLOCK_PX);
}

Difference compare(const LdrImage& a, const LdrImage& b) {
  Difference difference;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    const glm::ivec3 levels = glm::abs(glm::ivec3(a.pixels[i]) - glm::ivec3(b.pixels[i]));
    difference.mean_levels += (levels.r + levels.g + levels.b) / 3.0 / static_cast<double>(a.pixels.size());
  }
  const glm::uvec2 blocks(a.width / BLOCK_PX, a.height / BLOCK_PX);
  double sum = 0.0;
  for (std::uint32_t y = 0; y < blocks.y; ++y) {
    for (std::uint32_t x = 0; x < blocks.x; ++x) {
      const glm::dvec3 levels = block_mean(a, {x, y}) - block_mean(b, {x, y});
      sum += glm::dot(levels, levels) / 3.0;
    }
  }
  difference.block_levels = std::sqrt(sum / (blocks.x * blocks.y));
  return difference;
}

bool passes(const Golden& golden, const Difference& difference) {
  return difference.mean_levels <= golden.mean_levels && difference.block_levels <= golden.block_levels;
}

class GoldenPicture : public GpuTest, public ::testing::WithParamInterface<Golden> {};

TEST_P(GoldenPicture, IsAsBefore) {
  const Golden& golden = GetParam();
  const fs::path file = golden_folder() / (golden.name + ".png");
  const LdrImage drawn = draw(golden, lights_of(golden)).image;
  if (std::getenv("LAMPLIGHT_UPDATE_GOLDEN") != nullptr) {
    write_png(file, drawn);
    GTEST_SKIP() << "wrote " << file << "; look at it";
  }
  const LdrImage stored = read_png(file);
  ASSERT_EQ(stored.width, drawn.width);
  ASSERT_EQ(stored.height, drawn.height);
  const Difference difference = compare(drawn, stored);
  if (passes(golden, difference)) return;
  const fs::path seen = fs::path(testing::TempDir()) / (golden.name + "-drawn.png");
  write_png(seen, drawn);
  ADD_FAILURE() << fmt::format(
      "{}: channels differ by {:.3f} levels on average (at most {}), those of a block by {:.2f} (at most {}); drawn: "
      "{}",
      golden.name, difference.mean_levels, golden.mean_levels, difference.block_levels, golden.block_levels,
      seen.string());
}

/// The lights that reach most pixels but not nearly all, most first.
std::vector<std::size_t> prominent_lights(const Golden& golden, const std::vector<std::uint32_t>& pixels_reached) {
  const std::uint32_t many = golden.width * golden.height / 2;
  std::vector<std::size_t> order;
  for (std::size_t i = 0; i < pixels_reached.size(); ++i)
    if (pixels_reached[i] < many) order.push_back(i);
  std::ranges::sort(order, {}, [&](std::size_t i) { return std::pair(~pixels_reached[i], i); });
  order.resize(std::min<std::size_t>(order.size(), 3));
  return order;
}

TEST_P(GoldenPicture, ShowsALightThatIsMissingOrMoved) {
  const Golden& golden = GetParam();
  const std::vector<Light> lights = lights_of(golden);
  const Drawn drawn = draw(golden, lights);
  const auto is_seen = [&](const std::vector<Light>& changed) {
    return !passes(golden, compare(draw(golden, changed).image, drawn.image));
  };
  int missing = 0;
  int moved = 0;
  for (const std::size_t light : prominent_lights(golden, drawn.pixels_reached)) {
    std::vector<Light> changed = lights;
    glm::vec3 position = changed[light].position;
    position += 0.5F * changed[light].range * glm::vec3(0.6F, 0.0F, 0.8F);
    changed[light].position = position;
    moved += is_seen(changed) ? 1 : 0;
    changed.erase(changed.begin() + static_cast<std::ptrdiff_t>(light));
    missing += is_seen(changed) ? 1 : 0;
  }
  // Of the three lights that reach most pixels; others may outshine two of them.
  EXPECT_GE(missing, 1);
  EXPECT_GE(moved, 1);
}

INSTANTIATE_TEST_SUITE_P(All, GoldenPicture, ::testing::ValuesIn(golden_rows()),
                         [](const auto& test) { return test_name(test.param.name); });

}  // namespace
}  // namespace lamp::app
