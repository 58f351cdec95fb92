// Captures: written and read again bit for bit; depth of every kind; what is left out is neutral; a folder whole or not
// at all.
// SPDX-License-Identifier: Apache-2.0
#include "scene/capture.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>
#include <set>

#include "lamplight/view.h"
#include "system/file_access.h"
#include "unit/capture_folder.h"
#include "unit/this_system.h"

namespace lamp::test {
namespace {

using app::CapturedFrame;
using app::LightsFormat;
using app::Scene;
using Capture = CaptureFolder;

constexpr float INFINITE = std::numeric_limits<float>::infinity();

View wide_view(std::uint32_t width, std::uint32_t height) {
  const glm::dmat4 clip = perspective({.left = -1.0, .right = 1.5, .bottom = -0.7, .top = 0.6}, 0.1, 777.7);
  glm::dmat4 pose(1.0);
  pose[3] = {3.7, 1.3, -9.1, 1.0};
  return View::create(width, height, clip, glm::inverse(pose)).value();
}

/// Values of all kinds, sky among them.
Scene random_frame(std::uint32_t width, std::uint32_t height) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  const auto triple = [&] { return glm::vec3(unit(random), unit(random), unit(random)); };
  CapturedFrame frame{.view = wide_view(width, height)};
  for (std::size_t i = 0; i < std::size_t{width} * height; ++i) {
    const bool sky = i % 7 == 3;
    frame.depth.push_back(sky ? 0.0F : 0.001F + 0.9F * unit(random));
    frame.albedo.push_back(sky ? glm::vec3(0.0F) : triple());
    frame.normal.push_back(sky ? glm::vec3(0.0F) : glm::normalize(triple() - 0.4F));
    frame.material.push_back(sky ? glm::vec3(0.0F) : triple());
    frame.emission.push_back(sky ? glm::vec3(0.0F) : 900.0F * triple());
  }
  Scene scene{.directional_lights = {{glm::normalize(glm::vec3(1, -2, 0.3F)), {3, 2, 1.1F}}},
              .sky = {0.1F, 0.2F, 0.7F},
              .ambient = {0.3F, 0.1F, 0.05F},
              .captured = std::move(frame)};
  for (int i = 0; i < 40; ++i) {
    Light light{.type = i % 2 == 0 ? LightType::point : LightType::spot,
                .position = 20.0F * triple(),
                .range = i == 4 ? INFINITE : 5.0F * unit(random),
                .color = triple(),
                .intensity = 100.0F * unit(random)};
    if (i % 2 != 0) {
      light.direction = triple() + 0.1F;
      light.inner_angle = 0.5F * unit(random);
      light.outer_angle = 0.6F + 0.5F * unit(random);
    }
    scene.lights.push_back(light);
  }
  return scene;
}

void expect_same_light(const Light& a, const Light& b) {
  EXPECT_EQ(a.type, b.type);
  EXPECT_EQ(a.position, b.position);
  EXPECT_EQ(std::min(a.range, shared::INFINITE_RADIUS), std::min(b.range, shared::INFINITE_RADIUS));
  EXPECT_EQ(a.color, b.color);
  EXPECT_EQ(a.intensity, b.intensity);
  EXPECT_EQ(a.direction, b.direction);
  EXPECT_EQ(a.inner_angle, b.inner_angle);
  EXPECT_EQ(a.outer_angle, b.outer_angle);
}

TEST_F(Capture, IsReadAsItWasWritten) {
  const Scene scene = random_frame(17, 9);
  for (const LightsFormat format : {LightsFormat::npy, LightsFormat::json}) {
    write_capture(path("out"), scene, format);
    const Scene read = app::load_capture(path("out"));
    ASSERT_TRUE(read.captured);
    EXPECT_EQ(read.captured->view.width(), 17U);
    EXPECT_EQ(read.captured->view.height(), 9U);
    EXPECT_EQ(read.captured->view.clip_from_view(), scene.captured->view.clip_from_view());
    EXPECT_EQ(read.captured->view.view_from_world(), scene.captured->view.view_from_world());
    EXPECT_EQ(read.captured->depth, scene.captured->depth);
    EXPECT_EQ(read.captured->albedo, scene.captured->albedo);
    EXPECT_EQ(read.captured->normal, scene.captured->normal);
    EXPECT_EQ(read.captured->material, scene.captured->material);
    EXPECT_EQ(read.captured->emission, scene.captured->emission);
    EXPECT_EQ(read.ambient, scene.ambient);
    EXPECT_EQ(read.sky, scene.sky);
    ASSERT_EQ(read.directional_lights.size(), 1U);
    EXPECT_EQ(read.directional_lights[0].direction, scene.directional_lights[0].direction);
    EXPECT_EQ(read.directional_lights[0].illuminance, scene.directional_lights[0].illuminance);
    ASSERT_EQ(read.lights.size(), scene.lights.size());
    for (std::size_t i = 0; i < scene.lights.size(); ++i) expect_same_light(read.lights[i], scene.lights[i]);
    std::set<std::filesystem::path> there;
    for (const auto& entry : std::filesystem::directory_iterator(path("out"))) there.insert(entry.path());
    EXPECT_EQ(std::set(read.files.begin(), read.files.end()), there) << "reads all that was written";
  }
}

TEST_F(Capture, NeedsNoMoreThanDepthAndLights) {
  const Scene scene = load();
  ASSERT_TRUE(scene.captured);
  EXPECT_EQ(scene.captured->depth, frame_depth());
  EXPECT_EQ(scene.captured->albedo[5], glm::vec3(0.5F));
  EXPECT_EQ(scene.captured->emission[5], glm::vec3(0.0F));
  EXPECT_LT(glm::distance(scene.captured->normal[5], glm::vec3(0, 0, 1)), 1e-6F) << "a wall that faces the eye";
  ASSERT_EQ(scene.lights.size(), 2U);
  EXPECT_EQ(scene.lights[0].range, 3.0F);
  EXPECT_EQ(scene.lights[1].type, LightType::spot);
  EXPECT_EQ(scene.lights[1].outer_angle, 0.5F);
  EXPECT_GT(scene.ambient.r, 0.0F) << "unlit surfaces would be black";
  ASSERT_EQ(scene.cameras.size(), 1U);
  change("/lights/0/range", "");
  EXPECT_GE(load().lights[0].range, shared::INFINITE_RADIUS);
}

TEST_F(Capture, TakesLinearDepth) {
  change("/depth_kind", "\"linear\"");
  std::vector<float> depth{0.5F, 1.0F, 2.0F, 1000.0F, INFINITE, 0.0F, 0.75F, 3.0F, 4.0F, 5.0F, 6.0F, 7.0F};
  write_depth(depth);
  const Scene scene = load();
  for (std::size_t i = 0; i < depth.size(); ++i) {
    const float read = scene.captured->depth[i];
    if (depth[i] == 0.0F || std::isinf(depth[i])) {
      EXPECT_EQ(read, 0.0F) << "sky";
    } else {
      EXPECT_NEAR(scene.captured->view.z_view(read), depth[i], 1e-6 * depth[i]);
    }
  }
}

/// The same camera as a renderer has it whose depth grows: near 0, far 1.
TEST_F(Capture, TakesDepthThatGrows) {
  constexpr double NEAR = 0.5;
  constexpr double FAR = 100.0;
  const json clip{1, 0, 0, 0, 0, -1, 0, 0, 0, 0, FAR / (NEAR - FAR), -1, 0, 0, NEAR * FAR / (NEAR - FAR), 0};
  change("/clip_from_view", clip.dump());
  change("/depth_kind", "\"standard\"");
  std::vector<float> depth(WIDTH * HEIGHT, 1.0F);
  const std::vector<double> metres{0.5, 0.75, 1.0, 3.0, 20.0, 99.0};
  for (std::size_t i = 0; i < metres.size(); ++i)
    depth[i] = static_cast<float>(FAR / (FAR - NEAR) * (1.0 - NEAR / metres[i]));
  write_depth(depth);
  const Scene scene = load();
  for (std::size_t i = 0; i < metres.size(); ++i)
    EXPECT_NEAR(scene.captured->view.z_view(scene.captured->depth[i]), metres[i], 2e-5 * metres[i] * metres[i]);
  EXPECT_EQ(scene.captured->depth.back(), 0.0F) << "1 is sky";

  // With the same matrix, metres: beyond the far plane is sky.
  change("/depth_kind", "\"linear\"");
  depth.assign(depth.size(), 101.0F);
  depth[0] = 60.0F;
  write_depth(depth);
  const Scene linear = load();
  EXPECT_NEAR(linear.captured->view.z_view(linear.captured->depth[0]), 60.0, 1e-2);
  EXPECT_EQ(linear.captured->depth[1], 0.0F);
}

TEST_F(Capture, NormalsAreMadeUnit) {
  change("/normal", "\"normal.exr\"");
  write_plane("normal.exr", {"X", "Y", "Z"}, {0, 3, 4});
  EXPECT_LT(glm::distance(load().captured->normal[0], glm::vec3(0, 0.6F, 0.8F)), 1e-6F);
}

std::vector<std::string> names_in(const std::filesystem::path& folder) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    names.push_back(entry.path().filename().string());
  std::ranges::sort(names);
  return names;
}

