// What a frame of the shadow atlas lists for a host: squares to clear, radial bounds to make.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/gtc/matrix_transform.hpp>
#include <random>
#include <utility>
#include <vector>

#include "lamplight/light.h"
#include "lamplight/shadow_atlas.h"

namespace {

using lamp::Light;
using lamp::LightType;
using lamp::ShadowAtlas;
using lamp::ShadowFrame;
using lamp::View;
namespace shared = lamp::shared;

View view_of_the_middle() {
  return View::create(1280, 720, lamp::perspective(lamp::symmetric_window(1.0, 16.0 / 9.0), 0.05, lamp::INFINITE_FAR),
                      glm::lookAt(glm::dvec3(0, 0, 10), glm::dvec3(0.0), glm::dvec3(0.0, 1.0, 0.0)))
      .value();
}

shared::Light spot_at(const glm::vec3& position) {
  return lamp::pack(
      Light{.type = LightType::spot, .position = position, .range = 2.0F, .direction = {0.0F, -1.0F, 0.0F}});
}

ShadowAtlas atlas_of(const lamp::ShadowAtlasInfo& info) { return std::move(ShadowAtlas::create(info).value()); }

TEST(ShadowFrame, NamesTheSquaresOfWhatItDraws) {
  ShadowAtlas atlas = atlas_of({.size = 512, .light_capacity = 2});
  const View view = view_of_the_middle();
  const std::vector<shared::Light> lights = {lamp::pack(Light{.range = 1.0F}), spot_at({3, 0, 0})};
  const ShadowFrame frame = atlas.schedule({.views = std::span(&view, 1), .lights = lights}).value();
  ASSERT_EQ(frame.redraws.size(), 2U);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> expected;  // as maps have them
  for (const lamp::ShadowRedraw& redraw : frame.redraws)
    for (std::uint32_t i = 0; i < redraw.views; ++i)
      expected.emplace_back(frame.maps[redraw.light].squares[i], frame.maps[redraw.light].side);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> found;
  for (const lamp::ShadowSquare& square : frame.squares)
    found.emplace_back(square.corner.x / shared::LEAST_SQUARE | square.corner.y / shared::LEAST_SQUARE << 16U,
                       square.side);
  EXPECT_EQ(found, expected);
}

TEST(ShadowFrame, NamesLightsWhoseRadialBoundsAreToBeMadeAnew) {
  ShadowAtlas atlas = atlas_of({.size = 512, .light_capacity = 3});
  const View view = view_of_the_middle();
  std::vector<shared::Light> lights = {spot_at({-3, 0, 0}), spot_at({0, 0, 0}), spot_at({3, 0, 0})};
  std::vector<std::uint32_t> ids = {0, 1, 2};
  std::vector<shared::LightSphere> moved;
  using Jobs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;
  const auto jobs_of_a_frame = [&](std::uint64_t budget = lamp::ALL_TEXELS) {
    const auto frame = atlas.schedule(
        {.views = std::span(&view, 1), .lights = lights, .ids = ids, .moved = moved, .budget_texels = budget});
    Jobs jobs;
    for (const shared::RadialJob& job : frame.value().radial_jobs) jobs.emplace_back(job.light, job.shows_all);
    return jobs;
  };
  EXPECT_EQ(jobs_of_a_frame(0), (Jobs{{0, 0}, {1, 0}, {2, 0}}));  // nothing is known of any
  EXPECT_EQ(jobs_of_a_frame(), (Jobs{{0, 1}, {1, 1}, {2, 1}}));
  EXPECT_EQ(jobs_of_a_frame(), Jobs{});
  lights[1] = spot_at({0, 1, 0});
  EXPECT_EQ(jobs_of_a_frame(0), (Jobs{{1, 0}}));  // its map shows another place
  EXPECT_EQ(jobs_of_a_frame(0), Jobs{});
  EXPECT_EQ(jobs_of_a_frame(), (Jobs{{1, 1}}));
  moved = {{.center = {3, -1, 0}, .radius = 0.5F}};
  EXPECT_EQ(jobs_of_a_frame(), (Jobs{{2, 1}}));  // in the same squares
  moved.clear();
  std::swap(lights[0], lights[2]);
  std::swap(ids[0], ids[2]);
  EXPECT_EQ(jobs_of_a_frame(), (Jobs{{0, 1}, {2, 1}}));  // nothing is drawn, but bounds lie by index
  for (int i = 0; i < 2; ++i) {                          // of lights with a map, and of those without
    atlas.redraw_all();
    EXPECT_EQ(jobs_of_a_frame(0), (Jobs{{0, 0}, {1, 0}, {2, 0}}));
    EXPECT_EQ(jobs_of_a_frame(0), Jobs{});
  }
}

// A host that keeps what each job made, as a buffer on the GPU does: no index may keep the bound of what its map was.
TEST(ShadowFrame, LeavesNoBoundOfAnotherMapAtAnyIndex) {
  constexpr std::uint32_t LIGHTS = 12;
  ShadowAtlas atlas = atlas_of({.size = 256, .light_capacity = LIGHTS});
  const View view = view_of_the_middle();
  std::mt19937 random(7);
  std::vector<std::uint32_t> drawn(LIGHTS);  // by id: how often
  std::vector<std::pair<std::uint32_t, std::uint32_t>> bounds(
      LIGHTS);  // by index: of which id, and of which of its draws
  std::size_t kept = 0;
  for (int number = 0; number < 400; ++number) {
    std::vector<std::uint32_t> ids;
    for (std::uint32_t id = 0; id < LIGHTS; ++id)
      if (random() % 4 != 0) ids.push_back(id);
    if (random() % 4 == 0) std::shuffle(ids.begin(), ids.end(), random);
    std::vector<shared::Light> lights;
    for (const std::uint32_t id : ids) lights.push_back(spot_at({static_cast<float>(id % 4) * 3.0F - 4.5F, 0, 0}));
    std::vector<shared::LightSphere> moved;
    if (random() % 2 == 0)
      moved.push_back({.center = {static_cast<float>(random() % 4) * 3.0F - 4.5F, -1, 0}, .radius = 0.5F});
    const std::uint64_t budget = random() % 3 == 0 ? 4096 : lamp::ALL_TEXELS;
    const ShadowFrame frame =
        atlas
            .schedule(
                {.views = std::span(&view, 1), .lights = lights, .ids = ids, .moved = moved, .budget_texels = budget})
            .value();
    for (const lamp::ShadowRedraw& redraw : frame.redraws) ++drawn[ids[redraw.light]];
    for (const shared::RadialJob& job : frame.radial_jobs) bounds[job.light] = {ids[job.light], drawn[ids[job.light]]};
    for (std::uint32_t i = 0; i < ids.size(); ++i) {
      if (frame.maps[i].kind == shared::SHADOW_NONE) continue;
      ASSERT_EQ(bounds[i], std::make_pair(ids[i], drawn[ids[i]])) << "frame " << number << ", index " << i;
    }
    kept += ids.size() - frame.radial_jobs.size();
  }
  EXPECT_GT(kept, 0U);
}

}  // namespace
