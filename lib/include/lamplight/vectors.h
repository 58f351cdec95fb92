// Vectors and matrices of public structs: plain numbers without arithmetic, for which a host has a library of its own.
// Any type with members x, y, z (or m[column][row]) goes in and comes out where no number loses digits: glm's, an
// engine's own; with digits lost, in a cast.
// Promise: standard layout, trivial, zero only where initialized with {}; the same bytes as glm's vectors and matrices.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>

namespace lamp {

/// Whether every number of one type is one of the other: float to double, not double to float.
template <class From, class To>
concept FitsIn = requires(const From from) { To{from}; };

/// What has members x and y; and z; and w, and no more.
template <class V>
concept Has2 = requires(const V v) {
  v.x;
  v.y;
} && !requires(const V v) { v.z; };
template <class V>
concept Has3 = requires(const V v) {
  v.x;
  v.y;
  v.z;
} && !requires(const V v) { v.w; };
template <class V>
concept Has4 = requires(const V v) {
  v.x;
  v.y;
  v.z;
  v.w;
};
template <class V>
using NumberOf = decltype(V::x);

/// Four columns of four numbers, as an array of arrays or by operators: m[column][row].
template <class M>
concept HasColumns = requires(const M m) { m[3][3] + m[3][3]; } && sizeof(M) == 16 * sizeof(M{}[3][3]);
template <class M>
using ElementOf = decltype(M{}[3][3] + M{}[3][3]);

/// What `operator V` makes: not what a constructor does, which would be two ways.
template <class V, class Ours>
concept Foreign = std::default_initializable<V> && !std::same_as<V, Ours>;

template <class T>
struct Vector2 {
  T x, y;

  constexpr Vector2() = default;
  constexpr Vector2(T at_x, T at_y) : x(at_x), y(at_y) {}
  template <Has2 V>
  constexpr explicit(!FitsIn<NumberOf<V>, T>) Vector2(const V& v) : x(static_cast<T>(v.x)), y(static_cast<T>(v.y)) {}
  template <Has2 V>
    requires Foreign<V, Vector2<NumberOf<V>>>
  constexpr explicit(!FitsIn<T, NumberOf<V>>) operator V() const {
    return V{static_cast<NumberOf<V>>(x), static_cast<NumberOf<V>>(y)};
  }
  friend constexpr bool operator==(const Vector2&, const Vector2&) = default;
};

template <class T>
struct Vector3 {
  T x, y, z;

  constexpr Vector3() = default;
  constexpr Vector3(T at_x, T at_y, T at_z) : x(at_x), y(at_y), z(at_z) {}
  template <Has3 V>
  constexpr explicit(!FitsIn<NumberOf<V>, T>) Vector3(const V& v)
      : x(static_cast<T>(v.x)), y(static_cast<T>(v.y)), z(static_cast<T>(v.z)) {}
  template <Has3 V>
    requires Foreign<V, Vector3<NumberOf<V>>>
  constexpr explicit(!FitsIn<T, NumberOf<V>>) operator V() const {
    return V{static_cast<NumberOf<V>>(x), static_cast<NumberOf<V>>(y), static_cast<NumberOf<V>>(z)};
  }
  friend constexpr bool operator==(const Vector3&, const Vector3&) = default;
};

template <class T>
struct Vector4 {
  T x, y, z, w;

  constexpr Vector4() = default;
  constexpr Vector4(T at_x, T at_y, T at_z, T at_w) : x(at_x), y(at_y), z(at_z), w(at_w) {}
  template <Has4 V>
  constexpr explicit(!FitsIn<NumberOf<V>, T>) Vector4(const V& v)
      : x(static_cast<T>(v.x)), y(static_cast<T>(v.y)), z(static_cast<T>(v.z)), w(static_cast<T>(v.w)) {}
  template <Has4 V>
    requires Foreign<V, Vector4<NumberOf<V>>>
  constexpr explicit(!FitsIn<T, NumberOf<V>>) operator V() const {
    return V{static_cast<NumberOf<V>>(x), static_cast<NumberOf<V>>(y), static_cast<NumberOf<V>>(z),
             static_cast<NumberOf<V>>(w)};
  }
  friend constexpr bool operator==(const Vector4&, const Vector4&) = default;
};

/// Columns, one after the other: m[column][row]. A product is m * v with a column v.
template <class T>
struct Matrix4 {
  T columns[4][4];

  constexpr Matrix4() = default;
  template <HasColumns M>
  constexpr explicit(!FitsIn<ElementOf<M>, T>) Matrix4(const M& m) {
    for (int i = 0; i < 16; ++i) columns[i / 4][i % 4] = static_cast<T>(m[i / 4][i % 4]);
  }
  template <HasColumns M>
    requires Foreign<M, Matrix4<ElementOf<M>>>
  constexpr explicit(!FitsIn<T, ElementOf<M>>) operator M() const {
    M m{};
    for (int i = 0; i < 16; ++i) m[i / 4][i % 4] = static_cast<ElementOf<M>>(columns[i / 4][i % 4]);
    return m;
  }

  [[nodiscard]] static constexpr Matrix4 identity() {
    Matrix4 m{};
    for (int i = 0; i < 4; ++i) m.columns[i][i] = 1;
    return m;
  }
  /// Of 16 numbers in memory: column after column, which is also row after row of a matrix for v * m with a row v.
  template <class U>
  [[nodiscard]] static constexpr Matrix4 from_columns(const U* numbers) {
    Matrix4 m{};
    for (int i = 0; i < 16; ++i) m.columns[i / 4][i % 4] = static_cast<T>(numbers[i]);
    return m;
  }
  /// Of 16 numbers in memory, row after row.
  template <class U>
  [[nodiscard]] static constexpr Matrix4 from_rows(const U* numbers) {
    Matrix4 m{};
    for (int i = 0; i < 16; ++i) m.columns[i % 4][i / 4] = static_cast<T>(numbers[i]);
    return m;
  }

  constexpr T (&operator[](std::size_t column))[4] { return columns[column]; }
  constexpr const T (&operator[](std::size_t column) const)[4] { return columns[column]; }
  friend constexpr bool operator==(const Matrix4&, const Matrix4&) = default;
};

using Vec2 = Vector2<float>;
using Vec3 = Vector3<float>;
using Vec4 = Vector4<float>;
using DVec2 = Vector2<double>;
using DVec3 = Vector3<double>;
using UVec2 = Vector2<std::uint32_t>;
using UVec4 = Vector4<std::uint32_t>;
using Mat4 = Matrix4<float>;
using DMat4 = Matrix4<double>;

}  // namespace lamp
