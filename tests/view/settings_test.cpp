// Settings come back as they were; a file that holds something else is named.
// SPDX-License-Identifier: Apache-2.0
#include "view/settings.h"

#include <gtest/gtest.h>

#include "image/image.h"
#include "temporary_folder.h"

namespace lamp::app {
namespace {

TEST(SettingsTest, ComeBackAsTheyWere) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "new" / "lamp-view.json";
  const Settings settings{.palette = Palette::grey,
                          .light_marks = LightMarks::all,
                          .panels = false,
                          .speed = 2.5F,
                          .resolution = 0.5F,
                          .screen = {800, 601}};
  save_settings(file, settings);
  const Settings read = load_settings(file);
  EXPECT_EQ(read.palette, settings.palette);
  EXPECT_EQ(read.light_marks, settings.light_marks);
  EXPECT_EQ(read.panels, settings.panels);
  EXPECT_EQ(read.speed, settings.speed);
  EXPECT_EQ(read.resolution, settings.resolution);
  EXPECT_EQ(read.screen, settings.screen);
}

TEST(SettingsTest, AreTheDefaultsWithoutAFile) {
  EXPECT_EQ(load_settings("/nonexistent/lamp-view.json").screen, Settings().screen);
}

/// A desktop that scales opens the next window as large as the last.
TEST(SettingsTest, WindowDoesNotGrow) {
  for (const float scale : {1.0F, 1.25F, 1.5F, 2.0F}) {
    const glm::uvec2 asked(1280, 720);
    EXPECT_EQ(unscaled(glm::uvec2(glm::vec2(asked) * scale), scale), asked) << scale;
  }
  EXPECT_EQ(unscaled({0, 0}, 2.0F), glm::uvec2(0, 0));
  EXPECT_EQ(unscaled({1, 1}, 4.0F), glm::uvec2(1, 1));
}

TEST(SettingsTest, SayWhatIsWrong) {
  const TemporaryFolder folder;
  const std::filesystem::path file = folder.path() / "lamp-view.json";
  for (const auto& [text, says] : std::vector<std::pair<std::string, std::string>>{
           {"{", "is no JSON"},
           {R"({"method": "tiled"})", "\"method\" is not a key of the format"},
           {R"({"palette": "red"})", "palette is \"red\", expected one of rainbow"},
           {R"({"screen": [0, 5]})", "screen must be two numbers of pixels"}}) {
    write_text(file, text);
    try {
      static_cast<void>(load_settings(file));
      ADD_FAILURE() << text;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(says), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace lamp::app
