// The tool's frames with depth and views as hosts have them: pictures are those of reversed depth, those of each
// sample, and those that each view has alone.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "gpu/method_check.h"
#include "gpu/test_lights.h"
#include "gpu/test_scenes.h"
#include "render/antialias.h"
#include "scene/flight.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t WIDTH = 99;  // no multiple of any tile
constexpr std::uint32_t HEIGHT = 55;
constexpr std::uint32_t LIGHTS = 150;

/// The atrium, which has glass: frames that differ in nothing but their depth.
class HostDepths : public GpuTest {
 protected:
  HostDepths()
      : scene_(builtin_test_scene("atrium")),
        view_(view_of(find_camera(scene_.scene, ""), WIDTH, HEIGHT, "camera")),
        lights_(test_lights(scene_.air, view_, {.count = LIGHTS, .mix = Mix::both})) {}

  Renderer renderer(const HostDepth& depth) {
    Renderer made(test_context(), shader_library(), scene_.gpu, WIDTH, HEIGHT, LIGHTS, /*decal_capacity=*/0, depth);
    made.set_frame(depth.reversed ? view_ : with_standard_depth(view_), lights_);
    return made;
  }
  static Lighting lighting(const HostDepth& depth, const char* method, ShadingPath path) {
    const Method& row = *take(find_method(method));
    return {test_context().device(),
            shader_library(),
            {.method = &row,
             .options = take(resolve_options(row, {})),
             .width = WIDTH,
             .height = HEIGHT,
             .light_capacity = LIGHTS,
             .path = path,
             .depth = depth,
             .transparency = true}};
  }
  HdrImage picture(Renderer& of, const char* method, ShadingPath path) {
    Lighting made = lighting(of.depth(), method, path);
    return render_samples(of, made, lights_, {}, {}).image;
  }

  const TestScene& scene_;
  View view_;
  std::vector<shared::Light> lights_;
};

constexpr ShadingPath PATHS[] = {ShadingPath::forward, ShadingPath::tiled_deferred, ShadingPath::deferred,
                                 ShadingPath::standard_deferred};

TEST_F(HostDepths, StandardDepthShowsTheSame) {
  Renderer reversed = renderer({});
  Renderer standard = renderer({.reversed = false});
  for (const ShadingPath path : PATHS) {
    SCOPED_TRACE(path_names()[static_cast<std::size_t>(path)]);
    const HdrImage wanted = picture(reversed, "lamplight", path);
    const HdrImage shown = picture(standard, "lamplight", path);
    // Another depth is another rounding: where it decides between two surfaces, or at a shadowed edge, pixels differ.
    std::size_t others = 0;
    for (std::size_t i = 0; i < wanted.pixels.size(); ++i) {
      const float larger = std::max(glm::length(wanted.pixels[i]), glm::length(shown.pixels[i]));
      if (glm::distance(wanted.pixels[i], shown.pixels[i]) > 0.01F * larger) ++others;
    }
    EXPECT_LE(others, wanted.pixels.size() / 500);
  }
}

TEST_F(HostDepths, EachSampleIsShadedAsAPictureOfItsOwn) {
  for (const bool is_reversed : {true, false}) {
    const View view = is_reversed ? view_ : with_standard_depth(view_);
    Renderer one = renderer({.reversed = is_reversed});
    Lighting brute = lighting(one.depth(), "all", ShadingPath::deferred);
    HdrImage sum;
    for (const std::uint32_t sample : {1U, 2U, 3U, 0U}) {  // in the order in which they are added up
      one.set_frame(shifted(view, sample_places(4)[sample] - 0.5), lights_);
      HdrImage image = one.render(brute).image;
      for (std::size_t i = 0; i < sum.pixels.size(); ++i) image.pixels[i] += sum.pixels[i];
      sum = std::move(image);
    }
    for (glm::vec4& pixel : sum.pixels) pixel /= 4.0F;
    Renderer four = renderer({.samples = 4, .reversed = is_reversed});
    for (const char* method : {"tight", "lamplight", "clustered"}) {
      SCOPED_TRACE(fmt::format("{} {}", method, is_reversed));
      EXPECT_EQ(max_abs_difference(picture(four, method, ShadingPath::deferred), sum), 0.0F);
    }
  }
}

