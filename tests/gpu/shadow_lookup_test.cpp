// Shadow look-ups in GLSL and in HLSL against each other, and against the same filters on the CPU.
// SPDX-License-Identifier: Apache-2.0
#include <array>
#include <cmath>

#include "gpu/dispatch.h"
#include "gpu/shaders/shadow_case.h"
#include "lamplight/light.h"
#include "lamplight/shadow_atlas.h"
#include "random.h"

namespace lamp::app {
namespace {

using shared::ShadowCase;
using shared::ShadowMap;

constexpr std::uint32_t ATLAS = 512;
constexpr std::uint32_t CASES = 64 * 256;

/// Maps of every kind, in squares that lie anywhere, and a light without one.
std::vector<ShadowMap> some_maps(ShadowFilter filter) {
  const Light point{.position = {1.0F, 2.0F, -3.0F}, .range = 8.0F};
  const Light spot{.type = LightType::spot,
                   .position = {-4.0F, 0.5F, 2.0F},
                   .range = 8.0F,
                   .direction = {0.2F, -1.0F, 0.5F},
                   .outer_angle = 0.7F};
  const auto map = [&](const Light& light, PointShadows points, std::uint32_t side, glm::uvec2 corner) {
    const ShadowAtlasInfo info{.size = ATLAS, .points = points, .filter = filter};
    std::vector<UVec2> corners;
    for (std::uint32_t i = 0; i < shadow_squares(pack(light), points); ++i)
      corners.emplace_back(corner + glm::uvec2(i % 3, i / 3) * side);
    return shadow_map(pack(light), info, side, corners);
  };
  return {map(point, PointShadows::faces, 64, {0, 0}),
          map(point, PointShadows::faces, 16, {192, 0}),
          map(point, PointShadows::octahedron, 128, {0, 128}),
          map(point, PointShadows::octahedron, 16, {256, 0}),
          map(spot, PointShadows::faces, 128, {128, 128}),
          map(spot, PointShadows::faces, 16, {272, 0}),
          ShadowMap{}};
}

std::vector<ShadowCase> some_cases(std::span<const ShadowMap> maps, test::Random& random) {
  std::vector<ShadowCase> cases(CASES);
  for (ShadowCase& c : cases) {
    c.light = random.below(static_cast<std::uint32_t>(maps.size()));
    c.position = glm::vec3(maps[c.light].position) + random.direction() * random.in(0.05F, 7.0F);
    c.normal = random.direction();
    c.seed = random.below(~0U);
  }
  cases[0] = {.position = maps[0].position, .light = 0, .normal = {0.0F, 1.0F, 0.0F}};
  return cases;
}

/// Depths at which about half of the cases are lit, smooth over some texels.
std::vector<float> some_depths(test::Random& random) {
  std::vector<float> depths(std::size_t{ATLAS} * ATLAS);
  for (std::uint32_t y = 0; y < ATLAS; ++y)
    for (std::uint32_t x = 0; x < ATLAS; ++x)
      depths[y * ATLAS + x] =
          0.01F / (3.0F + 2.0F * std::sin(0.4F * static_cast<float>(x)) * std::cos(0.3F * static_cast<float>(y))) *
          random.in(0.9F, 1.1F);
  return depths;
}

/// Moments of depths that are smooth from texel to texel, as a blur leaves them: mean and mean square, of plain depths
/// or of both warps.
std::vector<glm::vec4> some_moments(ShadowFilter filter, test::Random& random) {
  std::vector<glm::vec4> moments(std::size_t{ATLAS} * ATLAS);
  for (std::uint32_t i = 0; i < moments.size(); ++i) {
    const auto x = static_cast<float>(i % ATLAS);
    const auto y = std::floor(static_cast<float>(i) / static_cast<float>(ATLAS));
    const float mean = 0.45F + 0.2F * std::sin(0.21F * x) * std::cos(0.17F * y);
    const float deviation = random.in(0.0F, 0.05F);
    if (filter == ShadowFilter::evsm) {
      const float far = std::exp(40.0F * (2.0F * mean - 1.0F));
      const float near = -std::exp(-5.0F * (2.0F * mean - 1.0F));
      moments[i] = {far, far * far * (1.0F + deviation), near, near * near * (1.0F + deviation)};
    } else {
      moments[i] = {mean, mean * mean + deviation * deviation, 0.0F, 0.0F};
    }
  }
  return moments;
}

/// The filters, in double precision and written apart from the shaders. How far a place may be off by rounding decides
/// nothing in most cases; where it does, the answer is not asked for.
class Reference {
 public:
  Reference(std::span<const ShadowMap> maps, const std::vector<float>& depths, const std::vector<glm::vec4>& moments)
      : maps_(maps), depths_(depths), moments_(moments) {}

