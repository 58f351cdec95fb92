// Moments of shadow maps against a blur on the CPU of the same depths, square by square.
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>

#include "gpu/dispatch.h"
#include "gpu/test_scenes.h"
#include "lamplight/light.h"
#include "render/shadows.h"
#include "scene/flight.h"

namespace lamp::app {
namespace {

using shared::ShadowMap;

constexpr std::uint32_t ATLAS = 512;

template <class Texel>
std::vector<Texel> read_image(const GpuImage& image, vulkan::AccessTracker& tracker) {
  const vulkan::Buffer buffer = host_buffer("read-back", std::uint64_t{ATLAS} * ATLAS * sizeof(Texel));
  test_context().submit([&](VkCommandBuffer commands) {
    vulkan::Recorder recorder(test_context().device(), commands, tracker);
    record_copy(recorder, image, buffer);
    recorder.barrier({host_reads(vulkan::Resource::storage(buffer.handle()))});
  });
  return contents<Texel>(buffer);
}

/// The blur of one square, tap by tap in double precision.
class CpuBlur {
 public:
  CpuBlur(const std::vector<float>& depths, const ShadowMap& map, std::uint32_t square)
      : depths_(depths),
        map_(map),
        corner_(glm::ivec2(map.squares[square] & 0xffffU, map.squares[square] >> 16U) * 16) {}

  [[nodiscard]] glm::dvec2 at(const glm::ivec2& texel) const {
    const int step = map_.side >= 64 ? 3 : map_.side >= 32 ? 1 : 0;
    glm::dvec2 sum(0.0);
    for (int y = -4; y <= 4; ++y)
      for (int x = -4; x <= 4; ++x)
        // Lines are blurred first, and what lies beyond an edge is looked up then: y, then x.
        sum += weight(x) * weight(y) *
               moments(folded(folded(texel + glm::ivec2(0, y * step)) +
                              glm::ivec2(turn(texel.y + y * step) * x * step, 0)));
    return sum;
  }

 private:
  static double weight(int tap) {
    constexpr std::array WEIGHTS{0.0162162162, 0.0540540541, 0.1216216216, 0.1945945946, 0.2270270270,
                                 0.1945945946, 0.1216216216, 0.0540540541, 0.0162162162};
    return WEIGHTS[static_cast<std::size_t>(tap) + 4];
  }
  /// Beyond the upper and lower edges of an octahedron lines run the other way.
  [[nodiscard]] int turn(int y) const {
    const int side = static_cast<int>(map_.side);
    return map_.kind == shared::SHADOW_OCTAHEDRON && (y < 0 || y >= side) ? -1 : 1;
  }
  [[nodiscard]] glm::ivec2 folded(glm::ivec2 t) const {
    const int side = static_cast<int>(map_.side);
    if (map_.kind == shared::SHADOW_OCTAHEDRON) {
      if (t.x < 0 || t.x >= side) t = {(t.x < 0 ? -1 : 2 * side - 1) - t.x, side - 1 - t.y};
      if (t.y < 0 || t.y >= side) t = {side - 1 - t.x, (t.y < 0 ? -1 : 2 * side - 1) - t.y};
    }
    return glm::clamp(t, glm::ivec2(0), glm::ivec2(side - 1));
  }
  [[nodiscard]] glm::dvec2 moments(const glm::ivec2& texel) const {
    const glm::ivec2 at = corner_ + texel;
    const double stored = depths_[static_cast<std::size_t>(at.y) * ATLAS + static_cast<std::size_t>(at.x)];
    const double longest = double{map_.range_m} * (map_.kind == shared::SHADOW_OCTAHEDRON ? std::sqrt(3.0) : 1.0);
    const double w = stored > 0.0 ? double{map_.near_m} / stored : 1e30;
    const double unit = std::isfinite(map_.range_m) ? std::min(w / longest, 1.0) : stored > 0.0 ? w / (w + 10.0) : 1.0;
    return {unit, unit * unit};
  }

  const std::vector<float>& depths_;
  const ShadowMap& map_;
  glm::ivec2 corner_;
};

class ShadowBlur : public GpuTest, public ::testing::WithParamInterface<PointShadows> {};

TEST_P(ShadowBlur, AreTheBlurOfTheirOwnSquare) {
  const TestScene& scene = builtin_test_scene("corridor");
  const View view = view_of(scene.scene.cameras.front(), 160, 90, "camera");
  const std::vector<shared::Light> lights = pack(std::vector<Light>{
      {.position = {4.0F, 1.5F, 0.3F}, .range = 6.0F},
      {.position = {8.0F, 2.5F, -0.3F}, .range = 3.0F},
      {.position = {5.0F, 2.0F, 0.0F}},
      {.position = {30.0F, 1.5F, 0.0F}, .range = 1.0F},
      {.type = LightType::spot, .position = {6.0F, 2.5F, 0.0F}, .range = 5.0F, .direction = {0.5F, -1.0F, 0.0F}}});
  Shadows shadows(test_context(), shader_library(), scene.gpu,
                  {.filter = ShadowFilter::vsm, .points = GetParam(), .atlas_size = ATLAS},
                  static_cast<std::uint32_t>(lights.size()));
  vulkan::AccessTracker tracker;
  shadows.schedule({&view, 1}, lights);
  ASSERT_GE(shadows.counts().shadowed, 4U);
  test_context().submit([&](VkCommandBuffer commands) {
    vulkan::Recorder recorder(test_context().device(), commands, tracker);
    shadows.record(recorder);
  });
  const std::vector<float> depths = read_image<float>(shadows.atlas(), tracker);
  const std::vector<glm::vec2> moments = read_image<glm::vec2>(shadows.moments()->image(), tracker);
  for (const ShadowMap& map : shadows.maps())
    for (std::uint32_t i = 0; map.kind != shared::SHADOW_NONE && i < (map.kind == shared::SHADOW_FACES ? 6U : 1U);
         ++i) {
      const CpuBlur blur(depths, map, i);
      const glm::ivec2 corner = glm::ivec2(map.squares[i] & 0xffffU, map.squares[i] >> 16U) * 16;
      for (int y = 0; y < static_cast<int>(map.side); y += y < 16 ? 1 : 13)
        for (int x = 0; x < static_cast<int>(map.side); x += x < 16 ? 3 : 11) {
          const glm::dvec2 expected = blur.at({x, y});
          const glm::dvec2 found(
              moments[static_cast<std::size_t>(corner.y + y) * ATLAS + static_cast<std::size_t>(corner.x + x)]);
          ASSERT_NEAR(found.x, expected.x, 2e-6 * expected.x)
              << map.side << ", square " << i << " at " << x << ", " << y;
          ASSERT_NEAR(found.y, expected.y, 4e-6 * expected.y);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Of, ShadowBlur, ::testing::Values(PointShadows::faces, PointShadows::octahedron),
                         [](const auto& test) { return test.param == PointShadows::faces ? "faces" : "octahedron"; });

}  // namespace
}  // namespace lamp::app
