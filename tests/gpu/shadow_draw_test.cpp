// Shadow maps as they are drawn, against rays through their texels: every kind of square, every batch, nothing outside.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>

#include "gpu/dispatch.h"
#include "gpu/hall.h"
#include "gpu/test_scenes.h"
#include "lamplight/light.h"
#include "render/scene_occluders.h"
#include "render/shadows.h"
#include "scene/flight.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t ATLAS = 512;

std::vector<float> read_atlas(const Shadows& shadows, vulkan::AccessTracker& tracker) {
  const std::uint32_t side = shadows.settings().atlas_size;
  const vulkan::Buffer buffer = host_buffer("atlas read-back", std::uint64_t{side} * side * sizeof(float));
  test_context().submit([&](VkCommandBuffer commands) {
    vulkan::Recorder recorder(test_context().device(), commands, tracker);
    record_copy(recorder, shadows.atlas(), buffer);
    recorder.barrier({host_reads(vulkan::Resource::storage(buffer.handle()))});
  });
  return contents<float>(buffer);
}

void draw(Shadows& shadows, vulkan::AccessTracker& tracker) {
  test_context().submit([&](VkCommandBuffer commands) {
    vulkan::Recorder recorder(test_context().device(), commands, tracker);
    shadows.record(recorder);
  });
}

/// The direction whose place in a square is `texel` (from the square's corner): the view that shows it says so.
std::optional<glm::dvec3> direction_at(const shared::ShadowMap& map, std::uint32_t square, const glm::dvec2& texel,
                                       std::uint32_t atlas) {
  std::vector<shared::ShadowView> views;
  add_shadow_views(map, atlas, 0, views);
  const glm::uvec2 corner(map.squares[square] & 0xffffU, map.squares[square] >> 16U);
  const glm::dvec2 ndc = (glm::dvec2(corner) * 16.0 + texel) * 2.0 / double(atlas) - 1.0;
  for (const shared::ShadowView& view : views) {
    if (map.kind == shared::SHADOW_FACES && view.view != square) continue;
    const glm::dvec3 w(view.row_w);
    // (row_x - ndc.x row_w) and (row_y - ndc.y row_w) are at right angles to it.
    glm::dvec3 way = glm::cross(glm::dvec3(view.row_x) - ndc.x * w, glm::dvec3(view.row_y) - ndc.y * w);
    way *= glm::dot(way, w) < 0.0 ? -1.0 : 1.0;
    way /= glm::dot(way, w);  // at depth 1
    const bool inside = std::ranges::all_of(
        view.planes, [&](const glm::vec3& plane) { return glm::dot(glm::dvec3(plane), way) >= 0.0; });
    if (inside) return way;
  }
  return std::nullopt;
}

/// near / w of what rays around a texel's centre meet, between 0 and what is at the light's range: nothing beyond that
/// need be drawn.
struct Spread {
  double least = 1e30;
  double most = 0.0;
  double at_range = 0.0;

  [[nodiscard]] bool has(double stored) const {
    return stored <= most * 1.001 && (stored >= least * 0.999 || least <= at_range);
  }
};

constexpr double SNAP = 0.02;  // texels; corners are snapped to 1/256

Spread stored_by_rays(const Occluders& occluders, const shared::ShadowMap& map, std::uint32_t square,
                      const glm::uvec2& texel, std::uint32_t atlas) {
  constexpr double LONG_M = 1000.0;
  Spread spread;
  for (int i = 0; i < 9; ++i) {
    const glm::dvec2 at = glm::dvec2(texel) + 0.5 + SNAP * glm::dvec2(i % 3 - 1, i / 3 - 1);
    const auto way = direction_at(map, square, at, atlas);
    if (!way) continue;
    const glm::dvec3 from(map.position);
    const auto hit = occluders.first_hit({.from = from, .to = from + *way * LONG_M, .first = 1e-9});
    const double stored = hit ? std::min(1.0, double{map.near_m} / (hit->at * LONG_M)) : 0.0;
    spread.least = std::min(spread.least, stored);
    spread.most = std::max(spread.most, stored);
    spread.at_range = std::max(spread.at_range, double{map.near_m} / double{map.range_m} * glm::length(*way));
  }
  return spread;
}

/// Calls `visit(map, square, texel, stored)` for some texels of every square.
template <class Visit>
void for_some_texels(const Shadows& shadows, const std::vector<float>& texels, Visit visit) {
  const std::uint32_t atlas = shadows.settings().atlas_size;
  for (const shared::ShadowMap& map : shadows.maps())
    for (std::uint32_t i = 0; map.kind != shared::SHADOW_NONE && i < (map.kind == shared::SHADOW_FACES ? 6U : 1U);
         ++i) {
      const glm::uvec2 corner = glm::uvec2(map.squares[i] & 0xffffU, map.squares[i] >> 16U) * 16U;
      for (std::uint32_t y = 1; y < map.side; y += 7)
        for (std::uint32_t x = y % 5; x < map.side; x += 5)
          visit(map, i, glm::uvec2(x, y), double{texels[(corner.y + y) * atlas + corner.x + x]});
    }
}

