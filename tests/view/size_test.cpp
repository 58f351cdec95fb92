// A picture that follows the window: what is picked stays where it is seen, and states bring back what was shown.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "system/run_program.h"
#include "view/view_test.h"

namespace lamp::app {
namespace {

class Size : public InFolder {
 protected:
  /// On a screen of 720 x 480, which leaves 320 x 456 to the picture.
  static void play_in_window(const char* script) {
    HeadlessInfo info = small_viewer();
    info.state.request.size_given = false;
    run_headless(view_context(), info, [&](Player& player) { play(player, parse_script(script, "size")); });
  }
};

TEST_F(Size, PickedPixelStaysWhereItIsSeen) {
  EXPECT_NO_THROW(play_in_window(R"({"wait": "idle"}
{"click_picture": [0.75, 0.5]}
{"wait": "idle"}
{"expect": {"/inspection/pixel": [240, 228]}}
{"key": "tab"}
{"wait": "idle"}
{"expect": {"/window": "720x456", "/inspection/pixel": [440, 228]}}
{"key": "tab"}
{"wait": "idle"}
{"expect": {"/inspection/pixel": [240, 228]}}
{"resize": [720, 252]}
{"wait": "idle"}
{"expect": {"/window": "320x228", "/inspection/pixel": [200, 114]}}
{"resize": [430, 480]}
{"wait": "idle"}
{"resize": [720, 936]}
{"wait": "idle"}
{"expect": {"/window": "320x912", "/picked": null, "/error": ""}})"));
}

TEST_F(Size, StateBringsBackWhatWasShown) {
  EXPECT_NO_THROW(play_in_window(R"({"set": {"resolution": 0.5}}
{"wait": "idle"}
{"click_picture": [0.7, 0.6]}
{"wait": "idle"}
{"expect": {"/inspection/pixel": [112, 136], "/shown/width": 160}}
{"save_state": "state.json"}
{"save_picture": "view.exr"}
{"set": {"picked": null, "resolution": 0}}
{"wait": "idle"}
{"expect": {"/shown/width": 320}}
{"drop": "state.json"}
{"wait": "idle"}
{"expect": {"/inspection/pixel": [112, 136], "/shown/width": 160, "/resolution": 0.5}}
{"save_state": "again.json"}
{"drop": "again.json"}
{"wait": "idle"}
{"expect": {"/inspection/pixel": [112, 136], "/shown/width": 160}}
{"resize": [1040, 480]}
{"wait": "idle"}
{"expect": {"/window": "640x456", "/inspection/pixel": [192, 136], "/shown/width": 320}})"));
  const ProgramResult run = run_program({LAMP_EXECUTABLE, "render", "--state", "state.json", "-o", "lamp.exr"});
  ASSERT_TRUE(run.succeeded) << run.err;
  EXPECT_EQ(bytes_of_file("view.exr"), bytes_of_file("lamp.exr"));
}

/// What was drawn smaller to be quick is so again, until the camera moves.
TEST_F(Size, BookmarkKeepsTheSizeThatWasDrawn) {
  EXPECT_NO_THROW(play_in_window(R"({"wait": "idle"}
{"set": {"drawn": [80, 114]}}
{"wait": "idle"}
{"expect": {"/shown/width": 80}}
{"click": "Bookmarks"}
{"click": "name"}
{"type": "here"}
{"key": "enter"}
{"click": "add bookmark"}
{"set": {"drawn": null}}
{"wait": "idle"}
{"expect": {"/shown/width": 320}}
{"click": "here"}
{"wait": "idle"}
{"expect": {"/shown/width": 80}}
{"click": "add bookmark"}
{"click": "here"}
{"wait": "idle"}
{"expect": {"/shown/width": 80, "/window": "320x456"}}
{"hold": "w", "frames": 3}
{"wait": "idle"}
{"expect": {"/shown/width": 320, "/drawn": null}})"));
}

}  // namespace
}  // namespace lamp::app
