// What the values of a JSON document must be, as data: one rule for each value that a reader takes from it.
// Promise: after check_rules(), every value in the rules that is there has the type and range its rule says.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>

namespace lamp::app {

enum class Want : std::uint8_t {
  object,
  objects,        ///< an array of objects
  index,          ///< an index into an array of the document
  indices,        ///< an array of them
  named_indices,  ///< an object whose values are indices
  natural,        ///< an integer >= 0
  number,
  numbers,  ///< an array of numbers
  text,
  texts,        ///< an array of strings
  named_texts,  ///< an object whose values are strings
  flag,
};

struct Rule {
  std::string_view at;  ///< where, by keys and '*' for all elements of an array: "meshes/*/primitives/*"
  std::string_view key;
  Want want = Want::object;
  bool required = false;
  std::string_view when;  ///< required only where the key "type" beside it says this
  bool nullable = false;  ///< null will do
  double min = -static_cast<double>(std::numeric_limits<float>::max());
  double max = static_cast<double>(std::numeric_limits<float>::max());
  std::size_t step = 1;    ///< natural: a multiple of this
  std::size_t size = 0;    ///< numbers: exactly so many, 0: any; objects: at most so many in all arrays of the rule;
                           ///< text: at most so many bytes, 0: any
  std::string_view words;  ///< natural, text: the values allowed, "one, two" (empty: any)
  std::string_view into;   ///< index and its kin: where the array is
};

/// Throws Error for the first value below `place` that breaks a rule, named by its element ("mesh 0 primitive 2").
/// Rules of containers come before those of what they contain.
void check_rules(const nlohmann::json& document, std::span<const Rule> rules, const std::string& file,
                 std::string_view place = {});

}  // namespace lamp::app
