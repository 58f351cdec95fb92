// Several views in one frame, as two eyes, faces of a cube or players have them: what a look-up says of each is what a
// plan for one view says of it, light by light, in GLSL and in HLSL, for every look-up.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <random>

#include "gpu/engine_frame.h"
#include "gpu/lookup_cases.h"
#include "gpu/made_up_frame.h"
#include "gpu/test_scenes.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t WORDS = 11;  // of a pixel, in walks.comp
constexpr glm::uvec2 LARGEST(85, 53);

struct Eye {
  glm::uvec2 size;
  double turned = 0.0;  ///< radians, about the vertical
};
/// Of different sizes, canted; the last looks back.
constexpr Eye EYES[] = {{{85, 40}, 0.2}, {LARGEST, -0.2}, {{17, 53}, 3.0}};
constexpr std::uint32_t VIEWS = std::size(EYES);

/// All around.
std::vector<shared::Light> lights_around() {
  std::mt19937 random(1);
  const auto unit = [&] { return static_cast<double>(random()) / 4294967296.0; };
  std::vector<Light> lights(LOOKUP_LIGHTS);
  for (Light& light : lights) {
    const double angle = 6.2831853 * unit();
    const double distance = 1.0 + 9.0 * unit();
    light.position = glm::vec3{distance * std::sin(angle), 4.0 * unit() - 2.0, distance * std::cos(angle)};
    light.range = static_cast<float>(0.3 + 1.5 * unit());
    if (unit() < 0.7) continue;
    light.type = LightType::spot;
    light.direction = glm::vec3{unit() - 0.5, unit() - 0.5, unit() - 0.5};
    light.outer_angle = static_cast<float>(0.1 + unit());
  }
  return pack(lights);
}

class FrameViews : public GpuTest, public ::testing::WithParamInterface<LookUpCase> {
 protected:
  void SetUp() override {
    const std::vector<shared::Light> lights = lights_around();
    host_lights_ = lights;
    lights_ = host_buffer_of("lights", lights);
    spheres_ = host_buffer_of("spheres", bounding_spheres(lights));
    for (std::uint32_t i = 0; i < VIEWS; ++i) {
      records_.push_back(made_up_view(EYES[i].size, EYES[i].turned).frame(LOOKUP_LIGHTS, LOOKUP_LIGHTS));
      images_.push_back(depth_image(EYES[i].size.x, EYES[i].size.y, made_up_depths(EYES[i].size, 7 * i)));
      depths_.push_back(images_.back().sampled());
    }
  }

  [[nodiscard]] vulkan::PlanRunner runner(std::uint32_t views) const {
    Problem problem = problem_of(GetParam(), LARGEST);
    problem.views = views;
    Plan plan = take(make_plan(*take(find_method(GetParam().method)), problem));
    EXPECT_EQ(plan.lookup.name, GetParam().lookup);
    return take(vulkan::PlanRunner::create(test_context().device(), std::move(plan), shader_library().source()));
  }

  /// Words of `shader` for the views `first` .. `first + count - 1`, which are those of the runner's plan.
  [[nodiscard]] std::vector<std::vector<std::uint32_t>> words(const std::string& shader, vulkan::PlanRunner& runner,
                                                              std::uint32_t first, std::uint32_t count) const {
    const vulkan::Buffer frames = frame_buffer(first, count);
    vulkan::PlanInputs inputs{.frame = frames.handle(),
                              .lights = lights_.handle(),
                              .spheres = spheres_.handle(),
                              .depth = depths_[first],
                              .host_lights = host_lights_,
                              .host_frame = &records_[first]};
    if (count > 1) inputs.depths = std::span(depths_).subspan(first, count);
    const vulkan::BoundLookUp lookup = runner.lookup(inputs);
    std::vector<vulkan::Pipeline> pipelines;
    std::vector<vulkan::Buffer> found;
    for (std::uint32_t view = 0; view < count; ++view) {
      pipelines.push_back(walks(shader, lookup, view));
      const glm::uvec2 size = EYES[first + view].size;
      found.push_back(host_buffer("words", std::size_t{size.x} * size.y * WORDS * sizeof(std::uint32_t)));
    }
    test_context().submit([&](VkCommandBuffer commands) {
      vulkan::AccessTracker tracker;
      for (const vulkan::Resource& depth : depths_) tracker.assume(depth);
      vulkan::Recorder recorder(test_context().device(), commands, tracker);
      static_cast<void>(take(runner.record(recorder, inputs)));
      recorder.barrier(lookup.buffer_uses(VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT));
      for (std::uint32_t view = 0; view < count; ++view) {
        std::vector<vulkan::Bound> bound = lookup.resources;
        constexpr VkDeviceSize RECORD = sizeof(shared::Frame);
        bound.push_back({0, vulkan::Resource::storage({frames.handle(), view * RECORD, RECORD})});
        bound.push_back({1, vulkan::Resource::storage(found[view].handle())});
        recorder.bind(pipelines[view], bound);
        vkCmdDispatch(commands, LARGEST.x / 8 + 1, LARGEST.y / 8 + 1, 1);
      }
      recorder.order(VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_2_HOST_BIT);
    });
    std::vector<std::vector<std::uint32_t>> all;
    for (const vulkan::Buffer& buffer : found) all.push_back(contents<std::uint32_t>(buffer));
    return all;
  }

