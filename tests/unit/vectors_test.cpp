// Vectors and matrices of public structs: the bytes of glm's, and what goes in and comes out without a word.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/vectors.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <glm/glm.hpp>
#include <numeric>
#include <type_traits>

namespace {

using lamp::DMat4;
using lamp::DVec3;
using lamp::Mat4;
using lamp::UVec2;
using lamp::Vec2;
using lamp::Vec3;
using lamp::Vec4;

template <class From, class To>
constexpr bool GOES_INTO = std::is_convertible_v<From, To>;
template <class From, class To>
constexpr bool NEEDS_A_CAST = !std::is_convertible_v<From, To> && std::is_constructible_v<To, From>;

/// An engine's own.
struct OwnVector {
  float x, y, z;
};
using OwnMatrix = float[4][4];

template <class T>
constexpr bool PLAIN = std::is_standard_layout_v<T> && std::is_trivial_v<T>;
static_assert(PLAIN<Vec2> && PLAIN<Vec3> && PLAIN<Vec4> && PLAIN<UVec2> && PLAIN<DVec3> && PLAIN<Mat4> && PLAIN<DMat4>);

static_assert(GOES_INTO<glm::vec3, Vec3> && GOES_INTO<Vec3, glm::vec3> && GOES_INTO<glm::uvec2, UVec2>);
static_assert(GOES_INTO<OwnVector, Vec3> && GOES_INTO<Vec3, OwnVector>);
static_assert(GOES_INTO<glm::mat4, Mat4> && GOES_INTO<Mat4, glm::mat4> && GOES_INTO<OwnMatrix, DMat4>);

static_assert(GOES_INTO<Vec3, glm::dvec3> && GOES_INTO<glm::mat4, DMat4> && GOES_INTO<Mat4, DMat4>);
static_assert(NEEDS_A_CAST<glm::dvec3, Vec3> && NEEDS_A_CAST<DMat4, glm::mat4> && NEEDS_A_CAST<DMat4, Mat4>);
static_assert(NEEDS_A_CAST<glm::uvec2, Vec2>);

static_assert(!std::is_constructible_v<Vec3, glm::vec2> && !std::is_constructible_v<Vec3, glm::vec4>);
static_assert(!std::is_constructible_v<DMat4, glm::mat3> && !std::is_constructible_v<Vec2, OwnVector>);

TEST(Vectors, HaveTheBytesOfGlm) {
  EXPECT_EQ((std::bit_cast<glm::vec3>(Vec3(1.0F, 2.0F, 3.0F))), glm::vec3(1.0F, 2.0F, 3.0F));
  std::array<float, 16> numbers{};
  std::iota(numbers.begin(), numbers.end(), 1.0F);
  const auto matrix = std::bit_cast<glm::mat4>(numbers);
  EXPECT_EQ(std::bit_cast<glm::mat4>(Mat4::from_columns(numbers.data())), matrix);
  EXPECT_EQ(glm::mat4(Mat4(matrix)), matrix);
  EXPECT_EQ(glm::dmat4(DMat4(matrix)), glm::dmat4(matrix));
}

TEST(Vectors, RowsAreColumnsTransposed) {
  std::array<double, 16> numbers{};
  std::iota(numbers.begin(), numbers.end(), 1.0);
  const DMat4 rows = DMat4::from_rows(numbers.data());
  EXPECT_EQ(rows[3][0], 4.0);
  EXPECT_EQ(rows, DMat4(glm::transpose(glm::dmat4(DMat4::from_columns(numbers.data())))));
  EXPECT_EQ(glm::dmat4(DMat4::identity()), glm::dmat4(1.0));
}

TEST(Vectors, AreZeroWhereInitialized) {
  EXPECT_EQ(Vec3{}, Vec3(0.0F, 0.0F, 0.0F));
  EXPECT_EQ(glm::mat4(Mat4{}), glm::mat4(0.0F));
}

}  // namespace
