// Probes, mirrors and things that move: what the window saves is what `lamp render` makes; weights against double
// precision; lists in the world against those of pixels.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "gpu/check.h"
#include "system/run_program.h"
#include "temporary_folder.h"
#include "view/stage.h"
#include "view/view_test.h"
#include "view/world_leaves.h"

namespace lamp::app {
namespace {

/// Plays a script, saves the state and the picture, and has `lamp` render the state.
void expect_saved_as_rendered(const std::string& script) {
  const TemporaryFolder folder;
  const std::string state = (folder.path() / "state.json").string();
  const std::string saved = (folder.path() / "saved.exr").string();
  const std::string all = script + R"({"save_state": ")" + state + "\"}\n" + R"({"save_picture": ")" + saved + "\"}";
  run_headless(view_context(), small_viewer(), [&](Player& player) { play(player, parse_script(all, "script")); });
  const std::string rendered = (folder.path() / "rendered.exr").string();
  const ProgramResult run = run_program({LAMP_EXECUTABLE, "render", "--state", state, "-o", rendered});
  ASSERT_TRUE(run.succeeded) << run.err;
  EXPECT_FALSE(bytes_of_file(saved).empty());
  EXPECT_TRUE(bytes_of_file(saved) == bytes_of_file(rendered));
}

class Reflections : public ::testing::TestWithParam<const char*> {};

TEST_P(Reflections, AreSavedAsLampRendersThem) {
  expect_saved_as_rendered(std::string(R"({"set": {"scene": "atrium", "paused": false}})") + "\n" + R"({"set": )" +
                           GetParam() + "}\n" + R"({"wait": 4}
{"set": {"paused": true}}
)");
}

/// Sizes and places of shadow maps follow from what was shown before; those of a saved picture do not.
TEST(ShadowMaps, AreSavedAsLampRendersThem) {
  expect_saved_as_rendered(R"({"set": {"scene": "atrium", "lights": 64, "shadows": "pcf", "atlas": 512}}
{"set": {"camera": "close"}}
{"wait": 3}
{"set": {"camera": ""}}
{"wait": 3}
)");
}

INSTANTIATE_TEST_SUITE_P(
    Of, Reflections,
    ::testing::Values(
        R"({"mirror": 0.6})", R"({"moving": true, "mirror": 0.6})", R"({"lights": 8, "probes": 3, "probe_budget": 1})",
        R"({"lights": 8, "probes": 4, "probes_show": "flat", "decals": 8})",
        R"({"lights": 8, "probes": 1, "mirror": 0.6})",
        R"({"lights": 4, "probes": 1, "moving": true, "shadows": "pcf", "atlas": 512, "shadow_budget": "65536"})",
        R"({"still": 0.5, "moving": true})",
        R"({"lights": 32, "still": 0.5, "still_lists": "world-tree", "decals": 8, "shadows": "pcf", "atlas": 512})",
        R"({"lights": 16, "still": 0.5, "still_lists": "triangle-lists", "still_occlusion": 2, "path": "forward"})"));

/// As tests/gpu/probes_test.cpp has it.
double weight_of(const gpu::ProbeData& p, const glm::dvec3& position) {
  const glm::dvec3 half(glm::vec3(Vec3(p.volume.half_extents)));
  const glm::dvec3 from = position - glm::dvec3(glm::vec3(Vec3(p.volume.center)));
  const auto along = [&](const Vec3& axis) { return glm::dot(glm::dvec3(glm::vec3(axis)), from); };
  const glm::dvec3 local(along(p.volume.axis_x), along(p.volume.axis_y), along(p.volume.axis_z));
  const glm::dvec3 rest = half - glm::abs(local);
  double inside = std::min({rest.x, rest.y, rest.z});
  if (p.ellipsoid != 0) inside = (1.0 - glm::length(local / half)) * std::min({half.x, half.y, half.z});
  if (inside <= 0.0) return 0.0;
  return p.blend > 0.0F ? std::min(inside / p.blend, 1.0) : 1.0;
}

/// Every probe that weighs at a pixel is there, with the weight that double precision finds.
TEST(ProbesOfAPixel, WeighWhatTheReferenceSays) {
  const ShaderLibrary shaders("");
  Stage stage(view_context(), shaders, "");
  ViewState state = small_viewer().state;
  Request& r = state.request;
  r.scene = "corridor";
  r.method = "clustered";
  r.probes = 300;
  r.probes_show = "flat";
  const std::vector<gpu::ProbeData> probes = pack(requested_probes(r, load_scene(r.scene)));
  std::size_t weighing = 0;
  for (const glm::uvec2 pixel : {glm::uvec2(48, 40), glm::uvec2(10, 30), glm::uvec2(80, 50), glm::uvec2(48, 20)}) {
    state.picked = pixel;
    const Shown shown = stage.draw(state, {96, 54});
    ASSERT_TRUE(shown.inspection);
    ASSERT_EQ(shown.probe_volumes.size(), probes.size());
    double left = 1.0;
    for (std::uint32_t i = 0; i < probes.size(); ++i) {
      const double weight = weight_of(probes[i], glm::dvec3(shown.inspection->position));
      const auto found = std::ranges::find(shown.inspection->probes, i, &ListedProbe::probe);
      if (found == shown.inspection->probes.end()) {
        EXPECT_LT(weight, 1e-4) << "probe " << i;
        continue;
      }
      EXPECT_NEAR(found->weight, weight, 1e-4) << "probe " << i;
      EXPECT_NEAR(found->share, std::min(weight, left), 2e-4) << "probe " << i;
      left -= std::min(weight, left);
      weighing += weight > 0.0 ? 1 : 0;
    }
  }
  EXPECT_GT(weighing, 3U);
}

