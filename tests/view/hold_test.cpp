// Dynamic resolution, and what it leaves as it is: while a pixel is looked into and time stands, the picture's size.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "view/view_test.h"

namespace lamp::app {
namespace {

/// Every picture takes too long, on any device: they become as small as can be; and full when they rest, however long
/// it takes.
HeadlessInfo slow_viewer() {
  HeadlessInfo info = small_viewer();
  info.target_ms = 1e-6;
  info.rest_ms = std::numeric_limits<double>::infinity();
  info.state.paused = false;
  info.state.picked.reset();
  return info;
}

void play_slowly(const std::string& script) {
  run_headless(view_context(), slow_viewer(), [&](Player& player) {
    EXPECT_NO_THROW(play(player, parse_script(script, "hold"))) << player.viewer.report()["shown"];
  });
}

TEST(Hold, PicturesThatRestAreDrawnFullWhereNoPixelIsPicked) {
  play_slowly(R"({"wait": 40}
{"expect": {"/shown/width": 12}}
{"set": {"paused": true}}
{"wait": 40}
{"expect": {"/shown/width": 96}})");
}

/// The pixel's place, its cell and its list stay, until the camera moves or somebody looks away.
TEST(Hold, ThePictureKeepsItsSizeWhileAPixelIsReadAndTimeStands) {
  play_slowly(R"({"wait": 40}
{"set": {"picked": [48, 44], "paused": true}}
{"wait": 40}
{"expect": {"/shown/width": 12, "/inspection/sky": false}}
{"set": {"method": "clustered"}}
{"wait": 40}
{"expect": {"/shown/width": 12, "/shown/method": "clustered"}}
{"click": "look away"}
{"wait": 40}
{"expect": {"/shown/width": 96}}
{"set": {"picked": [48, 44]}}
{"wait": 40}
{"expect": {"/shown/width": 96, "/inspection/pixel/0": 48}}
{"set": {"light": 3, "method": "tiled"}}
{"wait": 5}
{"expect": {"/shown/width": 96}}
{"hold": "w", "frames": 10}
{"wait": 40}
{"expect": {"/shown/width": 12, "/error": ""}}
{"set": {"resolution": 1}}
{"wait": 40}
{"expect": {"/shown/width": 96}})");
}

/// Whichever of the two is let go first. Once released, the key flies again.
TEST(Hold, AKeyOfAChordDoesNotFly) {
  run_headless(view_context(), small_viewer(), [](Player& player) {
    const auto flies = [&](std::set<std::string, std::less<>> held, std::vector<std::string> pressed) {
      player.input.held = std::move(held);
      player.input.pressed = std::move(pressed);
      for (int i = 0; i < 3; ++i) player.frame();
      return player.viewer.state().request.free_camera.has_value();
    };
    play(player, parse_script(R"({"wait": "idle"})", "chord"));
    EXPECT_FALSE(flies({"a", "ctrl"}, {"a"}));
    EXPECT_FALSE(flies({"a"}, {}));
    EXPECT_FALSE(flies({}, {}));
    EXPECT_TRUE(flies({"a"}, {"a"}));
    player.input.held.clear();
  });
}

}  // namespace
}  // namespace lamp::app
