// Follows the parser through a document, so that it stops before anything grows too large and knows where it is.
// SPDX-License-Identifier: Apache-2.0
#include "files/read_json.h"

#include <fmt/format.h>

#include <utility>
#include <vector>

#include "error.h"
#include "files/json_values.h"

namespace lamp::app {
namespace {

using nlohmann::json;

constexpr std::size_t DEEPEST = 64;  // what walks a document calls itself as deep as it nests; no format needs 16

/// "[json.exception.parse_error.101] parse error at line 1 ...": the code in brackets helps nobody.
std::string_view without_code(std::string_view what) {
  const std::size_t bracket = what.find("] ");
  return bracket == std::string_view::npos ? what : what.substr(bracket + 2);
}

/// What nlohmann's parser tells of a document, in the form of its json_sax. (Its parser with a callback looks through
/// all elements of an array again behind each that is an object or array.)
class Follower {
 public:
  Follower(const std::string& file, std::size_t most_values) : file_(file), most_values_(most_values) {}

  bool null() { return put(nullptr); }
  bool boolean(bool value) { return put(value); }
  bool number_integer(json::number_integer_t value) { return put(value); }
  bool number_unsigned(json::number_unsigned_t value) { return put(value); }
  bool number_float(json::number_float_t value, const std::string& /*text*/) { return put(value); }
  bool string(std::string& value) { return put(std::move(value)); }
  static bool binary(json::binary_t& /*value*/) { return false; }  // not in text
  bool start_object(std::size_t /*size*/) { return open(json::object()); }
  bool start_array(std::size_t /*size*/) { return open(json::array()); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }
  bool key(std::string& key) {
    Level& object = levels_.back();
    object.key = std::move(key);
    if (object.made->contains(object.key)) fail("is there twice, expected every key of an object once");
    return true;
  }
  [[noreturn]] bool parse_error(std::size_t /*byte*/, const std::string& /*token*/, const json::exception& error) {
    fail(fmt::format("is no JSON: {}", without_code(error.what())));
  }

  [[nodiscard]] json take() { return std::move(document_); }

  [[noreturn]] void fail(std::string_view problem) const {
    std::string where;
    for (std::size_t i = 0; i < levels_.size(); ++i) {
      const std::size_t at = levels_[i].begun - (i + 1 < levels_.size() ? 1 : 0);
      where += fmt::format("{}{}", where.empty() ? "" : "/",
                           levels_[i].made->is_array() ? std::to_string(at) : levels_[i].key);
    }
    throw Error(fmt::format("{}: {}{}{}", file_, where, where.empty() ? "" : ": ", problem));
  }

 private:
  /// An object or array that has begun.
  struct Level {
    json* made = nullptr;
    std::size_t begun = 0;  ///< values
    std::string key;        ///< the last one
  };

  bool put(json value) {
    add(std::move(value));
    return true;
  }

  bool open(json empty) {
    if (levels_.size() == DEEPEST) fail(fmt::format("is nested too deep, expected at most {} levels", DEEPEST));
    levels_.push_back({.made = &add(std::move(empty)), .begun = 0, .key = {}});
    return true;
  }

  bool close() {
    levels_.pop_back();
    return true;
  }

  /// Puts a value where the document has come to.
  json& add(json value) {
    if (++values_ > most_values_)
      fail(fmt::format("the document has more values than {}, expected fewer", most_values_));
    if (levels_.empty()) return document_ = std::move(value);
    Level& level = levels_.back();
    ++level.begun;
    return level.made->is_array() ? level.made->emplace_back(std::move(value))
                                  : (*level.made)[level.key] = std::move(value);
  }

  const std::string& file_;
  std::size_t most_values_;
  std::size_t values_ = 0;
  json document_;
  std::vector<Level> levels_;
};

}  // namespace

json parse_json(std::string_view text, const std::string& file, std::size_t most_values) {
  Follower follower(file, most_values);
  // The parser would take a NUL for the end.
  if (const std::size_t nul = text.find('\0'); nul != std::string_view::npos)
    follower.fail(fmt::format("byte {} is 0, expected JSON text", nul));
  json::sax_parse(text, &follower);
  return follower.take();
}

std::string json_text(const json& document, int indent) {
  return document.dump(indent, ' ', /* ensure_ascii= */ true, json::error_handler_t::replace);
}

}  // namespace lamp::app
