// Lights as hosts keep them: every layout gives what records of 64 bytes give, whatever lies between them.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <numbers>

#include "gpu/flying.h"

namespace lamp::app {
namespace {

constexpr VkDeviceSize PART = 256;  ///< bytes; a multiple of every device's minStorageBufferOffsetAlignment

/// Bytes of a host's, NaN wherever no light lies.
class HostBytes {
 public:
  explicit HostBytes(std::size_t bytes) : words_(bytes / 4, ~0U) {}
  template <class T>
  void put(std::size_t at, const T& record) {
    std::memcpy(words_.data() + at / 4, &record, sizeof(record));
  }
  [[nodiscard]] vulkan::Buffer buffer() const { return host_buffer_of("host lights", words_); }

 private:
  std::vector<std::uint32_t> words_;
};

/// A layout, and buffers that hold the lights so.
struct HostLights {
  const char* name = "";
  LightLayout layout;
  vulkan::Buffer light_buffer;
  vulkan::Buffer cone_buffer;
  VkDeviceSize part = 0;      ///< where descriptors begin
  bool cones_inside = false;  ///< the cones lie in the light buffer as well

  [[nodiscard]] vulkan::CullerFrame told(const EngineFrame& frame) const {
    vulkan::CullerFrame told = culler_frame(frame);
    told.lights = {light_buffer.handle(), part};
    told.cones = {cones_inside ? light_buffer.handle() : cone_buffer.handle(), part};
    return told;
  }
};

/// `put` writes light i at the place that it is told.
template <class Put>
vulkan::Buffer placed(const std::vector<shared::Light>& lights, VkDeviceSize part, const RecordPlaces& places,
                      std::size_t record, const Put& put) {
  HostBytes bytes(part + places.offset + (lights.size() - 1) * places.stride + record);
  for (std::size_t i = 0; i < lights.size(); ++i) put(bytes, part + places.offset + i * places.stride, lights[i]);
  return bytes.buffer();
}

HostLights records(const char* name, const std::vector<shared::Light>& lights, const RecordPlaces& places,
                   VkDeviceSize part) {
  return {.name = name,
          .layout = {.lights = places},
          .light_buffer = placed(lights, part, places, sizeof(shared::Light),
                                 [](HostBytes& bytes, std::size_t at, const auto& light) { bytes.put(at, light); }),
          .part = part};
}

/// What culling reads, in two buffers.
HostLights apart(const std::vector<shared::Light>& lights, LightForm form) {
  const RecordPlaces places{.stride = sizeof(shared::LightReach)};
  return {.name = form == LightForm::points ? "points" : "spots, in two buffers",
          .layout = {.form = form},
          .light_buffer =
              placed(lights, 0, places, 16,
                     [](HostBytes& bytes, std::size_t at, const auto& light) { bytes.put(at, light_reach(light)); }),
          .cone_buffer = placed(lights, 0, places, 16, [](HostBytes& bytes, std::size_t at, const auto& light) {
            bytes.put(at, light_cone(light));
          })};
}

/// Likewise, inside the host's own records.
HostLights inside(const std::vector<shared::Light>& lights) {
  constexpr RecordPlaces REACHES{.offset = 16, .stride = 80};
  constexpr RecordPlaces CONES{.offset = 64, .stride = 80};
  return {.name = "spots, inside larger records",
          .layout = {.form = LightForm::spots, .lights = REACHES, .cones = CONES},
          .light_buffer = placed(lights, PART, REACHES, 64,
                                 [](HostBytes& bytes, std::size_t at, const auto& light) {
                                   bytes.put(at, light_reach(light));
                                   bytes.put(at + CONES.offset - REACHES.offset, light_cone(light));
                                 }),
          .part = PART,
          .cones_inside = true};
}

class LightLayouts : public GpuTest {
 protected:
  static Masks masks(const CullerCandidate& candidate, const EngineFrame& frame, const HostLights& host,
                     bool brings_spheres = false) {
    vulkan::Culler culler =
        take(vulkan::Culler::create(test_context().device(), {.width = ENGINE_WIDTH,
                                                              .height = ENGINE_HEIGHT,
                                                              .light_capacity = ENGINE_LIGHTS,
                                                              .method = std::string(candidate.method),
                                                              .options = candidate.options,
                                                              .light_layout = host.layout,
                                                              .brings_spheres = brings_spheres}));
    return cull_and_walk(culler, frame, host.told(frame));
  }
};

/// Besides the rows: where else records are read.
std::vector<CullerCandidate> candidates() {
  std::vector<CullerCandidate> all = culler_candidates();
  all.push_back({"tiled", {"order=type"}});
  all.push_back({"lamplight", {"cells=list", "prune=pixel"}});
  all.push_back({"lamplight", {"cells=bits", "container=bits"}});
  all.push_back({"lamplight", {"depth=none", "cells=list"}});
  return all;
}

TEST_F(LightLayouts, GiveWhatRecordsGiveForEveryMethod) {
  const EngineFrame frame = engine_frame();
  const HostLights hosts[] = {records("records in a part of a buffer", frame.lights, {.stride = 64}, PART),
                              records("records behind something", frame.lights, {.offset = 48, .stride = 64}, 0),
                              records("records inside larger ones", frame.lights, {.offset = 16, .stride = 112}, PART),
                              apart(frame.lights, LightForm::spots), inside(frame.lights)};
  for (const CullerCandidate& candidate : candidates()) {
    const Masks expected = masks_alone(candidate, frame);
    for (const HostLights& host : hosts) {
      SCOPED_TRACE(fmt::format("{} {}: {}", candidate.method, fmt::join(candidate.options, " "), host.name));
      EXPECT_EQ(masks(candidate, frame, host), expected);
    }
  }
}

TEST_F(LightLayouts, OfPointsAlone) {
  EngineFrame frame = engine_frame();
  for (shared::Light& light : frame.lights) light.type = shared::LIGHT_POINT;
  frame.light_buffer = host_buffer_of("points", frame.lights);
  const HostLights host = apart(frame.lights, LightForm::points);
  for (const CullerCandidate& candidate : candidates()) {
    SCOPED_TRACE(fmt::format("{} {}", candidate.method, fmt::join(candidate.options, " ")));
    EXPECT_EQ(masks(candidate, frame, host), masks_alone(candidate, frame));
  }
}

TEST_F(LightLayouts, WithTheHostsSpheres) {
  const EngineFrame frame = engine_frame();
  for (const char* method : {"lamplight", "tiled", "tight"}) {
    SCOPED_TRACE(method);
    vulkan::Culler standard = take(engine_culler(method, {}, /* brings_spheres= */ true));
    EXPECT_EQ(masks({method, {}}, frame, apart(frame.lights, LightForm::spots), /* brings_spheres= */ true),
              cull_and_walk(standard, frame));
  }
}

// Masks tell little of how exact a cone is.
TEST_F(LightLayouts, AnglesAreExact) {
  constexpr float RIGHT_ANGLE = std::numbers::pi_v<float> / 2.0F;
  std::vector<float> angles{0.0F, 1e-30F, 1e-6F, std::nextafter(RIGHT_ANGLE, 0.0F), RIGHT_ANGLE};
  for (int i = 0; i < 4000; ++i) angles.push_back(RIGHT_ANGLE * static_cast<float>(i) / 4000.0F);
  const vulkan::Buffer given = host_buffer_of("angles", angles);
  const vulkan::Buffer answers = host_buffer("answers", angles.size() * sizeof(glm::vec2));
  dispatch({.shader = "half_angles",
            .resources = {vulkan::Resource::storage(given.handle()), vulkan::Resource::storage(answers.handle())},
            .groups = {(angles.size() + 63) / 64, 1, 1}});
  const std::vector<glm::vec2> found = contents<glm::vec2>(answers);
  constexpr double ROUNDING = 2.4e-7;  // two units in the last place, as a share
  for (std::size_t i = 0; i < angles.size(); ++i) {
    const double sine = std::sin(double{angles[i]});
    const double cosine = angles[i] >= RIGHT_ANGLE ? 0.0 : std::cos(double{angles[i]});
    EXPECT_NEAR(found[i].x, sine, ROUNDING * sine) << angles[i];
    EXPECT_NEAR(found[i].y, cosine, ROUNDING * cosine) << angles[i];
  }
}

}  // namespace
}  // namespace lamp::app