 private:
  [[nodiscard]] vulkan::Buffer frame_buffer(std::uint32_t first, std::uint32_t count) const {
    vulkan::Buffer buffer = take(vulkan::Buffer::create(
        test_context().device(), {.name = "frames",
                                  .bytes = count * sizeof(shared::Frame),
                                  .usage = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT | VK_BUFFER_USAGE_UNIFORM_BUFFER_BIT,
                                  .memory = vulkan::MemoryUse::upload}));
    std::memcpy(buffer.mapped().data(), &records_[first], count * sizeof(shared::Frame));
    return buffer;
  }

  static vulkan::Pipeline walks(const std::string& shader, const vulkan::BoundLookUp& lookup, std::uint32_t view) {
    vulkan::PipelineInfo info{.name = shader, .constants = lookup.constants, .bindings = {{0}, {1}}};
    for (const auto& [id, value] : {std::pair(0U, 8U), {1U, 8U}, {2U, view}}) info.constants.push_back({id, value});
    for (const vulkan::Bound& bound : lookup.resources) info.bindings.push_back({bound.binding, bound.resource.type});
    return take(
        vulkan::Pipeline::compute(test_context().device(), info, test_shader(shader + "@" + std::string(lookup.name))));
  }

  std::vector<shared::Light> host_lights_;
  vulkan::Buffer lights_, spheres_;
  std::vector<shared::Frame> records_;
  std::vector<GpuImage> images_;
  std::vector<vulkan::Resource> depths_;
};

TEST_P(FrameViews, AreWalkedAsFramesOfTheirOwn) {
  vulkan::PlanRunner together = runner(VIEWS);
  vulkan::PlanRunner alone = runner(1);
  const auto glsl = words("walks", together, 0, VIEWS);
  const auto hlsl = words("walks.hlsl", together, 0, VIEWS);
  for (std::uint32_t view = 0; view < VIEWS; ++view) {
    SCOPED_TRACE(view);
    const std::vector<std::uint32_t> own = words("walks", alone, view, 1).front();
    EXPECT_TRUE(std::ranges::any_of(own, [](std::uint32_t word) { return word != 0; }));
    const std::size_t at = std::ranges::mismatch(glsl[view], own).in1 - glsl[view].begin();
    EXPECT_EQ(at, own.size()) << "pixel " << at / WORDS << ", word " << at % WORDS << " of walks.comp";
    EXPECT_EQ(hlsl[view], glsl[view]);
  }
}

/// Not those whose cells race for room in a list that is too short for all: which of them win differs from run to run.
std::vector<LookUpCase> steady_cases() {
  std::vector<LookUpCase> cases = lookup_cases();
  std::erase_if(cases, [](const LookUpCase& c) {
    return c.method != "clustered" && std::ranges::any_of(c.settings, [](const std::string& setting) {
             return setting.starts_with("mean_capacity=") || setting.starts_with("mean_bricks=");
           });
  });
  return cases;
}

INSTANTIATE_TEST_SUITE_P(Of, FrameViews, ::testing::ValuesIn(steady_cases()), [](const auto& test) {
  return test_name(fmt::format("{}_{}", test.param.lookup, test.index));
});

}  // namespace
}  // namespace lamp::app