/// The list in the world at a surface is that of its pixel, and that of the cell around it.
TEST(WorldLists, AreThoseOfThePixel) {
  const ShaderLibrary shaders("");
  Stage stage(view_context(), shaders, "");
  ViewState state = small_viewer().state;
  state.request.scene = "atrium";
  state.request.lights = 300;
  state.world_cells = true;
  state.picked = glm::uvec2(40, 45);
  for (const char* method : {"world-cells", "world-tree"}) {
    state.request.method = method;
    const Shown shown = stage.draw(state, {96, 54});
    ASSERT_TRUE(shown.world && shown.inspection);
    ASSERT_EQ(shown.world->refused, "");
    const PointList& point = shown.world->points.front();
    EXPECT_EQ(point.walked, shown.inspection->lights.size()) << method;
    EXPECT_GT(point.reaching, 0U);
    EXPECT_EQ(point.missed, 0U);
    const auto own = std::ranges::find_if(shown.world->cells, [&](const WorldCell& cell) {
      return glm::all(glm::greaterThanEqual(point.position, cell.low)) &&
             glm::all(glm::lessThan(point.position, cell.low + cell.side));
    });
    ASSERT_NE(own, shown.world->cells.end());
    EXPECT_EQ(own->lights, point.walked) << method;
  }
}

/// Leaves lie side by side, and all points of one have one list; merged ones are larger than others.
TEST(WorldLeaves, HaveOneListEach) {
  std::vector<shared::Light> lights;
  for (int i = 0; i < 12; ++i)
    lights.push_back(
        {.position = {0.7F * static_cast<float>(i), 0.3F, 0.1F * static_cast<float>(i * i)}, .range = 1.5F});
  const WorldTree tree = take(WorldTree::build({.lights = lights}));
  const glm::vec3 point(1.3F, 0.4F, 0.6F);
  const std::vector<WorldCell> leaves = leaves_around(tree.words(), point);
  const auto holds = [](const WorldCell& leaf, const glm::vec3& at) {
    return glm::all(glm::greaterThanEqual(at, leaf.low)) && glm::all(glm::lessThan(at, leaf.low + leaf.side));
  };
  ASSERT_FALSE(leaves.empty());
  EXPECT_TRUE(holds(leaves.front(), point));  // it is on no face
  std::set<float> sides;
  for (const WorldCell& leaf : leaves) {
    sides.insert(leaf.side);
    const glm::vec3 middle = leaf.low + 0.5F * leaf.side;
    const std::vector<std::uint32_t> list = tree.lights_at(Vec3(middle));
    for (int corner = 0; corner < 8; ++corner) {
      const glm::vec3 way(corner & 1, corner >> 1 & 1, corner >> 2);
      EXPECT_EQ(tree.lights_at(Vec3(leaf.low + leaf.side * (0.01F + 0.98F * way))), list);
    }
    EXPECT_EQ(std::ranges::count_if(leaves, [&](const WorldCell& other) { return holds(other, middle); }), 1);
  }
  EXPECT_GT(sides.size(), 1U);
  EXPECT_TRUE(leaves_around(tree.words(), glm::vec3(1e4F)).empty());
}

/// The list of a pixel with lists of still lights has every light that one list of all has and that reaches it; what
/// the window says of them is what `lamp` says.
TEST(StillListsInTheWindow, HoldWhatReaches) {
  const ShaderLibrary shaders("");
  Stage stage(view_context(), shaders, "");
  ViewState state = small_viewer().state;
  state.request.scene = "atrium";
  state.request.lights = 100;
  state.request.still = 0.5F;
  state.request.path = "forward";
  state.request.decals = 4;  // records between those of the two kinds of lights
  state.picked = glm::uvec2(40, 45);
  const auto reaching = [&] {
    const Shown shown = stage.draw(state, {96, 54});
    std::vector<std::pair<std::uint32_t, int>> lights;  // with their shares, in thousandths
    for (const ListedLight& light : shown.inspection->lights)
      if (light.reach == Reach::inside) lights.emplace_back(light.light, std::lround(1000.0 * light.share));
    return lights;
  };
  const auto all = reaching();
  EXPECT_GT(all.size(), 2U);
  state.request.still_lists = "world-tree";
  EXPECT_EQ(reaching(), all);
  state.request.still_lists = "triangle-lists";
  const auto in_front = reaching();  // lights behind the surface are in no list of its triangle
  for (const auto& light : all)
    EXPECT_TRUE(light.second == 0 || std::ranges::find(in_front, light) != in_front.end()) << light.first;
}

}  // namespace
}  // namespace lamp::app
