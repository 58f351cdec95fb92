// Moments of shadow maps against a blur on the CPU of the same depths, square by square.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <functional>

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
  CpuBlur(ShadowFilter filter, const std::vector<float>& depths, const ShadowMap& map, std::uint32_t square)
      : filter_(filter),
        depths_(depths),
        map_(map),
        corner_(glm::ivec2(map.squares[square] & 0xffffU, map.squares[square] >> 16U) * 16) {}

  static double weight(int tap) {
    constexpr std::array WEIGHTS{0.0162162162, 0.0540540541, 0.1216216216, 0.1945945946, 0.2270270270,
                                 0.1945945946, 0.1216216216, 0.0540540541, 0.0162162162};
    return WEIGHTS[static_cast<std::size_t>(tap) + 4];
  }
  [[nodiscard]] glm::dvec4 at(const glm::ivec2& texel) const {
    const int step = map_.side >= 64 ? 3 : map_.side >= 32 ? 1 : 0;
    glm::dvec4 sum(0.0);
    for (int y = -4; y <= 4; ++y)
      for (int x = -4; x <= 4; ++x)
        // Lines are blurred first, and what lies beyond an edge is looked up then: y, then x.
        sum += weight(x) * weight(y) *
               moments(folded(folded(texel + glm::ivec2(0, y * step)) +
                              glm::ivec2(turn(texel.y + y * step) * x * step, 0)));
    return sum;
  }

  /// Of one texel: vsm has two.
  [[nodiscard]] glm::dvec4 moments(const glm::ivec2& texel) const {
    const glm::ivec2 at = corner_ + texel;
    const double stored = depths_[static_cast<std::size_t>(at.y) * ATLAS + static_cast<std::size_t>(at.x)];
    const double longest = double{map_.range_m} * (map_.kind == shared::SHADOW_OCTAHEDRON ? std::sqrt(3.0) : 1.0);
    const double w = stored > 0.0 ? double{map_.near_m} / stored : 1e30;
    const bool is_endless = longest >= shared::INFINITE_RADIUS;
    const double unit = !is_endless ? std::min(w / longest, 1.0) : stored > 0.0 ? w / (w + 10.0) : 1.0;
    if (filter_ == ShadowFilter::vsm) return {unit, unit * unit, 0.0, 0.0};
    const double far = std::exp(40.0 * (2.0 * unit - 1.0));
    const double near = -std::exp(-5.0 * (2.0 * unit - 1.0));
    return {far, far * far, near, near * near};
  }

 private:
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
  ShadowFilter filter_;
  const std::vector<float>& depths_;
  const ShadowMap& map_;
  glm::ivec2 corner_;
};

/// The blur of one square by the article's indices: a line of 256 texels is a block of 16 x 16.
class CpuListing {
 public:
  CpuListing(const CpuBlur& blur, int side) : side_(side), step_(side >= 64 ? 3 : side >= 32 ? 1 : 0) {
    for (int y = 0; y < side; ++y)
      for (int x = 0; x < side; ++x) texels_.push_back(blur.moments({x, y}));
    pass({1, 0});
    pass({0, 1});
  }
  [[nodiscard]] glm::dvec4 at(const glm::ivec2& t) const { return texels_[number_of(t)]; }

 private:
  [[nodiscard]] std::size_t number_of(const glm::ivec2& texel) const {
    const glm::ivec2 t = glm::clamp(texel, glm::ivec2(0), glm::ivec2(side_ - 1));
    return static_cast<std::size_t>(t.y) * static_cast<std::size_t>(side_) + static_cast<std::size_t>(t.x);
  }
  void pass(const glm::ivec2& along) {
    std::vector<glm::dvec4> blurred;
    for (int y = 0; y < side_; ++y)
      for (int x = 0; x < side_; ++x) {
        const glm::ivec2 first = glm::ivec2(x, y) / 16 * 16;
        glm::dvec4 sum(0.0);
        for (int tap = 0; tap < 9; ++tap) {
          const int entry = y % 16 * 16 + x % 16 + tap * step_;  // of the line
          const glm::ivec2 behind = entry < 256 ? glm::ivec2(0) : 256 * along;
          const glm::ivec2 start = glm::ivec2(entry % 16, entry % 256 / 16) - 4 * step_ * along;
          sum += CpuBlur::weight(tap - 4) * texels_[number_of(first + start + behind)];
        }
        blurred.push_back(sum);
      }
    texels_ = blurred;
  }

  int side_;
  int step_;
  std::vector<glm::dvec4> texels_;
};

