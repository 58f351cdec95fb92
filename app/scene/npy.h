// NumPy's array files (.npy): tables of 32-bit floats.
// Based on: NumPy, the .npy format, versions 1.0 to 3.0 (numpy.lib.format).
// Promise: values are stored and read bit for bit; any bytes give a table or an Error.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace lamp::app {

/// Row after row.
struct Table {
  std::uint32_t columns = 1;
  std::vector<float> values;

  [[nodiscard]] std::size_t rows() const { return values.size() / columns; }
  [[nodiscard]] std::span<const float> row(std::size_t i) const {
    return std::span(values).subspan(i * columns, columns);
  }
};

/// An array of little-endian 32-bit floats, shape (any, `columns`), C order. Throws Error that begins with `name`: what
/// is wrong with type, shape, order or length, and what was expected.
[[nodiscard]] Table read_npy(std::span<const std::byte> bytes, const std::string& name, std::uint32_t columns);

/// The bytes of such a file.
[[nodiscard]] std::string npy_bytes(const Table& table);

}  // namespace lamp::app
