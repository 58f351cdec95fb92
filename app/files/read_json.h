// JSON as every reader takes it: strict, and of a size and depth that neither memory nor stack can run out of.
// Based on: RFC 8259 (JSON), through nlohmann's parser.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

namespace lamp::app {

/// The most values of a document, objects and arrays included: some hundred bytes of memory each.
inline constexpr std::size_t MOST_JSON_VALUES = std::size_t{1} << 25;

/// Parses a document. Throws Error: `file`, where in the document ("series/0/lights"), and what is wrong. A key that an
/// object has twice is an error, and so are bytes behind a NUL, numbers that no double holds and levels beyond 64.
[[nodiscard]] nlohmann::json parse_json(std::string_view text, const std::string& file,
                                        std::size_t most_values = MOST_JSON_VALUES);

/// The document as text, all ASCII, so that no terminal acts on it. What is no UTF-8 (names of files may be) is
/// replaced, as JSON cannot hold it.
[[nodiscard]] std::string json_text(const nlohmann::json& document, int indent);

}  // namespace lamp::app
