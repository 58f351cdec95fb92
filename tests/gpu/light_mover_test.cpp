// Lights that the GPU moves along their paths: all bytes are those that the CPU makes for the frame.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstring>
#include <limits>

#include "gpu/dispatch.h"
#include "gpu/test_scenes.h"
#include "gpu/transfer.h"
#include "lamplight/light.h"
#include "render/light_mover.h"
#include "render/pass_uses.h"
#include "scene/flight.h"
#include "scene/place_lights.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t LIGHTS = 3000;
constexpr std::uint32_t OF_SCENE = 2;  // before those that move

struct Records {
  std::vector<shared::Light> lights;
  std::vector<shared::LightSphere> spheres;
};

template <class T>
bool same_bytes(const std::vector<T>& a, const std::vector<T>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(T)) == 0;
}

Records on_cpu(std::span<const shared::Light> of_scene, std::span<const Light> placed) {
  Records made{.lights = {of_scene.begin(), of_scene.end()}, .spheres = {}};
  const std::vector<shared::Light> packed = pack(placed);
  made.lights.insert(made.lights.end(), packed.begin(), packed.end());
  made.spheres = bounding_spheres(made.lights);
  return made;
}

class OnGpu {
 public:
  OnGpu(const View& view, std::span<const shared::Light> lights, std::span<const LightPath> paths)
      : data_(test_context().device(), static_cast<std::uint32_t>(lights.size())),
        mover_(test_context(), shader_library(), lights, paths, OF_SCENE) {
    data_.set({&view, 1}, lights);
  }

  Records at(const PathTime& time) {
    const std::size_t count = data_.records().size();
    const vulkan::Buffer lights = readback_buffer(test_context().device(), "lights", count * sizeof(shared::Light));
    const vulkan::Buffer spheres =
        readback_buffer(test_context().device(), "spheres", count * sizeof(shared::LightSphere));
    test_context().submit([&](VkCommandBuffer commands) {
      vulkan::Recorder recorder(test_context().device(), commands, tracker_);
      data_.record_upload(recorder);
      mover_.record(recorder, data_, time);
      copy(recorder, data_.lights(), lights);
      copy(recorder, data_.spheres(), spheres);
    });
    tracker_.forget(lights.handle());
    tracker_.forget(spheres.handle());
    return {.lights = first_values<shared::Light>(lights, count),
            .spheres = first_values<shared::LightSphere>(spheres, count)};
  }

 private:
  static void copy(vulkan::Recorder& recorder, const vulkan::Resource& from, const vulkan::Buffer& to) {
    recorder.barrier({copies_from(from), copies_to(vulkan::Resource::storage(to.handle()))});
    const VkBufferCopy all{.size = to.bytes()};
    vkCmdCopyBuffer(recorder.commands(), from.buffer, to.handle(), 1, &all);
    recorder.barrier({host_reads(vulkan::Resource::storage(to.handle()))});
  }

  FrameData data_;
  LightMover mover_;
  vulkan::AccessTracker tracker_;
};

class LightMovers : public GpuTest, public ::testing::WithParamInterface<float> {};

TEST_P(LightMovers, MoveThemAsTheCpuDoes) {
  const TestScene& scene = builtin_test_scene("atrium");
  const View view = view_of(find_camera(scene.scene, ""), 8, 8, "camera");
  PlaceLights how{.count = LIGHTS, .still = 0.1F, .min_range = GetParam(), .max_range = GetParam(), .frames = 97};
  const PlacedLights placed = place_on_paths(scene.air, how);
  const std::vector<shared::Light> of_scene(OF_SCENE, pack(placed.lights.front()));
  const Records before = on_cpu(of_scene, placed.lights);
  OnGpu gpu(view, before.lights, placed.paths);
  std::size_t moved = 0;
  for (how.frame = 0; how.frame <= how.frames; how.frame += 7) {
    const Records cpu = on_cpu(of_scene, place_lights(scene.air, how));
    const Records found = gpu.at(path_time(how.frame, how.frames));
    ASSERT_TRUE(same_bytes(cpu.lights, found.lights)) << "frame " << how.frame;
    ASSERT_TRUE(same_bytes(cpu.spheres, found.spheres)) << "frame " << how.frame;
    for (std::size_t i = 0; i < cpu.lights.size(); ++i)
      moved += cpu.lights[i].position != before.lights[i].position ? 1 : 0;
  }
  EXPECT_GT(moved, LIGHTS);
}

INSTANTIATE_TEST_SUITE_P(Of, LightMovers, ::testing::Values(0.0F, std::numeric_limits<float>::infinity()),
                         [](const auto& test) { return test.param == 0.0F ? "Range" : "NoRange"; });

/// What reaches nothing has no sphere around it, wherever it goes.
using DarkLights = GpuTest;

TEST_F(DarkLights, KeepTheirSpheres) {
  const View view = view_of(Camera{}, 8, 8, "camera");
  std::vector<shared::Light> lights(OF_SCENE + 1);
  OnGpu gpu(view, lights, std::vector<LightPath>{resting_at({1.0F, 2.0F, 3.0F})});
  const Records found = gpu.at({});
  EXPECT_EQ(found.lights.back().position, Vec3(1.0F, 2.0F, 3.0F));
  EXPECT_EQ(found.spheres.back().center, Vec3());
  EXPECT_LT(found.spheres.back().radius, 0.0F);
}

}  // namespace
}  // namespace lamp::app