  [[nodiscard]] double shadow_of(const ShadowCase& c, ShadowFilter filter) const {
    const ShadowMap& map = maps_[c.light];
    if (map.kind == shared::SHADOW_NONE) return 1.0;
    const double radius = filter == ShadowFilter::hard                    ? 0.0
                          : filter == ShadowFilter::pcf && map.side >= 64 ? 2.0
                                                                          : 1.0;
    ShadowPlace place = shadow_place(map, c.position);
    if (!(place.w > 0.0F)) return 1.0;
    place = moved_place(map, place, c, radius + 0.75);
    if (!(place.w > 0.0F)) return 1.0;
    if (filter == ShadowFilter::hard) return is_lit(map, place, glm::dvec2(place.texel));
    if (filter == ShadowFilter::vsm) return by_moments(map, place);
    if (filter == ShadowFilter::evsm) return by_warps(map, place);
    double lit = 0.0;
    const double turn = angle_of(c.seed);
    for (int i = 0; i < 16; ++i) {
      const double angle = turn + i * (3.0 - std::sqrt(5.0)) * 3.14159265358979;
      const double from_middle = radius * std::sqrt((i + 0.5) / 16.0);
      lit += is_lit(map, place, glm::dvec2(place.texel) + from_middle * glm::dvec2(std::cos(angle), std::sin(angle)));
    }
    return lit / 16.0;
  }