/// The atrium with every leaf a full card.
const TestScene& atrium_without_holes() {
  static std::unique_ptr<TestScene> made;
  if (made == nullptr) {
    at_context_end([] { made.reset(); });
    Scene scene = builtin_test_scene("atrium").scene;
    for (Material& material : scene.materials)
      if (material.alpha_mode == AlphaMode::mask) material.alpha_mode = AlphaMode::opaque;
    made = std::make_unique<TestScene>(std::move(scene));
  }
  return *made;
}

std::vector<Light> lights_of_all_kinds() {
  return {{.position = {6.0F, 1.5F, 0.0F}, .range = 9.0F},
          {.position = {-3.0F, 4.0F, 2.0F}, .range = 12.0F},
          {.type = LightType::spot, .position = {0.0F, 6.0F, 0.0F}, .range = 10.0F, .direction = {0.3F, -1.0F, 0.2F}},
          {.type = LightType::spot,
           .position = {2.0F, 3.0F, 1.0F},
           .range = 10.0F,
           .direction = {0.0F, -1.0F, 0.1F},
           .outer_angle = 1.5F}};
}

class ShadowDraw : public GpuTest, public ::testing::WithParamInterface<std::tuple<PointShadows, ShadowRaster>> {
 protected:
  void SetUp() override {
    GpuTest::SetUp();
    VkPhysicalDeviceFeatures has{};
    vkGetPhysicalDeviceFeatures(test_context().device().physical, &has);
    if (std::get<1>(GetParam()) == ShadowRaster::hardware && has.multiViewport == VK_FALSE)
      GTEST_SKIP() << "the device has no more than one viewport";
  }
  static ShadowSettings settings() {
    const auto [points, raster] = GetParam();
    return {.points = points, .raster = raster, .atlas_size = ATLAS};
  }
};

TEST_P(ShadowDraw, ShowsWhatRaysMeet) {
  const TestScene& scene = atrium_without_holes();
  const Occluders occluders = scene_occluders(scene.scene);
  const View view = view_of(scene.scene.cameras.front(), 160, 90, "camera");
  const std::vector<shared::Light> lights = pack(lights_of_all_kinds());
  Shadows shadows(test_context(), shader_library(), scene.gpu, settings(), static_cast<std::uint32_t>(lights.size()));
  vulkan::AccessTracker tracker;
  shadows.schedule({&view, 1}, lights);
  EXPECT_GE(shadows.counts().redrawn, 3U);
  draw(shadows, tracker);
  const std::vector<float> texels = read_atlas(shadows, tracker);
  std::uint32_t checked = 0;
  for_some_texels(shadows, texels, [&](const auto& map, std::uint32_t square, const glm::uvec2& texel, double stored) {
    const Spread expected = stored_by_rays(occluders, map, square, texel, ATLAS);
    if (expected.most <= expected.at_range) return;
    ++checked;
    EXPECT_TRUE(expected.has(stored)) << "kind " << map.kind << ", square " << square << ", texel " << texel.x << ", "
                                      << texel.y << ": w = " << map.near_m / stored << ", expected "
                                      << map.near_m / expected.most << " .. " << map.near_m / expected.least;
  });
  EXPECT_GT(checked, 1000U);

  // Drawn again in the same squares after a move, with nothing of before left, and then not at all.
  std::vector<shared::Light> moved = lights;
  moved[0].position.x += 1.0F;
  shadows.schedule({&view, 1}, moved);
  draw(shadows, tracker);
  shadows.schedule({&view, 1}, lights);
  draw(shadows, tracker);
  EXPECT_EQ(shadows.counts().redrawn, 1U);
  EXPECT_EQ(read_atlas(shadows, tracker), texels);
  shadows.schedule({&view, 1}, lights);
  EXPECT_EQ(shadows.counts().redrawn, 0U);
}

