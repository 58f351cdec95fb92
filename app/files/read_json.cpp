// Follows the parser through a document, so that it stops before anything grows too large and knows where it is.
// SPDX-License-Identifier: Apache-2.0
#include "files/read_json.h"

#include <fmt/format.h>

#include <functional>
#include <set>
#include <vector>

#include "error.h"
#include "files/json_values.h"

namespace lamp::app {
namespace {

using nlohmann::json;
using Event = json::parse_event_t;

constexpr std::size_t DEEPEST = 64;  // what walks a document calls itself as deep as it nests; no format needs 16

class Follower {
 public:
  Follower(const std::string& file, std::size_t most_values) : file_(file), most_values_(most_values) {}

  /// What nlohmann's parser calls.
  bool operator()(int /*depth*/, Event event, const json& parsed) {
    switch (event) {
      case Event::key:
        add_key(parsed.get_ref<const std::string&>());
        break;
      case Event::value:
        begin_value();
        break;
      case Event::object_start:
      case Event::array_start:
        if (levels_.size() == DEEPEST) fail(fmt::format("is nested too deep, expected at most {} levels", DEEPEST));
        begin_value();
        levels_.emplace_back().is_array = event == Event::array_start;
        break;
      case Event::object_end:
      case Event::array_end:
        levels_.pop_back();
        break;
    }
    return true;
  }

  [[noreturn]] void fail(std::string_view problem) const {
    std::string where;
    for (std::size_t i = 0; i < levels_.size(); ++i) {
      const std::size_t at = levels_[i].begun - (i + 1 < levels_.size() ? 1 : 0);
      where += fmt::format("{}{}", where.empty() ? "" : "/", levels_[i].is_array ? std::to_string(at) : levels_[i].key);
    }
    throw Error(fmt::format("{}: {}{}{}", file_, where, where.empty() ? "" : ": ", problem));
  }

 private:
  /// An object or array that has begun.
  struct Level {
    bool is_array = false;
    std::size_t begun = 0;  ///< values
    std::string key;        ///< the last one
    std::set<std::string> keys;
  };

  void add_key(const std::string& key) {
    Level& object = levels_.back();
    object.key = key;
    if (!object.keys.insert(key).second) fail("is there twice, expected every key of an object once");
  }

  void begin_value() {
    if (++values_ > most_values_)
      fail(fmt::format("the document has more values than {}, expected fewer", most_values_));
    if (!levels_.empty()) ++levels_.back().begun;
  }

  const std::string& file_;
  std::size_t most_values_;
  std::size_t values_ = 0;
  std::vector<Level> levels_;
};

/// "[json.exception.parse_error.101] parse error at line 1 ...": the code in brackets helps nobody.
std::string_view without_code(std::string_view what) {
  const std::size_t bracket = what.find("] ");
  return bracket == std::string_view::npos ? what : what.substr(bracket + 2);
}

}  // namespace

json parse_json(std::string_view text, const std::string& file, std::size_t most_values) {
  Follower follower(file, most_values);
  // The parser would take a NUL for the end.
  if (const std::size_t nul = text.find('\0'); nul != std::string_view::npos)
    follower.fail(fmt::format("byte {} is 0, expected JSON text", nul));
  try {
    return json::parse(text, std::ref(follower));
  } catch (const json::exception& error) {
    follower.fail(fmt::format("is no JSON: {}", without_code(error.what())));
  }
}

std::string json_text(const json& document, int indent) {
  return document.dump(indent, ' ', /* ensure_ascii= */ true, json::error_handler_t::replace);
}

}  // namespace lamp::app