template <class Call>
std::string error_line(const Call& call) {
  try {
    call();
  } catch (const app::Error& error) {
    return error.what();
  }
  return {};
}

TEST_F(Capture, ReplacesAnotherCaptureAndNothingElse) {
  const Scene scene = random_frame(5, 4);
  write_capture(path("a/b"), scene, LightsFormat::npy);
  EXPECT_TRUE(std::filesystem::exists(path("a/b/lights.npy")));
  write_capture(path("a/b/"), scene, LightsFormat::json);
  EXPECT_FALSE(std::filesystem::exists(path("a/b/lights.npy")));
  EXPECT_EQ(names_in(path("a")), std::vector<std::string>{"b"});

  write("a/b/notes.txt", "mine");
  const std::string says = error_line([&] { write_capture(path("a/b"), scene, LightsFormat::npy); });
  EXPECT_NE(says.find("holds notes.txt, expected a new folder, an empty one or a capture to replace"),
            std::string::npos)
      << says;
  EXPECT_EQ(read("a/b/notes.txt"), "mine");
  write("file", "mine");
  EXPECT_NE(error_line([&] { write_capture(path("file"), scene, LightsFormat::npy); }).find("is a file"),
            std::string::npos);
  EXPECT_NE(error_line([&] { write_capture(path("file/a"), scene, LightsFormat::npy); }).find("is not a folder"),
            std::string::npos);
  EXPECT_NE(error_line([&] { write_capture("", scene, LightsFormat::npy); }).find("expected the name of a folder"),
            std::string::npos);
  EXPECT_EQ(read("file"), "mine");
}