class BlurOfMoments : public GpuTest {
 protected:
  /// Draws and blurs maps of lights with all sizes of squares, and has `check` look at every square.
  static void blur(const ShadowSettings& settings,
                   const std::function<void(const CpuBlur& blur, int side,
                                            const std::function<glm::dvec4(const glm::ivec2&)>& found)>& check) {
    const TestScene& scene = builtin_test_scene("corridor");
    const View view = view_of(scene.scene.cameras.front(), 160, 90, "camera");
    const std::vector<shared::Light> lights = pack(std::vector<Light>{
        {.position = {4.0F, 1.5F, 0.3F}, .range = 6.0F},
        {.position = {8.0F, 2.5F, -0.3F}, .range = 3.0F},
        {.position = {5.0F, 2.0F, 0.0F}},
        {.position = {30.0F, 1.5F, 0.0F}, .range = 1.0F},
        {.type = LightType::spot, .position = {6.0F, 2.5F, 0.0F}, .range = 5.0F, .direction = {0.5F, -1.0F, 0.0F}}});
    Shadows shadows(test_context(), shader_library(), scene.gpu, settings, static_cast<std::uint32_t>(lights.size()));
    vulkan::AccessTracker tracker;
    shadows.schedule({&view, 1}, lights);
    ASSERT_GE(shadows.counts().shadowed, 4U);
    test_context().submit([&](VkCommandBuffer commands) {
      vulkan::Recorder recorder(test_context().device(), commands, tracker);
      shadows.record(recorder);
    });
    const std::vector<float> depths = read_image<float>(shadows.atlas(), tracker);
    const std::vector<glm::dvec4> moments = read_moments(settings.filter, shadows.moments()->image(), tracker);
    for (const ShadowMap& map : shadows.maps())
      for (std::uint32_t i = 0; map.kind != shared::SHADOW_NONE && i < (map.kind == shared::SHADOW_FACES ? 6U : 1U);
           ++i) {
        SCOPED_TRACE(fmt::format("side {}, square {}", map.side, i));
        const glm::ivec2 corner = glm::ivec2(map.squares[i] & 0xffffU, map.squares[i] >> 16U) * 16;
        check(CpuBlur(settings.filter, depths, map, i), static_cast<int>(map.side), [&](const glm::ivec2& t) {
          const glm::ivec2 at = corner + t;
          return moments[static_cast<std::size_t>(at.y) * ATLAS + static_cast<std::size_t>(at.x)];
        });
      }
  }
  static void expect_near(const glm::dvec4& found, const glm::dvec4& expected, const glm::ivec2& at,
                          double tolerance = 1e-6) {
    for (int i = 0; i < 4; ++i)
      ASSERT_NEAR(found[i], expected[i], tolerance * std::abs(expected[i])) << at.x << ", " << at.y << " moment " << i;
  }

 private:
  static std::vector<glm::dvec4> read_moments(ShadowFilter filter, const GpuImage& image,
                                              vulkan::AccessTracker& tracker) {
    std::vector<glm::dvec4> moments;
    if (filter == ShadowFilter::evsm)
      for (const glm::vec4& texel : read_image<glm::vec4>(image, tracker)) moments.emplace_back(texel);
    else
      for (const glm::vec2& texel : read_image<glm::vec2>(image, tracker)) moments.emplace_back(texel, 0.0, 0.0);
    return moments;
  }
};

class SquareBlur : public BlurOfMoments,
                   public ::testing::WithParamInterface<std::tuple<ShadowFilter, PointShadows, ShadowBlur>> {};

TEST_P(SquareBlur, IsThatOfTheSquareAlone) {
  const auto [filter, points, how] = GetParam();
  // A device's exp may be off by 3 + 2 |x| of the last places, and a depth's last place is 80 of the exponent's square.
  const double tolerance = filter == ShadowFilter::evsm ? 3e-5 : 1e-6;
  blur({.filter = filter, .points = points, .blur = how, .atlas_size = ATLAS},
       [&](const CpuBlur& blur, int side, const auto& found) {
         for (int y = 0; y < side; y += y < 16 ? 1 : 13)
           for (int x = 0; x < side; x += x < 16 ? 3 : 11)
             expect_near(found({x, y}), blur.at({x, y}), {x, y}, tolerance);
       });
}

INSTANTIATE_TEST_SUITE_P(Of, SquareBlur,
                         ::testing::Combine(::testing::Values(ShadowFilter::vsm, ShadowFilter::evsm),
                                            ::testing::Values(PointShadows::faces, PointShadows::octahedron),
                                            ::testing::Values(ShadowBlur::fused, ShadowBlur::lines)),
                         [](const auto& test) {
                           const bool vsm = std::get<ShadowFilter>(test.param) == ShadowFilter::vsm;
                           const bool faces = std::get<PointShadows>(test.param) == PointShadows::faces;
                           const bool fused = std::get<ShadowBlur>(test.param) == ShadowBlur::fused;
                           return std::string(vsm ? "vsm_" : "evsm_") + (faces ? "faces" : "octahedron") +
                                  (fused ? "_fused" : "_lines");
                         });

// What the article's listing does, so that its picture can be shown: lines of a block run into one another.
TEST_F(BlurOfMoments, ByTheListingMixesLines) {
  int differ = 0;
  blur({.filter = ShadowFilter::vsm, .blur = ShadowBlur::listing, .atlas_size = ATLAS},
       [&](const CpuBlur& blur, int side, const auto& found) {
         const CpuListing listing(blur, side);
         for (int y = 0; y < side; y += 3)
           for (int x = 0; x < side; x += 7) {
             expect_near(found({x, y}), listing.at({x, y}), {x, y});
             differ += std::abs(listing.at({x, y}).x - blur.at({x, y}).x) > 0.01 ? 1 : 0;
           }
       });
  EXPECT_GT(differ, 100);
}

}  // namespace
}  // namespace lamp::app
