// Properties of light bounds and volume tests: what a light reaches is never rejected, what is clearly outside always.
// Random cases from fixed seeds; reach and positions in double precision, by the oracle; pairs in its boundary band are
// skipped.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "gpu/dispatch.h"
#include "gpu/random_volumes.h"
#include "oracle/reference.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t BATCH = 1U << 17;
constexpr std::uint32_t VIEWS = 512;

/// Cases of one batch and the device's answers.
struct Batch {
  std::vector<View> views;
  std::vector<RandomTile> tiles;
  std::vector<shared::Light> lights;
  std::vector<shared::VolumeAnswer> answers;

  [[nodiscard]] const View& view(std::size_t i) const { return views[tiles[i].volume.frame]; }
};

enum class Lights : std::uint8_t { reaching, around };

Batch draw(std::uint32_t seed, Lights kind) {
  RandomVolumes random(seed);
  Batch batch;
  for (std::uint32_t i = 0; i < VIEWS; ++i) batch.views.push_back(random.view());
  for (std::uint32_t i = 0; i < BATCH; ++i) {
    const View& view = batch.views[i % VIEWS];
    RandomTile tile = random.tile(view);
    tile.volume.frame = i % VIEWS;
    batch.lights.push_back(pack(kind == Lights::reaching ? random.light_reaching(view, tile.position_world)
                                                         : random.light_around(tile.position_world)));
    batch.tiles.push_back(tile);
  }
  return batch;
}

void ask(Batch& batch) {
  std::vector<shared::Frame> frames;
  for (const View& view : batch.views) frames.push_back(view.frame(0, 0));
  std::vector<shared::VolumeCase> cases;
  for (const RandomTile& tile : batch.tiles) cases.push_back(tile.volume);
  const vulkan::Buffer buffers[] = {host_buffer_of("frames", frames), host_buffer_of("cases", cases),
                                    host_buffer_of("lights", batch.lights),
                                    host_buffer("answers", cases.size() * sizeof(shared::VolumeAnswer))};
  Dispatch what{.shader = "volume_tests", .groups = {(BATCH + 63) / 64, 1, 1}};
  for (const vulkan::Buffer& buffer : buffers) what.resources.push_back(vulkan::Resource::storage(buffer.handle()));
  dispatch(what);
  batch.answers = contents<shared::VolumeAnswer>(buffers[3]);
}

std::string describe(const Batch& batch, std::size_t i) {
  const auto& [tile, light, answer] = std::tie(batch.tiles[i].volume, batch.lights[i], batch.answers[i]);
  const glm::dmat4& p = batch.view(i).clip_from_view();
  return fmt::format(
      "case {}: {} range {} outer {}; tile ({}, {})..({}, {}), depths {}..{}; m22 {} m23 {} m32 {} m33 {}; touches {}, "
      "center {} {} {} radius {}",
      i, light.type == shared::LIGHT_SPOT ? "spot" : "point", light.range, light.outer_angle, tile.min_px.x,
      tile.min_px.y, tile.max_px.x, tile.max_px.y, tile.nearest, tile.farthest, p[2][2], p[2][3], p[3][2], p[3][3],
      answer.touches, answer.bounds.center.x, answer.bounds.center.y, answer.bounds.center.z, answer.bounds.radius);
}

glm::dvec3 in_view(const View& view, const glm::dvec3& world) {
  return glm::dvec3(glm::dmat4(view.view_from_world()) * glm::dvec4(world, 1.0));
}

/// How far 32-bit arithmetic may blur positions of this case, m.
double blur(const Batch& batch, std::size_t i) {
  const View& view = batch.view(i);
  return 1e-5 * (glm::length(glm::dvec3(batch.lights[i].position)) +
                 glm::length(glm::dvec3(glm::dmat4(view.world_from_view())[3])) +
                 glm::length(glm::dvec3(batch.answers[i].bounds.center)));
}