TEST_F(Capture, AFullDiskLeavesTheFolderAsItWas) {
  if (!FileSizeLimit::is_there()) GTEST_SKIP() << "no limit for sizes of files here";
  const std::vector<std::string> before = names_in(path("."));
  const Scene small = random_frame(5, 4);
  write_capture(path("old"), small, LightsFormat::npy);
  const Scene large = random_frame(100, 100);
  std::string of_new;
  std::string of_old;
  {
    const FileSizeLimit full(4096);
    of_new = error_line([&] { write_capture(path("new/folder"), large, LightsFormat::npy); });
    of_old = error_line([&] { write_capture(path("old"), large, LightsFormat::npy); });
  }
  EXPECT_NE(of_new.find("cannot be written: File too large"), std::string::npos) << of_new;
  EXPECT_NE(of_old.find("cannot be written: File too large"), std::string::npos) << of_old;
  EXPECT_EQ(app::load_capture(path("old")).captured->depth, small.captured->depth);
  std::filesystem::remove_all(path("old"));
  EXPECT_EQ(names_in(path(".")), before);
}

TEST_F(Capture, AFolderThatIsNotWritable) {
  if (std::filesystem::exists("/proc")) {  // not even by root
    EXPECT_NE(error_line([&] { write_capture("/proc/new", random_frame(2, 2), LightsFormat::npy); }).find("writ"),
              std::string::npos);
  }
  std::filesystem::create_directory(path("locked"));
  std::filesystem::permissions(path("locked"), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  if (app::is_writable(path("locked"))) return;  // root may write here
  const std::string says =
      error_line([&] { write_capture(path("locked/new"), random_frame(2, 2), LightsFormat::npy); });
  EXPECT_NE(says.find("is not writable"), std::string::npos) << says;
}

}  // namespace
}  // namespace lamp::test