// What is checked for each sample finds faults that a check of the pixels' centres would not.
TEST_F(HostDepths, ListsOfTheCentresLackLightsOfSamples) {
  Renderer one = renderer({});
  Renderer four = renderer({.samples = 4});
  Lighting of_one = lighting({}, "tight", ShadingPath::deferred);
  Lighting of_four = lighting(four.depth(), "tight", ShadingPath::deferred);
  static_cast<void>(one.draw_depth());
  std::uint64_t missed = 0;
  for (std::uint32_t sample = 0; sample < 4; ++sample) {
    four.show({.sample = sample});
    const std::vector<float> depth = four.draw_depth();
    const Truth lit = truth({.view = four.view(), .depth = depth, .lights = lights_, .rows = HEIGHT});
    for (const Visit& visit : four.visit(of_four, lit)) EXPECT_EQ(visit.missed, 0);
    for (const Visit& visit : one.visit(of_one, lit)) missed += visit.missed;
  }
  EXPECT_GT(missed, 100);
}

TEST_F(HostDepths, EachViewIsShadedAsAPictureOfItsOwn) {
  const std::vector<View> views = all_around(view_, 3);
  Renderer one = renderer({});
  Renderer together(test_context(), shader_library(), scene_.gpu, WIDTH, HEIGHT, LIGHTS, 0, {.views = 3});
  together.set_frame(views, lights_);
  for (const ShadingPath path : {ShadingPath::forward, ShadingPath::tiled_deferred, ShadingPath::deferred}) {
    std::vector<HdrImage> alone;
    for (const View& view : views) {
      one.set_frame(view, lights_);
      alone.push_back(picture(one, "all", path));
    }
    for (const char* method : {"tiled", "clustered", "lamplight"}) {
      SCOPED_TRACE(fmt::format("{} {}", method, path_names()[static_cast<std::size_t>(path)]));
      Lighting lit = lighting(together.depth(), method, path);
      const HdrImage shown = render_views(together, lit, lights_, {}, {}).image;
      EXPECT_LE(max_abs_difference(shown, side_by_side(alone)), 1e-4F);
    }
  }
}

// A check of one view alone would not find what the lists of another lack.
TEST_F(HostDepths, ListsOfOneViewLackLightsOfAnother) {
  const std::vector<View> eyes = both_eyes(view_, 1.0);
  Renderer two(test_context(), shader_library(), scene_.gpu, WIDTH, HEIGHT, LIGHTS, 0, {.views = 2});
  two.set_frame(eyes, lights_);
  Lighting of_two = lighting(two.depth(), "tight", ShadingPath::deferred);
  Renderer left = renderer({});
  left.set_frame(eyes[0], lights_);
  static_cast<void>(left.draw_depth());
  Lighting of_left = lighting({}, "tight", ShadingPath::deferred);
  two.show({.view = 1});
  const std::vector<float> depth = two.draw_depth();
  const Truth lit = truth({.view = eyes[1], .depth = depth, .lights = lights_, .rows = HEIGHT});
  for (const Visit& visit : two.visit(of_two, lit)) EXPECT_EQ(visit.missed, 0);
  std::uint64_t missed = 0;
  for (const Visit& visit : left.visit(of_left, lit)) missed += visit.missed;
  EXPECT_GT(missed, 100);
}

TEST_F(HostDepths, ManySamplesThatNoDeviceHasAreRefused) {
  try {
    static_cast<void>(renderer({.samples = 32}));
    FAIL() << "expected an error, or a device with images of 32 samples";
  } catch (const Error& error) {
    EXPECT_EQ(error.exit(), Exit::no_device);
    EXPECT_NE(std::string(error.what()).find("depth of 32 samples a pixel: device "), std::string::npos);
  }
}

}  // namespace
}  // namespace lamp::app
