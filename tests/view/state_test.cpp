// A state that is written and read again is the same; what is wrong is named and changes nothing.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "commands/view_state.h"

namespace lamp::app {
namespace {

/// No member as a new state has it.
ViewState full_state() {
  ViewState state;
  Request& r = state.request;
  r.scene = "posts";
  r.size = "320x200";
  r.size_given = true;
  r.lights = 77;
  r.lights_given = true;
  r.spots = 0.123F;
  r.range = "1:2";
  r.decals = 5;
  r.seed = 0xFFFFFFFFFFFFFFFFULL;
  r.method = "tiled";
  r.options = {"bounds=minmax", "tile=32"};
  r.path = "forward";
  r.brdf = "blinn-phong";
  r.light_frame = 12;
  r.free_camera = FreeCamera{.eye = {0.1, 1.0 / 3.0, -7e-9}, .yaw = 2.1, .pitch = -0.7, .fov_y = 0.9F};
  r.projection = "infinite";
  r.depth = "standard";
  r.depth_samples = 4;
  r.grow = true;
  state.exposure = "0.25";
  state.samples = 4;
  state.edits = {{.light = 3,
                  .value = {.type = LightType::spot,
                            .position = {1.0F, 2.0F, 1.0F / 3.0F},
                            .range = 4.0F,
                            .color = {1.0F, 0.5F, 0.0F},
                            .intensity = 9.0F,
                            .direction = {0.0F, -1.0F, 0.0F},
                            .inner_angle = 0.1F,
                            .outer_angle = 0.2F}},
                 {.light = 1, .value = {.position = {1.0F, 2.0F, 3.0F}}}};
  state.request.shadows.filter = "pcf";
  state.request.shadows.points = "octahedron";
  state.request.shadows.raster = "compute";
  state.request.shadows.blur = "listing";
  state.request.shadows.lights = "5";
  state.request.shadows.budget = "65536";
  state.request.shadows.atlas = 1024;
  state.request.still = 0.5F;
  state.request.still_lists = "world-tree";
  state.request.still_occlusion = 16;
  state.request.still_bytes = 7.0F;
  state.request.probes = 3;
  state.request.probes_show = "flat";
  state.request.probe_budget = 2;
  state.resolution = 0.5F;
  state.paused = true;
  state.speed = -2.0F;
  state.overlay = Overlay::depth_range;
  state.palette = Palette::grey;
  state.light_marks = LightMarks::cell;
  state.decal_boxes = true;
  state.proxies = LightMarks::all;
  state.shadow_shape = ShadowShape::mesh;
  state.slice_m = 7.5F;
  state.depth_bins = true;
  state.probe_boxes = true;
  state.world_cells = true;
  state.list_lengths = true;
  state.drawn = glm::uvec2(160, 100);
  state.picked = glm::uvec2(7, 9);
  state.light = 3;
  state.other = "clustered";
  state.against = Against{.method = "clustered", .options = {"tile=64"}, .divider = 0.25F};
  state.panels = false;
  state.help = true;
  return state;
}

TEST(ViewStateJson, ComesBackAsItWas) {
  for (const ViewState& state : {ViewState(), full_state()}) {
    const nlohmann::json written = to_json(state);
    ViewState read;
    read_state(read, nlohmann::json::parse(written.dump()), "state");
    EXPECT_EQ(to_json(read), written);
  }
}

TEST(ViewStateJson, SizeOfTheWindowIsNotGiven) {
  ViewState state;
  state.request.size = "320x200";
  ViewState read;
  read_state(read, to_json(state), "state");
  EXPECT_EQ(read.request.size, "320x200");
  EXPECT_FALSE(read.request.size_given);
}

TEST(ViewStateTest, PickedPixelStaysWhereItIsSeen) {
  const auto fitted = [](glm::uvec2 picked, const std::string& size) {
    ViewState state;
    state.request.size = size;
    state.picked = picked;
    fit_to_size(state, {100, 50});
    return state.picked;
  };
  EXPECT_EQ(fitted({60, 30}, "200x50"), glm::uvec2(110, 30));
  EXPECT_EQ(fitted({60, 30}, "200x100"), glm::uvec2(121, 61));
  EXPECT_EQ(fitted({60, 30}, "100x50"), glm::uvec2(60, 30));
  EXPECT_FALSE(fitted({95, 30}, "50x50").has_value());
}

/// A capture was opened after a scene with so many lights: none are generated beside its own.
TEST(ViewStateJson, AddsNoLightsToACapture) {
  ViewState state;
  state.request.lights = 77;
  ViewState read;
  read_state(read, to_json(state), "state");
  EXPECT_EQ(read.request.lights, 77U);
  EXPECT_FALSE(read.request.lights_given);
  read_state(read, {{"lights", 5U}}, "line");
  EXPECT_TRUE(read.request.lights_given);
}

TEST(ViewStateJson, HasEveryMember) {
  const nlohmann::json plain = to_json(ViewState());
  const nlohmann::json full = to_json(full_state());
  for (const auto& [key, value] : full.items()) {
    if (key == "version" || key == "camera" || key == "frame") continue;
    if (key == "moving" || key == "mirror" || key == "mirror_lists") continue;  // with still lists they do not go
    EXPECT_FALSE(plain.contains(key) && plain.at(key) == value) << key << " is as in a new state";
  }
}

TEST(ViewStateJson, SetsOnlyWhatIsThere) {
  ViewState state = full_state();
  read_state(state, {{"overlay", "heat"}, {"against", {{"divider", 0.75}}}, {"free_camera", nullptr}}, "line");
  EXPECT_EQ(state.overlay, Overlay::heat);
  EXPECT_EQ(state.against->method, "clustered");
  EXPECT_EQ(state.against->divider, 0.75F);
  EXPECT_FALSE(state.request.free_camera.has_value());
  EXPECT_EQ(state.request.scene, "posts");
}

TEST(ViewStateJson, StaysAsItWasWhenSomethingIsWrong) {
  ViewState state = full_state();
  const nlohmann::json before = to_json(state);
  EXPECT_THROW(read_state(state, {{"overlay", "heat"}, {"speed", "quick"}}, "line"), Error);
  EXPECT_THROW(read_state(state, {{"method", "tiled"}, {"options", {{"tile", "7"}}}}, "line"), Error);
  EXPECT_THROW(read_state(state, {{"drawn", {0, 50}}}, "line"), Error);
  EXPECT_EQ(to_json(state), before);
}

TEST(FreeCameraTest, StandsWhereTheCameraDid) {
  const FreeCamera free{.eye = {1.0, 2.0, 3.0}, .yaw = 0.7, .pitch = -0.3};
  const FreeCamera again = free_from(camera_of(free));
  EXPECT_NEAR(again.yaw, free.yaw, 1e-6);
  EXPECT_NEAR(again.pitch, free.pitch, 1e-6);
  EXPECT_EQ(again.eye, free.eye);
  const glm::dmat3 axes(camera_of(free).world_from_camera);
  EXPECT_NEAR(glm::determinant(axes), 1.0, 1e-6);
}

}  // namespace
}  // namespace lamp::app