 private:
  static glm::dvec3 axis_of(const ShadowMap& map, const ShadowPlace& place, const glm::dvec3& rel) {
    if (map.kind == shared::SHADOW_SPOT) return map.axis_z;
    if (map.kind == shared::SHADOW_OCTAHEDRON)
      return glm::normalize(glm::mix(glm::dvec3(1.0), glm::dvec3(-1.0), glm::lessThan(rel, glm::dvec3(0.0))));
    glm::dvec3 axis(0.0);
    axis[static_cast<int>(place.square / 2)] = place.square % 2 == 0 ? 1.0 : -1.0;
    return axis;
  }
  static double fold_of(const ShadowMap& map) { return map.kind == shared::SHADOW_OCTAHEDRON ? std::sqrt(3.0) : 1.0; }
  static double normal_offset(const ShadowMap& map, const glm::dvec3& axis, double w, const ShadowCase& c,
                              double reach) {
    const glm::dvec3 n(c.normal);
    const double along = glm::dot(n, axis);
    const double sine = std::max(std::sqrt(std::max(1.0 - along * along, 0.0)), 0.3);
    const double m = reach * fold_of(map) * sine / double{map.scale};
    const double a = std::abs(glm::dot(n, glm::dvec3(c.position) - glm::dvec3(map.position))) / w;
    return w * m * (2.0 * m < a ? a / (a - m) : 2.0);
  }
  /// By the offset that its face or octant asks for, and that the one asks for to which this moves it.
  static ShadowPlace moved_place(const ShadowMap& map, const ShadowPlace& place, const ShadowCase& c, double reach) {
    const glm::dvec3 rel = glm::dvec3(c.position) - glm::dvec3(map.position);
    const auto moved = [&](double offset) { return glm::dvec3(c.position) + glm::dvec3(c.normal) * offset; };
    const glm::dvec3 axis = axis_of(map, place, rel);
    const double offset = normal_offset(map, axis, double{place.w}, c, reach);
    const ShadowPlace there = shadow_place(map, glm::vec3(moved(offset)));
    const glm::dvec3 other = axis_of(map, there, moved(offset) - glm::dvec3(map.position));
    const double across = glm::dot(other, rel) * fold_of(map);
    if (glm::distance(axis, other) < 0.1 || !(across > 0.0)) return there;
    return shadow_place(map, glm::vec3(moved(std::max(offset, normal_offset(map, other, across, c, reach)))));
  }
  static double angle_of(std::uint32_t seed) {
    std::uint32_t x = seed;
    x = (x ^ (x >> 16U)) * 0x7feb352dU;
    x = (x ^ (x >> 15U)) * 0x846ca68bU;
    x ^= x >> 16U;
    return 2.0 * std::atan((x >> 9U) / 4194304.0 - 1.0) + ((x & 1U) != 0 ? 3.14159265358979 : 0.0);
  }
  static double unit_depth(const ShadowMap& map, double w) {
    const double longest = double{map.range_m} * (map.kind == shared::SHADOW_OCTAHEDRON ? std::sqrt(3.0) : 1.0);
    return std::min(w / longest, 1.0);
  }
  static double chebyshev(double mean, double square, double depth, double least) {
    const double variance = std::max(square - mean * mean, least);
    const double share = variance / (variance + (depth - mean) * (depth - mean));
    return depth <= mean ? 1.0 : std::clamp((share - 0.2) / 0.8, 0.0, 1.0);
  }
  [[nodiscard]] glm::dvec4 moments_at(const ShadowMap& map, const ShadowPlace& place) const {
    const glm::dvec2 at = glm::dvec2(place.texel) - 0.5;
    const glm::dvec2 low = glm::floor(at);
    const glm::dvec2 between = at - low;
    glm::dvec4 sum(0.0);
    for (int i = 0; i < 4; ++i) {
      const glm::dvec2 step(i % 2, i / 2);
      const glm::dvec2 part = glm::mix(1.0 - between, between, step);
      sum += part.x * part.y * glm::dvec4(moments_[texel(map, place.square, low + step)]);
    }
    return sum;
  }
  [[nodiscard]] double by_moments(const ShadowMap& map, const ShadowPlace& place) const {
    const glm::dvec4 m = moments_at(map, place);
    return chebyshev(m.x, m.y, unit_depth(map, double{place.w}), 4e-7);
  }
  [[nodiscard]] double by_warps(const ShadowMap& map, const ShadowPlace& place) const {
    const glm::dvec4 m = moments_at(map, place);
    const double x = 2.0 * unit_depth(map, double{place.w}) - 1.0;
    const double far = std::exp(40.0 * x);
    const double near = -std::exp(-5.0 * x);
    return std::min(chebyshev(m.x, m.y, far, std::pow(0.08 * far, 2.0)),
                    chebyshev(m.z, m.w, near, std::pow(0.01 * near, 2.0)));
  }
  [[nodiscard]] double is_lit(const ShadowMap& map, const ShadowPlace& place, const glm::dvec2& at) const {
    return double{depths_[texel(map, place.square, at)]} <= double{map.near_m} * 1.0005 / double{place.w} ? 1.0 : 0.0;
  }
  static std::size_t texel(const ShadowMap& map, std::uint32_t square, const glm::dvec2& at) {
    glm::ivec2 t(glm::floor(at) - glm::dvec2(corner(map, square)));
    const int side = static_cast<int>(map.side);
    if (map.kind == shared::SHADOW_OCTAHEDRON) {
      if (t.x < 0 || t.x >= side) t = {(t.x < 0 ? -1 : 2 * side - 1) - t.x, side - 1 - t.y};
      if (t.y < 0 || t.y >= side) t = {side - 1 - t.x, (t.y < 0 ? -1 : 2 * side - 1) - t.y};
    }
    t = glm::clamp(t, glm::ivec2(0), glm::ivec2(side - 1)) + glm::ivec2(corner(map, square));
    return static_cast<std::size_t>(t.y) * ATLAS + static_cast<std::size_t>(t.x);
  }
  static glm::uvec2 corner(const ShadowMap& map, std::uint32_t square) {
    return glm::uvec2(map.squares[square] & 0xffffU, map.squares[square] >> 16U) * 16U;
  }

