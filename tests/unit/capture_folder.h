// A small capture that other parts of a test damage, in a folder that goes with the test.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "error.h"
#include "image/exr.h"
#include "scene/capture.h"
#include "temporary_folder.h"

namespace lamp::test {

using nlohmann::json;

inline constexpr std::uint32_t WIDTH = 4;
inline constexpr std::uint32_t HEIGHT = 3;

/// Reversed depth, near plane 0.5 m, infinite far; the eye at (1, 2, 3), looking down -Z.
inline json frame_json() {
  return json::parse(R"({"version": 1, "width": 4, "height": 3,
    "clip_from_view": [1, 0, 0, 0,  0, -1, 0, 0,  0, 0, 0, -1,  0, 0, 0.5, 0],
    "view_from_world": [1, 0, 0, 0,  0, 1, 0, 0,  0, 0, 1, 0,  -1, -2, -3, 1],
    "depth": "depth.exr",
    "lights": [{"type": "point", "position": [1, 2, 0], "range": 3},
               {"type": "spot", "position": [0, 0, 0], "range": 9, "color": [1, 0.5, 0], "intensity": 7,
                "direction": [0, -1, 0], "inner_angle": 0.25, "outer_angle": 0.5}]})");
}

/// 1 m ahead everywhere but at pixel (3, 2), which is sky.
inline std::vector<float> frame_depth() {
  std::vector<float> depth(WIDTH * HEIGHT, 0.5F);
  depth.back() = 0.0F;
  return depth;
}

class CaptureFolder : public testing::Test {
 protected:
  CaptureFolder() {
    write("frame.json", frame_json().dump());
    write_depth(frame_depth());
  }

  [[nodiscard]] std::filesystem::path path(const std::string& name) const { return folder_.path() / name; }
  [[nodiscard]] app::Scene load() const { return app::load_capture(folder_.path()); }
  /// What the loader says; empty if it loads.
  [[nodiscard]] std::string error_text() const {
    try {
      static_cast<void>(load());
    } catch (const app::Error& error) {
      EXPECT_EQ(error.exit(), app::Exit::bad_input);
      return error.what();
    }
    return {};
  }
  /// One line that begins with the file's name and has `says`.
  void expect_error(const std::string& file, const std::string& says) const {
    const std::string error = error_text();
    EXPECT_TRUE(error.starts_with(path(file).string() + ": ")) << error;
    EXPECT_NE(error.find(says), std::string::npos) << "got:  " << error << "\nwant: " << says;
    EXPECT_EQ(error.find_first_of("\n\r"), std::string::npos) << error;
  }

  void write(const std::string& name, std::string_view bytes) const {
    std::ofstream(path(name), std::ios::binary) << bytes;
  }
  [[nodiscard]] std::string read(const std::string& name) const {
    std::ifstream stream(path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  void write_depth(const std::vector<float>& depth) const {
    constexpr std::array<std::string_view, 1> Z{"Z"};
    app::write_exr(path("depth.exr"), {.width = WIDTH, .height = HEIGHT, .channels = Z, .first = depth.data()});
  }
  /// The same three values at every pixel.
  void write_plane(const std::string& name, const std::array<std::string_view, 3>& channels,
                   const std::array<float, 3>& value) const {
    std::vector<float> values;
    for (std::uint32_t i = 0; i < WIDTH * HEIGHT; ++i) values.insert(values.end(), value.begin(), value.end());
    app::write_exr(
        path(name),
        {.width = WIDTH, .height = HEIGHT, .channels = channels, .first = values.data(), .floats_per_pixel = 3});
  }
  /// frame.json with a value set at a pointer, or without it where the text is empty.
  void change(const std::string& pointer, const std::string& value) const {
    json frame = json::parse(read("frame.json"));
    const json::json_pointer place(pointer);
    if (value.empty())
      frame[place.parent_pointer()].erase(place.back());
    else
      frame[place] = json::parse(value);
    write("frame.json", frame.dump());
  }

 private:
  app::TemporaryFolder folder_;
};

}  // namespace lamp::test