TEST_P(ShadowDraw, LeavesHaveHoles) {
  const TestScene& scene = builtin_test_scene("atrium");
  const Occluders leaves = scene_occluders(scene.scene);
  const Occluders cards = scene_occluders(atrium_without_holes().scene);
  const View view = view_of(scene.scene.cameras.front(), 160, 90, "camera");
  const std::vector<shared::Light> lights = pack(lights_of_all_kinds());
  Shadows shadows(test_context(), shader_library(), scene.gpu, settings(), static_cast<std::uint32_t>(lights.size()));
  vulkan::AccessTracker tracker;
  shadows.schedule({&view, 1}, lights);
  draw(shadows, tracker);
  std::uint32_t through = 0;
  std::uint32_t holes = 0;
  for_some_texels(shadows, read_atlas(shadows, tracker),
                  [&](const auto& map, std::uint32_t square, const glm::uvec2& texel, double stored) {
                    const Spread by_leaf = stored_by_rays(leaves, map, square, texel, ATLAS);
                    const Spread by_card = stored_by_rays(cards, map, square, texel, ATLAS);
                    if (by_card.most <= by_card.at_range || by_card.most <= by_leaf.most * 1.01) return;
                    ++through;
                    holes += by_card.has(stored) ? 0 : 1;
                  });
  EXPECT_GT(through, 30U);
  // A texel sees a leaf's image at a coarser level than a ray, and some edges fall the other way.
  EXPECT_GT(holes, through * 7 / 10) << holes << " of " << through;
}

std::string name_of(const ::testing::TestParamInfo<std::tuple<PointShadows, ShadowRaster>>& test) {
  return std::string(std::get<0>(test.param) == PointShadows::faces ? "faces" : "octahedron") +
         (std::get<1>(test.param) == ShadowRaster::hardware ? "" : "InCompute");
}

INSTANTIATE_TEST_SUITE_P(Of, ShadowDraw,
                         ::testing::Combine(::testing::Values(PointShadows::faces, PointShadows::octahedron),
                                            ::testing::Values(ShadowRaster::hardware, ShadowRaster::compute)),
                         name_of);

// Blocks of large triangles that find no room are drawn by the thread that found them.
TEST_F(GpuTest, ShadowRasterizerWithoutRoomDrawsTheSame) {
  const TestScene& scene = builtin_test_scene("atrium");
  const View view = view_of(scene.scene.cameras.front(), 160, 90, "camera");
  const std::vector<shared::Light> lights = pack(lights_of_all_kinds());
  const auto atlas_with = [&](std::uint32_t items) {
    Shadows shadows(test_context(), shader_library(), scene.gpu,
                    {.raster = ShadowRaster::compute, .raster_items = items, .atlas_size = ATLAS},
                    static_cast<std::uint32_t>(lights.size()));
    vulkan::AccessTracker tracker;
    shadows.schedule({&view, 1}, lights);
    draw(shadows, tracker);
    return read_atlas(shadows, tracker);
  };
  const std::vector<float> with_room = atlas_with(1U << 20);
  EXPECT_GT(std::ranges::count_if(with_room, [](float depth) { return depth > 0.0F; }), 10000);
  EXPECT_EQ(atlas_with(100), with_room);
}

/// How a lath is cut into triangles: from corner to corner, or from the middle of one long edge, beside which angles
/// are almost straight.
enum class LathCut : std::uint8_t { corners, middles };

/// A sheet of laths below the light, in no axis's direction.
Scene lath_sheet(LathCut cut) {
  constexpr float LENGTH_M = 1000.0F;
  constexpr float WIDTH_M = 0.001F;
  constexpr std::uint32_t LATHS = 600;
  Scene scene = hall(0.01F);
  const glm::vec3 along = glm::normalize(glm::vec3(0.6F, 0.05F, -0.8F));
  const glm::vec3 across = glm::normalize(glm::cross(along, glm::vec3(0.1F, 1.0F, 0.0F)));
  Mesh sheet{.first_index = static_cast<std::uint32_t>(scene.indices.size()),
             .vertex_offset = static_cast<std::uint32_t>(scene.vertices.size()),
             .material = 1};
  for (std::uint32_t edge = 0; edge <= LATHS; ++edge)
    for (const float at : {-0.4F, 0.1F, 0.6F}) {
      const glm::vec3 middle = glm::vec3(0.0F, 0.8F, 0.0F) + WIDTH_M * (static_cast<float>(edge) - 300.0F) * across;
      scene.vertices.push_back({.position = middle + LENGTH_M * at * along, .normal = glm::cross(along, across)});
    }
  for (std::uint32_t lath = 0; lath < LATHS; ++lath) {
    const std::uint32_t cut_edge =
        3 * (lath + lath % 2);  // even edges have a corner in their middle, odd ones have none
    const std::uint32_t whole_edge = 3 * (lath + 1 - lath % 2);
    if (cut == LathCut::corners)
      scene.indices.insert(scene.indices.end(),
                           {cut_edge, cut_edge + 2, whole_edge, cut_edge + 2, whole_edge + 2, whole_edge});
    else
      scene.indices.insert(scene.indices.end(), {whole_edge, whole_edge + 2, cut_edge + 1, cut_edge, cut_edge + 1,
                                                 whole_edge, cut_edge + 1, cut_edge + 2, whole_edge + 2});
  }
  sheet.index_count = static_cast<std::uint32_t>(scene.indices.size()) - sheet.first_index;
  scene.meshes.push_back(sheet);
  scene.instances.push_back({.mesh = static_cast<std::uint32_t>(scene.meshes.size()) - 1});
  return scene;
}