  std::span<const ShadowMap> maps_;
  const std::vector<float>& depths_;
  const std::vector<glm::vec4>& moments_;
};

class ShadowLookUp : public GpuTest, public ::testing::WithParamInterface<ShadowFilter> {};

TEST_P(ShadowLookUp, IsThatOfTheCpuInBothLanguages) {
  test::Random random(3);
  const std::vector<ShadowMap> maps = some_maps(GetParam());
  const std::vector<ShadowCase> cases = some_cases(maps, random);
  const std::vector<float> depths = some_depths(random);
  const std::vector<glm::vec4> moments = some_moments(GetParam(), random);
  const GpuImage atlas = depth_image(ATLAS, ATLAS, depths);
  const GpuImage moment_image = float_image(ATLAS, ATLAS, moments);
  const vulkan::Buffer case_buffer = host_buffer_of("cases", cases);
  const vulkan::Buffer map_buffer = host_buffer_of("maps", maps);
  const auto run = [&](const char* shader) {
    const vulkan::Buffer lit = host_buffer("lit", CASES * sizeof(float));
    dispatch({.shader = shader,
              .constants = {static_cast<std::uint32_t>(GetParam())},
              .resources = {vulkan::Resource::storage(case_buffer.handle()), vulkan::Resource::storage(lit.handle()),
                            vulkan::Resource::storage(map_buffer.handle()), atlas.sampled(), moment_image.sampled()},
              .groups = {CASES / 64, 1, 1}});
    return contents<float>(lit);
  };
  const std::vector<float> glsl = run("shadow_lookup");
  EXPECT_EQ(glsl, run("shadow_lookup.hlsl"));

  const Reference reference(maps, depths, moments);
  // Exponents of 32 bits are off by some 1e-5 of what they give.
  const double near_enough = GetParam() == ShadowFilter::evsm ? 5e-3 : GetParam() == ShadowFilter::vsm ? 1e-4 : 1e-6;
  std::uint32_t other = 0;
  double sum = 0.0;
  for (std::uint32_t i = 0; i < CASES; ++i) {
    other += std::abs(reference.shadow_of(cases[i], GetParam()) - double{glsl[i]}) > near_enough ? 1 : 0;
    sum += glsl[i];
  }
  EXPECT_EQ(glsl[0], 1.0F) << "at the light";
  EXPECT_GT(sum, CASES * 0.3);
  EXPECT_LT(sum, CASES * 0.8);
  // Where a place lies within rounding of a texel's edge, or a depth within rounding of what is stored.
  EXPECT_LE(other, CASES / 200) << other << " of " << CASES;
}

std::string filter_name(ShadowFilter filter) {
  constexpr std::array NAMES{"hard", "pcf", "vsm", "evsm"};
  return NAMES[static_cast<std::size_t>(filter)];
}

INSTANTIATE_TEST_SUITE_P(Of, ShadowLookUp,
                         ::testing::Values(ShadowFilter::hard, ShadowFilter::pcf, ShadowFilter::vsm,
                                           ShadowFilter::evsm),
                         [](const auto& test) { return filter_name(test.param); });

}  // namespace
}  // namespace lamp::app
