// Small pictures against those kept in tests/golden, with the tolerances of golden.json.
// LAMPLIGHT_UPDATE_GOLDEN=1 writes them anew: look at each before it is committed.
// SPDX-License-Identifier: Apache-2.0
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "gpu/gpu_test.h"
#include "gpu/method_check.h"
#include "gpu/test_scenes.h"
#include "render/heatmap.h"
#include "scene/flight.h"
#include "scene/place_lights.h"

namespace lamp::app {
namespace {

const std::filesystem::path FOLDER = std::filesystem::path(LAMPLIGHT_SOURCE_DIR) / "tests/golden";

nlohmann::json golden_rows() {
  std::ifstream stream(FOLDER / "golden.json");
  return nlohmann::json::parse(stream);
}

LdrImage draw(const nlohmann::json& row) {
  const TestScene& scene = builtin_test_scene(row.at("scene").get<std::string>());
  const auto width = row.at("width").get<std::uint32_t>();
  const auto height = row.at("height").get<std::uint32_t>();
  const std::vector<Light> placed = place_lights(scene.scene, {.count = row.at("lights").get<std::uint32_t>()});
  std::vector<shared::Light> lights = pack(scene.scene.lights);
  const std::vector<shared::Light> more = pack(placed);
  lights.insert(lights.end(), more.begin(), more.end());
  const auto capacity = static_cast<std::uint32_t>(lights.size());
  Renderer renderer(test_context(), shader_library(), scene.gpu, width, height, capacity);
  renderer.set_frame(view_of(find_camera(scene.scene, ""), width, height, "camera"), lights);
  const Method& method = *take(find_method(row.at("method").get<std::string>()));
  Lighting lighting = make_lighting(renderer, {.method = &method, .light_capacity = capacity});
  const HdrImage image = renderer.render(lighting).image;
  if (!row.at("heatmap").get<bool>()) return tone_map(image, row.at("exposure").get<float>());
  std::vector<std::uint32_t> counts;
  for (const gpu::Visit& visit : renderer.visit(lighting, empty_truth(width, height)))
    counts.push_back(visit.cell == NO_CELL ? NO_CELL : visit.visited);
  return draw_heatmap({.width = width, .height = height, .counts = counts, .scale_max = 64});
}

struct Distance {
  double mean = 0.0;  ///< of channels, 0 .. 255
  double far = 0.0;   ///< share of pixels with a channel more than 24 away
};

Distance distance(const LdrImage& a, const LdrImage& b) {
  Distance d;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) {
    int most = 0;
    for (int c = 0; c < 3; ++c) {
      const int difference = std::abs(int{a.pixels[i][c]} - int{b.pixels[i][c]});
      d.mean += difference;
      most = std::max(most, difference);
    }
    if (most > 24) d.far += 1.0;
  }
  const auto pixels = static_cast<double>(a.pixels.size());
  return {d.mean / (3.0 * pixels), d.far / pixels};
}

class Golden : public GpuTest {};

TEST_F(Golden, PicturesAreAsKept) {
  const bool update = std::getenv("LAMPLIGHT_UPDATE_GOLDEN") != nullptr;
  for (const nlohmann::json& row : golden_rows()) {
    const auto name = row.at("name").get<std::string>();
    SCOPED_TRACE(name);
    const LdrImage image = draw(row);
    const std::filesystem::path file = FOLDER / (name + ".png");
    if (update) write_png(file, image);
    const LdrImage kept = read_png(file);
    ASSERT_EQ(kept.width, image.width);
    ASSERT_EQ(kept.height, image.height);
    const Distance d = distance(image, kept);
    EXPECT_LE(d.mean, row.at("mean").get<double>());
    EXPECT_LE(d.far, row.at("far").get<double>());
  }
}

TEST_F(Golden, AMissingLightIsNoticed) {
  nlohmann::json row = golden_rows().at(0);
  const LdrImage kept = read_png(FOLDER / (row.at("name").get<std::string>() + ".png"));
  row["lights"] = row.at("lights").get<std::uint32_t>() - 8;  // the automatic range changes with the count, too
  EXPECT_GT(distance(draw(row), kept).mean, row.at("mean").get<double>());
}

}  // namespace
}  // namespace lamp::app