/// How many texels of a light's map are not at the depth that rays meet.
std::uint32_t wrong_texels(const TestScene& scene, const Light& light, PointShadows points) {
  const Occluders occluders = scene_occluders(scene.scene);
  const View view = view_of(scene.scene.cameras.front(), 160, 90, "camera");
  Shadows shadows(test_context(), shader_library(), scene.gpu,
                  {.points = points, .raster = ShadowRaster::compute, .atlas_size = 2 * ATLAS}, 1);
  vulkan::AccessTracker tracker;
  shadows.schedule({&view, 1}, pack(std::vector{light}));
  draw(shadows, tracker);
  std::uint32_t checked = 0;
  std::uint32_t wrong = 0;
  for_some_texels(shadows, read_atlas(shadows, tracker),
                  [&](const auto& map, std::uint32_t square, const glm::uvec2& texel, double stored) {
                    const Spread expected = stored_by_rays(occluders, map, square, texel, 2 * ATLAS);
                    if (expected.least <= expected.at_range) return;
                    ++checked;
                    wrong += expected.has(stored) ? 0 : 1;
                  });
  EXPECT_GT(checked, 500U);
  return wrong;
}

// What rounding makes of a depth does not grow with a triangle's length over its width.
TEST_F(GpuTest, ShadowRasterizerDrawsLongThinTriangles) {
  for (const LathCut cut : {LathCut::corners, LathCut::middles}) {
    SCOPED_TRACE(cut == LathCut::corners ? "corners" : "middles");
    const TestScene scene(lath_sheet(cut));
    const Light light{.position = {0.05F, 1.6F, 0.1F}, .range = 2000.0F};
    for (const PointShadows points : {PointShadows::faces, PointShadows::octahedron})
      EXPECT_EQ(wrong_texels(scene, light, points), 0U);
  }
}

std::vector<std::string> drawn_passes(Shadows& shadows, vulkan::AccessTracker& tracker) {
  vulkan::Timestamps timestamps = take(vulkan::Timestamps::create(test_context().device(), 8));
  test_context().submit([&](VkCommandBuffer commands) {
    timestamps.reset(commands);
    vulkan::Recorder recorder(test_context().device(), commands, tracker, &timestamps);
    shadows.record_reach(recorder);
    timestamps.finish(commands);
  });
  std::vector<std::string> passes;
  for (const vulkan::Timestamps::Time& time : timestamps.read()) passes.emplace_back(time.pass);
  return passes;
}

// Frames that keep a GPU awake between timed ones draw what a timed one is to draw.
TEST_F(GpuTest, ShadowsThatArePendingOnceMoreAreDrawnOnceMore) {
  const TestScene& scene = builtin_test_scene("plane");
  const View view = view_of(scene.scene.cameras.front(), 32, 18, "camera");
  const std::vector<shared::Light> lights = pack(lights_of_all_kinds());
  Shadows shadows(test_context(), shader_library(), scene.gpu, {.atlas_size = ATLAS},
                  static_cast<std::uint32_t>(lights.size()));
  shadows.need(ShadowReach::Kind::radial);
  vulkan::AccessTracker tracker;
  shadows.schedule({&view, 1}, lights);
  const Shadows::Pending pending = shadows.pending();
  const std::vector<std::string> all = drawn_passes(shadows, tracker);
  EXPECT_EQ(all, (std::vector<std::string>{"shadow maps", "radial bounds"}));
  const std::vector<float> texels = read_atlas(shadows, tracker);
  EXPECT_TRUE(drawn_passes(shadows, tracker).empty());
  shadows.set_pending(pending);
  EXPECT_EQ(drawn_passes(shadows, tracker), all);
  EXPECT_EQ(read_atlas(shadows, tracker), texels);
}

TEST_F(GpuTest, ShadowAtlasBeyondTheDeviceIsAnError) {
  const TestScene& scene = builtin_test_scene("plane");
  const std::uint32_t limit = test_context().device().traits.max_image_size;
  if (limit >= 32768) GTEST_SKIP() << "the device has images of every size";
  EXPECT_THROW(Shadows(test_context(), shader_library(), scene.gpu, {.atlas_size = 2 * limit}, 4), Error);
}

}  // namespace
}  // namespace lamp::app
