// Reads the header, a Python dictionary of three keys, and the floats behind it.
// Based on: NumPy, the .npy format, versions 1.0 to 3.0 (numpy.lib.format).
// SPDX-License-Identifier: Apache-2.0
#include "scene/npy.h"

#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cstring>
#include <optional>
#include <string_view>

#include "error.h"

namespace lamp::app {
namespace {

constexpr std::string_view MAGIC = "\x93NUMPY";
constexpr std::string_view FLOAT32 = "<f4";
constexpr std::size_t ALIGNMENT = 64;  // of the data in the file, as NumPy writes it

static_assert(std::endian::native == std::endian::little, "floats are copied as they are");

[[noreturn]] void fail(const std::string& name, const std::string& problem) {
  throw Error(fmt::format("{}: {}", name, problem));
}

/// What the header says.
struct Header {
  std::string_view type;
  std::string_view order;  ///< "True": Fortran's
  std::string_view shape;  ///< between the parentheses
};

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view BLANK = " \t\r\n";
  const std::size_t first = text.find_first_not_of(BLANK);
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(BLANK) - first + 1);
}

/// A value as errors show it: not long.
std::string_view brief(std::string_view text) { return text.substr(0, 60); }

/// The text of a key's value, up to the comma or the end; within quotes or parentheses what these enclose. Empty if the
/// key is not there.
std::string_view value_of(std::string_view dictionary, std::string_view key) {
  const std::string quoted = fmt::format("'{}'", key);
  const std::size_t at = dictionary.find(quoted);
  if (at == std::string_view::npos) return {};
  std::string_view rest = trimmed(dictionary.substr(at + quoted.size()));
  if (!rest.starts_with(':')) return {};
  rest = trimmed(rest.substr(1));
  const bool encloses = rest.starts_with('\'') || rest.starts_with('(');
  const std::string_view ends = rest.starts_with('\'') ? "'" : rest.starts_with('(') ? ")" : ",}";
  if (encloses) rest.remove_prefix(1);
  const std::size_t end = rest.find_first_of(ends);
  return end == std::string_view::npos ? std::string_view() : trimmed(rest.substr(0, end));
}

/// The sizes of a shape, "5, 16" or "5,".
std::optional<std::vector<std::uint64_t>> sizes_of(std::string_view shape) {
  std::vector<std::uint64_t> sizes;
  while (!shape.empty()) {
    const std::size_t comma = shape.find(',');
    const std::string_view part = trimmed(shape.substr(0, comma));
    std::uint64_t size = 0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), size);
    if (error != std::errc{} || end != part.data() + part.size()) return std::nullopt;
    sizes.push_back(size);
    shape = comma == std::string_view::npos ? std::string_view() : trimmed(shape.substr(comma + 1));
  }
  return sizes;
}

/// The dictionary's text; `text` shrinks to what comes after it.
std::string_view take_dictionary(std::string_view& text, const std::string& name) {
  if (!text.starts_with(MAGIC)) fail(name, "does not begin as a .npy file, expected one that NumPy's save() wrote");
  if (text.size() < 12) fail(name, "is truncated in its header");
  const auto version = static_cast<unsigned char>(text[6]);
  if (version < 1 || version > 3) fail(name, fmt::format("has format version {}, expected 1, 2 or 3", version));
  const std::size_t length_bytes = version == 1 ? 2 : 4;
  std::uint32_t length = 0;
  std::memcpy(&length, text.data() + 8, length_bytes);
  text.remove_prefix(8 + length_bytes);
  if (text.size() < length) fail(name, "is truncated in its header");
  const std::string_view dictionary = text.substr(0, length);
  text.remove_prefix(length);
  return dictionary;
}

/// Rows of the table that the header speaks of.
std::uint64_t check_header(std::string_view dictionary, const std::string& name, std::uint32_t columns) {
  const Header header{.type = value_of(dictionary, "descr"),
                      .order = value_of(dictionary, "fortran_order"),
                      .shape = value_of(dictionary, "shape")};
  if (header.type != FLOAT32)
    fail(name,
         fmt::format("holds values of type '{}', expected '{}' (little-endian float32)", brief(header.type), FLOAT32));
  if (header.order != "False")
    fail(name, fmt::format("has fortran_order {}, expected False (numpy.ascontiguousarray)", brief(header.order)));
  const std::optional<std::vector<std::uint64_t>> sizes = sizes_of(header.shape);
  if (!sizes || sizes->size() != 2 || (*sizes)[1] != columns)
    fail(name, fmt::format("has shape ({}), expected (N, {})", brief(header.shape), columns));
  return (*sizes)[0];
}

}  // namespace

Table read_npy(std::span<const std::byte> bytes, const std::string& name, std::uint32_t columns) {
  std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::string_view dictionary = take_dictionary(text, name);
  const std::uint64_t rows = check_header(dictionary, name, columns);
  const std::uint64_t row_bytes = columns * sizeof(float);
  if (rows != text.size() / row_bytes || text.size() % row_bytes != 0)
    fail(name,
         fmt::format("{} {} bytes of data, expected {} rows of {} bytes",
                     rows > text.size() / row_bytes ? "is truncated: it has" : "has", text.size(), rows, row_bytes));
  Table table{.columns = columns, .values = std::vector<float>(static_cast<std::size_t>(rows) * columns)};
  if (!table.values.empty()) std::memcpy(table.values.data(), text.data(), text.size());
  return table;
}

std::string npy_bytes(const Table& table) {
  std::string dictionary = fmt::format("{{'descr': '{}', 'fortran_order': False, 'shape': ({}, {}), }}", FLOAT32,
                                       table.rows(), table.columns);
  const std::size_t before = MAGIC.size() + 4;
  dictionary.append((ALIGNMENT - (before + dictionary.size() + 1) % ALIGNMENT) % ALIGNMENT, ' ');
  dictionary += '\n';
  std::string bytes(MAGIC);
  bytes += {'\x01', '\x00', static_cast<char>(dictionary.size() & 0xFFU), static_cast<char>(dictionary.size() >> 8U)};
  bytes += dictionary;
  bytes.append(reinterpret_cast<const char*>(table.values.data()), table.values.size() * sizeof(float));
  return bytes;
}

}  // namespace lamp::app
