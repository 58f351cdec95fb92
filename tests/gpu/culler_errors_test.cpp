// What a Culler refuses: what it is made for, and what a host says of a frame. Refused frames record nothing.
// SPDX-License-Identifier: Apache-2.0
#include "gpu/engine_frame.h"
#include "lamplight/method.h"

namespace lamp::app {
namespace {

class CullerErrors : public GpuTest {};

void expect_error(const vulkan::CullerInfo& info, std::initializer_list<const char*> parts) {
  const auto culler = vulkan::Culler::create(test_context().device(), info);
  ASSERT_FALSE(culler.ok());
  for (const char* part : parts)
    EXPECT_NE(culler.error().text().find(part), std::string::npos) << part << " in: " << culler.error().text();
}

TEST_F(CullerErrors, OfCreationNameWhatIsWrong) {
  const vulkan::CullerInfo good{
      .width = ENGINE_WIDTH, .height = ENGINE_HEIGHT, .light_capacity = ENGINE_LIGHTS, .method = "tiled"};
  EXPECT_TRUE(vulkan::Culler::create(test_context().device(), good).ok());
  vulkan::CullerInfo info = good;
  info.method = "tield";
  expect_error(info, {"tield", "tiled"});
  info = good;
  info.options = {"tyle=16"};
  expect_error(info, {"tyle", "tile"});
  info.options = {"tile=17"};
  expect_error(info, {"tile", "17", "16"});
  info = good;
  info.width = 0;
  expect_error(info, {"0x51", "expected 1 to"});
  info.width = 1U << 20;
  expect_error(info, {"1048576x51", "expected 1 to"});
  info = good;
  info.light_capacity = MAX_LIGHTS + 1;
  expect_error(info, {"light capacity", std::to_string(MAX_LIGHTS).c_str()});
  info = good;
  info.readers = 0;
  expect_error(info, {"readers", "expected the stages"});
  info = good;
  info.frames_in_flight = MAX_FRAMES_IN_FLIGHT + 1;
  expect_error(info, {"frames in flight", "expected 1 to 4, got 5"});
}

TEST_F(CullerErrors, OfLightLayoutsNameTheNumber) {
  vulkan::CullerInfo info{
      .width = ENGINE_WIDTH, .height = ENGINE_HEIGHT, .light_capacity = ENGINE_LIGHTS, .method = "tiled"};
  const auto with = [&](const LightLayout& layout, std::initializer_list<const char*> parts) {
    info.light_layout = layout;
    expect_error(info, parts);
  };
  with({.lights = {.stride = 72}}, {"light stride: expected a multiple of 16 bytes, at least 64, got 72"});
  with({.lights = {.stride = 48}}, {"light stride: expected a multiple of 16 bytes, at least 64, got 48"});
  with({.lights = {.offset = 8}}, {"light offset: expected a multiple of 16 bytes, got 8"});
  with({.form = LightForm::spots, .cones = {.offset = 20}}, {"cone offset: expected a multiple of 16 bytes, got 20"});
  with({.form = LightForm::spots, .cones = {.stride = 8}}, {"cone stride: ", "at least 16, got 8"});
  with({.form = static_cast<LightForm>(3)}, {"light form: expected record, points or spots, got 3"});
  with({.form = LightForm::points, .lights = {.stride = 1U << 31}}, {"light buffer: needs 135291469840 bytes"});
}

/// Records into no command buffer at all: whoever records anything there does not come back.
std::string refusal(vulkan::Culler& culler, const vulkan::CullerFrame& frame) {
  const Result<std::uint64_t> recorded = culler.record(VK_NULL_HANDLE, frame);
  return recorded ? "nothing" : recorded.error().text();
}

std::uint64_t next_number(vulkan::Culler& culler, const vulkan::CullerFrame& frame) {
  std::uint64_t number = 0;
  test_context().submit([&](VkCommandBuffer commands) { number = take(culler.record(commands, frame)); });
  return number;
}

TEST_F(CullerErrors, OfFramesNameTheElementAndRecordNothing) {
  const EngineFrame frame = engine_frame({.lights = 20});
  const vulkan::CullerFrame good = culler_frame(frame);
  vulkan::Culler culler = take(engine_culler("tiled", {"spot=cone-sphere"}, /* brings_spheres= */ true));
  EXPECT_EQ(next_number(culler, good), 1);
  const auto with = [&](auto change) {
    vulkan::CullerFrame bad = good;
    change(bad);
    return refusal(culler, bad);
  };
  EXPECT_EQ(with([](auto& f) { f.view = nullptr; }), "view: expected the frame's camera, got none");
  const View larger = View::create(86, 51, frame.view.clip_from_view(), frame.view.view_from_world()).value();
  EXPECT_EQ(with([&](auto& f) { f.view = &larger; }),
            "size 86x51: expected 1x1 to 85x51 pixels, which the plan was made for");
  EXPECT_EQ(with([](auto& f) { f.light_count = 65; }),
            "light count: expected at most 64, the capacity that the plan was made for, got 65");
  EXPECT_EQ(with([](auto& f) { f.lights = VK_NULL_HANDLE; }),
            "lights: expected a buffer, which the method reads, got none");
  EXPECT_EQ(with([](auto& f) { f.spheres = VK_NULL_HANDLE; }),
            "spheres: expected a buffer, which the method reads, got none");
  EXPECT_EQ(with([](auto& f) { f.depth_image = VK_NULL_HANDLE; }),
            "depth image: expected an image, which the method reads, got none");
  EXPECT_EQ(with([](auto& f) { f.depth_view = VK_NULL_HANDLE; }),
            "depth view: expected a view of the depth image, got none");
  for (const VkImageLayout layout : {VK_IMAGE_LAYOUT_UNDEFINED, VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL})
    EXPECT_EQ(with([&](auto& f) { f.depth_layout = layout; }),
              fmt::format("depth layout: expected the layout that the image is in, one that shaders can read, such as "
                          "VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, got VkImageLayout {}",
                          static_cast<int>(layout)));
  EXPECT_EQ(with([](auto&) {}), "commands: expected a command buffer, got null");
  EXPECT_EQ(next_number(culler, good), 2);
}

TEST_F(CullerErrors, OfPartsOfBuffersNameTheNumber) {
  const EngineFrame frame = engine_frame({.lights = 20});
  const VkBuffer lights = frame.light_buffer.handle();
  vulkan::Device device = test_context().device();
  const auto culler_on = [&](std::uint32_t alignment) {
    device.traits.storage_offset_alignment = alignment;
    return take(vulkan::Culler::create(device, {.width = ENGINE_WIDTH,
                                                .height = ENGINE_HEIGHT,
                                                .light_capacity = ENGINE_LIGHTS,
                                                .method = "lamplight",
                                                .light_layout = {.form = LightForm::spots},
                                                .brings_spheres = true}));
  };
  vulkan::Culler fine = culler_on(4);
  vulkan::Culler coarse = culler_on(64);
  vulkan::CullerFrame told = culler_frame(frame);
  EXPECT_EQ(refusal(fine, told), "cones: expected a buffer, which the method reads, got none");
  told.cones = {frame.sphere_buffer.handle(), 24};
  EXPECT_EQ(refusal(fine, told), "cones offset: expected a multiple of 16 bytes, got 24");
  told.cones = {frame.sphere_buffer.handle(), 16};
  EXPECT_EQ(refusal(coarse, told),
            "cones offset: expected a multiple of 64 bytes, this device's minStorageBufferOffsetAlignment, got 16");
  told.lights = {lights, 0, 319};
  EXPECT_EQ(refusal(fine, told), "lights: expected a part of at least 320 bytes for what the shaders read, got 319");
  told.lights = {lights, 0, 320};
  told.spheres = {frame.sphere_buffer.handle(), 16, 319};
  EXPECT_EQ(refusal(fine, told), "spheres: expected a part of at least 320 bytes for what the shaders read, got 319");
  told.light_count = 0;
  told.spheres = {frame.sphere_buffer.handle(), 16, 0};
  EXPECT_EQ(refusal(fine, told), "spheres: expected a part of at least 1 bytes for what the shaders read, got 0");
}

TEST_F(CullerErrors, FewerHostLightsThanLights) {
  const EngineFrame frame = engine_frame({.lights = 20});
  vulkan::CullerFrame short_of_one = culler_frame(frame);
  short_of_one.host_lights = std::span(frame.lights).first(19);
  vulkan::Culler on_cpu = take(engine_culler("drobot-zbin", {"sort=cpu"}));
  EXPECT_EQ(refusal(on_cpu, short_of_one),
            "host lights: expected 20, as many as there are lights, since options of the method work on the CPU; "
            "got 19");
  EXPECT_EQ(next_number(on_cpu, culler_frame(frame)), 1);
  vulkan::Culler on_gpu = take(engine_culler("drobot-zbin"));
  EXPECT_EQ(next_number(on_gpu, short_of_one), 1) << "nobody reads them";
}

TEST_F(CullerErrors, OfCountsOnTheGpuNameWhatIsWrong) {
  const EngineFrame frame = engine_frame({.lights = 20});
  const vulkan::Buffer counts = host_buffer_of<std::uint32_t>("counts", {20, 20});
  vulkan::CullerFrame counted = culler_frame(frame);
  counted.light_count_buffer = counts.handle();
  counted.light_count_offset = 4;
  vulkan::Culler on_gpu = take(engine_culler("drobot-zbin"));
  EXPECT_EQ(refusal(on_gpu, counted), "light count: expected 0 beside a buffer that holds the count, got 20");
  counted.light_count = 0;
  vulkan::Culler on_cpu = take(engine_culler("drobot-zbin", {"sort=cpu"}));
  EXPECT_EQ(refusal(on_cpu, counted),
            "light count buffer: expected light_count, since option sort=cpu works on the CPU, which knows no other");
  EXPECT_EQ(next_number(on_gpu, counted), 1);
  counted.light_count_offset = 6;
  EXPECT_EQ(refusal(on_gpu, counted), "light count offset: expected a multiple of 4 bytes, got 6");
}

// What a method does not read may be missing.
TEST_F(CullerErrors, NothingIsAskedForThatNobodyReads) {
  const EngineFrame frame = engine_frame({.lights = 20});
  vulkan::CullerFrame bare = culler_frame(frame);
  bare.spheres = VK_NULL_HANDLE;
  bare.host_lights = {};
  bare.depth_image = VK_NULL_HANDLE;
  bare.depth_view = VK_NULL_HANDLE;
  vulkan::Culler clustered = take(engine_culler("clustered"));
  EXPECT_EQ(next_number(clustered, bare), 1);
  bare.lights = VK_NULL_HANDLE;
  EXPECT_NE(refusal(clustered, bare), "nothing");
  vulkan::Culler with_spheres = take(engine_culler("clustered", {}, /* brings_spheres= */ true));
  bare.spheres = frame.sphere_buffer.handle();
  EXPECT_EQ(next_number(with_spheres, bare), 1);
  bare = culler_frame(frame);
  bare.lights = VK_NULL_HANDLE;
  vulkan::Culler spheres_alone = take(engine_culler("tiled", {}, /* brings_spheres= */ true));
  EXPECT_EQ(next_number(spheres_alone, bare), 1);
  vulkan::Culler all = take(engine_culler("all"));
  EXPECT_EQ(next_number(all, bare), 1);
}

TEST_F(CullerErrors, OfPlanInputsNameTheElement) {
  const EngineFrame frame = engine_frame({.lights = 20});
  const Plan plan = take(
      make_plan(*take(find_method("clustered")), {.width = ENGINE_WIDTH,
                                                  .height = ENGINE_HEIGHT,
                                                  .light_capacity = 30,
                                                  .options = take(resolve_options(*take(find_method("clustered")), {})),
                                                  .traits = test_context().device().traits,
                                                  .own_spheres = true}));
  const vulkan::PlanRunner runner = take(vulkan::PlanRunner::create(test_context().device(), plan));
  const vulkan::Buffer buffer = host_buffer("any", sizeof(shared::Frame));
  shared::Frame record = frame.view.frame(20, 30);
  vulkan::PlanInputs inputs{.frame = buffer.handle(), .lights = buffer.handle(), .host_frame = &record};
  const auto error = [&] {
    const std::optional<lamp::Error> found = runner.check(inputs);
    return found ? found->text() : "nothing";
  };
  EXPECT_EQ(error(), "nothing");
  record.light_capacity = 31;
  EXPECT_EQ(error(),
            "light capacity of the frame: expected at most 30, the capacity that the plan was made for, got 31");
  record.light_capacity = 19;
  EXPECT_EQ(error(), "light count: expected at most 19, the capacity of the frame, got 20");
  record.light_capacity = 30;
  record.box_count = 21;
  EXPECT_EQ(error(), "box count: expected at most 20, the light count, got 21");
  record.box_count = 0;
  inputs.frame = VK_NULL_HANDLE;
  EXPECT_EQ(error(), "frame: expected a buffer, which the method reads, got none");
  inputs.host_frame = nullptr;
  EXPECT_EQ(error(), "host frame: expected the frame's record, got none");
}

}  // namespace
}  // namespace lamp::app