/// Signed distance to the nearest of a tile's four sides, positive inside.
double side_distance(const View& view, const shared::VolumeCase& tile, const glm::dvec3& point) {
  const glm::dvec2 low(tile.min_px);
  const glm::dvec2 high(tile.max_px);
  const glm::dvec2 corners[] = {low, {high.x, low.y}, high, {low.x, high.y}};
  const glm::dvec3 inside = view.view_position((low + high) * 0.5, 1.5);
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 4; ++i) {
    const glm::dvec3 a = view.view_position(corners[i], 1.0);
    const glm::dvec3 b = view.view_position(corners[(i + 1) % 4], 1.0);
    glm::dvec3 normal = glm::normalize(glm::cross(b - a, glm::dvec3(view.view_position(corners[i], 2.0)) - a));
    if (glm::dot(normal, inside - a) < 0.0) normal = -normal;
    least = std::min(least, glm::dot(normal, point - a));
  }
  return least;
}

class VolumeTests : public GpuTest, public ::testing::WithParamInterface<std::uint32_t> {};

TEST_P(VolumeTests, WhatALightReachesIsNeverRejected) {
  Batch batch = draw(GetParam(), Lights::reaching);
  ask(batch);
  std::uint32_t checked = 0;
  for (std::size_t i = 0; i < BATCH; ++i) {
    const glm::dvec3& position = batch.tiles[i].position_world;
    if (reach(batch.lights[i], position) != Reach::inside) continue;
    ++checked;
    const shared::LightBounds& bounds = batch.answers[i].bounds;
    ASSERT_LE(glm::length(in_view(batch.view(i), position) - glm::dvec3(bounds.center)), bounds.radius)
        << describe(batch, i);
    ASSERT_EQ(batch.answers[i].touches, shared::TOUCHES_SIDES | shared::TOUCHES_DEPTHS | shared::TOUCHES_BOX)
        << describe(batch, i);
  }
  EXPECT_GT(checked, BATCH / 10 * 8);
}

/// The smallest sphere around a point light or around a spot's cone with its cap.
double smallest_radius(const shared::Light& light) {
  if (light.type == shared::LIGHT_POINT) return light.range;
  const bool slim = light.outer_angle <= std::numbers::pi / 4.0;
  return slim ? light.range / (2.0 * std::cos(light.outer_angle)) : light.range * std::sin(light.outer_angle);
}

TEST_P(VolumeTests, WhatIsClearlyOutsideIsAlwaysRejected) {
  Batch batch = draw(GetParam() + 1000, Lights::around);
  ask(batch);
  std::uint32_t beside = 0;
  std::uint32_t before_or_behind = 0;
  for (std::size_t i = 0; i < BATCH; ++i) {
    const View& view = batch.view(i);
    const shared::VolumeCase& tile = batch.tiles[i].volume;
    const shared::LightBounds& bounds = batch.answers[i].bounds;
    ASSERT_LE(bounds.radius, (1.0001 + view.stretch()) * smallest_radius(batch.lights[i]) + blur(batch, i))
        << describe(batch, i);
    const double clearly = 1.001 * bounds.radius + blur(batch, i);
    if (side_distance(view, tile, bounds.center) < -clearly) {
      ++beside;
      ASSERT_EQ(batch.answers[i].touches & shared::TOUCHES_SIDES, 0) << describe(batch, i);
    }
    const double z = -bounds.center.z;
    const double z_near = view.z_view(tile.nearest);
    const double z_far = view.z_view(tile.farthest);
    if (z + clearly < z_near - 1e-5 * std::abs(z_near) || z - clearly > z_far + 1e-5 * std::abs(z_far)) {
      ++before_or_behind;
      ASSERT_EQ(batch.answers[i].touches & (shared::TOUCHES_DEPTHS | shared::TOUCHES_BOX), 0) << describe(batch, i);
    }
  }
  EXPECT_GT(beside, BATCH / 3);
  EXPECT_GT(before_or_behind, BATCH / 3);
}

INSTANTIATE_TEST_SUITE_P(Seeds, VolumeTests, ::testing::Range(1U, 17U));

}  // namespace
}  // namespace lamp::app
