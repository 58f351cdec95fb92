// Boxes that a Culler is told of: with boxes=shape it tests them by their shape, however the host keeps its records.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cstring>

#include "gpu/flying.h"
#include "gpu/test_scenes.h"
#include "lamplight/entity.h"
#include "oracle/reference.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t BOXES = 40;
constexpr RecordPlaces INSIDE{.offset = 16, .stride = 112};  // of a host's larger records

/// Thin boards around the places of the frame's last lights, in their stead.
struct Boarded {
  EngineFrame frame = engine_frame();
  std::vector<shared::OrientedBox> boards;
  std::vector<std::uint32_t> strided;

  Boarded() {
    const std::size_t first = frame.lights.size() - BOXES;
    for (std::size_t i = first; i < frame.lights.size(); ++i) {
      boards.push_back({.center = frame.lights[i].position,
                        .axis_x = {1.0F, 0.0F, 0.0F},
                        .axis_y = {0.0F, 1.0F, 0.0F},
                        .axis_z = {0.0F, 0.0F, 1.0F},
                        .half_extents = {0.02F, 1.5F, 0.05F}});
      frame.lights[i] = bounding_light(boards.back());
    }
    frame.light_buffer = host_buffer_of("records", frame.lights);
    strided.assign((INSIDE.offset + frame.lights.size() * INSIDE.stride) / 4, ~0U);
    for (std::size_t i = 0; i < frame.lights.size(); ++i)
      std::memcpy(strided.data() + (INSIDE.offset + i * INSIDE.stride) / 4, &frame.lights[i], sizeof(shared::Light));
  }
};

Masks masks_of(const Method& method, const Boarded& of, std::uint32_t told_boxes, bool is_strided) {
  vulkan::Culler culler = take(vulkan::Culler::create(
      test_context().device(), {.width = ENGINE_WIDTH,
                                .height = ENGINE_HEIGHT,
                                .light_capacity = ENGINE_LIGHTS,
                                .method = std::string(method.name),
                                .options = {"boxes=shape"},
                                .light_layout = {.lights = is_strided ? INSIDE : RecordPlaces{}}}));
  const vulkan::Buffer strided = host_buffer_of("host records", of.strided);
  vulkan::CullerFrame told = culler_frame(of.frame);
  told.box_count = told_boxes;
  told.spheres = {};
  if (is_strided) told.lights = {strided.handle()};
  return cull_and_walk(culler, of.frame, told);
}

void expect_no_box_missed(const Boarded& of, const Masks& masks) {
  const std::uint32_t first = static_cast<std::uint32_t>(of.frame.lights.size()) - BOXES;
  const Truth all = truth({.view = of.frame.view,
                           .depth = of.frame.depth,
                           .lights = std::span(of.frame.lights).first(first),
                           .rows = ENGINE_HEIGHT,
                           .boxes = of.boards});
  EXPECT_GT(all.lights.size(), 100U);
  for (std::size_t pixel = 0; pixel < masks.size(); ++pixel)
    for (std::uint32_t i = all.offsets[pixel]; i < all.offsets[pixel + 1]; ++i) {
      const std::uint32_t id = all.lights[i];
      EXPECT_TRUE(masks[pixel][static_cast<int>(id / 32)] >> id % 32 & 1U) << "pixel " << pixel << ", id " << id;
    }
}

class CullerBoxes : public GpuTest, public ::testing::WithParamInterface<const Method*> {};

TEST_P(CullerBoxes, AreTestedByTheirShapeWhereTheyAreCounted) {
  const Boarded of;
  const Masks spheres = masks_of(*GetParam(), of, 0, /* is_strided= */ false);
  const Masks shapes = masks_of(*GetParam(), of, BOXES, /* is_strided= */ false);
  expect_no_box_missed(of, shapes);
  EXPECT_LT(walked(shapes), walked(spheres));
  EXPECT_EQ(masks_of(*GetParam(), of, BOXES, /* is_strided= */ true), shapes);
}

std::vector<const Method*> methods_with_shapes() {
  std::vector<const Method*> found;
  for (const Method& method : methods())
    if (resolve_options(method, {"boxes=shape"}) && !method.approximate) found.push_back(&method);
  return found;
}

INSTANTIATE_TEST_SUITE_P(Of, CullerBoxes, ::testing::ValuesIn(methods_with_shapes()),
                         [](const auto& test) { return test_name(std::string(test.param->name)); });

TEST(CullerBoxCount, IsAtMostTheLightCount) {
  const EngineFrame frame = engine_frame();
  vulkan::Culler culler = take(engine_culler("clustered", {"boxes=shape"}));
  vulkan::CullerFrame told = culler_frame(frame);
  told.box_count = told.light_count + 1;
  const Commands commands([&](VkCommandBuffer buffer) {
    const auto recorded = culler.record(buffer, told);
    ASSERT_FALSE(recorded);
    EXPECT_EQ(recorded.error().text(),
              fmt::format("box count: expected at most {}, the light count, got {}", told.light_count, told.box_count));
    told.box_count = 5;
    told.probe_count = 6;
    const auto of_probes = culler.record(buffer, told);
    ASSERT_FALSE(of_probes);
    EXPECT_EQ(of_probes.error().text(), "probe count: expected at most 5, the box count, got 6");
  });
}

}  // namespace
}  // namespace lamp::app
