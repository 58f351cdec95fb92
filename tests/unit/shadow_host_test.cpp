// The frame of a host with a shadow atlas, as docs/shadow-atlas.md shows it.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <glm/gtc/matrix_transform.hpp>
#include <string>
#include <vector>

#include "lamplight/light.h"
#include "lamplight/shadow_atlas.h"

namespace {

/// What a host has of its own, in place of a GPU.
struct Host {
  std::size_t squares_cleared = 0;
  std::size_t views_drawn = 0;
  std::size_t maps_uploaded = 0;
  std::string log;

  void clear(std::span<const lamp::ShadowSquare> squares) { squares_cleared += squares.size(); }
  void draw(std::span<const lamp::shared::ShadowView> views) { views_drawn += views.size(); }
  void upload(std::span<const lamp::shared::ShadowMap> maps) { maps_uploaded = maps.size(); }
  void say(const std::string& text) { log = text; }
};

TEST(ShadowHost, DrawsAFrame) {
  Host host;
  const lamp::View view =
      lamp::View::create(1280, 720, lamp::perspective(lamp::symmetric_window(1.0, 16.0 / 9.0), 0.05, 100.0),
                         glm::dmat4(1.0))
          .value();
  const std::vector<lamp::shared::Light> lights(3, lamp::pack(lamp::Light{.position = {0, 0, -5}, .range = 2.0F}));

  lamp::Result<lamp::ShadowAtlas> atlas = lamp::ShadowAtlas::create(
      {.size = 4096, .max_image_size = 16384, .light_capacity = 1024, .filter = lamp::ShadowFilter::pcf});
  ASSERT_TRUE(atlas.ok());

  const lamp::Result<lamp::ShadowFrame> scheduled =
      atlas.value().schedule({.views = std::span(&view, 1), .lights = lights, .budget_texels = 8 * 1024 * 1024});
  if (!scheduled) return host.say(scheduled.error().text());
  const lamp::ShadowFrame& frame = scheduled.value();
  host.clear(frame.squares);
  host.draw(frame.views);
  host.upload(frame.maps);
  for (const std::uint32_t light : frame.without) host.say("light " + std::to_string(light) + " has no shadow");

  EXPECT_EQ(host.squares_cleared, 18U);
  EXPECT_EQ(host.views_drawn, 18U);
  EXPECT_EQ(host.maps_uploaded, 3U);
  EXPECT_EQ(host.log, "");
}

}  // namespace
