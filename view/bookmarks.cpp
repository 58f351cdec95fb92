// {"version": 1, "bookmarks": [{"name": "...", "state": {...}}]}
// SPDX-License-Identifier: Apache-2.0
#include "view/bookmarks.h"

#include <fmt/format.h>

#include <array>
#include <nlohmann/json.hpp>

#include "files/json_values.h"
#include "files/read_file.h"
#include "files/read_json.h"
#include "image/image.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t VERSION = 1;
constexpr std::string_view BOOKMARKS = "bookmarks";

nlohmann::json parsed(const std::filesystem::path& file) {
  return parse_json(
      text_of(read_file(file, {.expected = "bookmarks of lamp-view", .most_bytes = std::uint64_t{1} << 26})),
      file.string());
}

}  // namespace

bool holds_bookmarks(const std::filesystem::path& file) {
  try {
    const nlohmann::json json = parsed(file);
    return json.is_object() && json.contains(BOOKMARKS);
  } catch (const Error&) {
    return false;
  }
}

std::vector<Bookmark> load_bookmarks(const std::filesystem::path& file) {
  const nlohmann::json json = parsed(file);
  const std::string name = file.string();
  const JsonObject object{.json = json, .file = name, .element = ""};
  if (!json.is_object()) object.fail(fmt::format("is {}, expected an object", shown(json)));
  object.check_keys(std::to_array<std::string_view>({"version", BOOKMARKS}));
  static_cast<void>(object.whole("version", VERSION, VERSION));
  if (!json.contains(BOOKMARKS) || !json[BOOKMARKS].is_array()) object.fail("bookmarks: expected an array");
  std::vector<Bookmark> bookmarks;
  for (const nlohmann::json& one : json[BOOKMARKS]) {
    const std::string element = fmt::format("{} {}", BOOKMARKS, bookmarks.size());
    const JsonObject bookmark{.json = one, .file = name, .element = element};
    if (!one.is_object()) bookmark.fail(fmt::format("is {}, expected an object", shown(one)));
    bookmark.check_keys(std::to_array<std::string_view>({"name", "state"}));
    Bookmark& read = bookmarks.emplace_back();
    read.name = bookmark.text("name", "a text");
    if (!one.contains("state") || !one["state"].is_object()) bookmark.fail("state: expected an object");
    read_state(read.state, one["state"], fmt::format("{}: {}: state", name, element));
  }
  return bookmarks;
}

void save_bookmarks(const std::filesystem::path& file, std::span<const Bookmark> bookmarks) {
  nlohmann::json array = nlohmann::json::array();
  for (const Bookmark& bookmark : bookmarks)
    array.push_back({{"name", bookmark.name}, {"state", to_json(bookmark.state)}});
  write_text(file, json_text({{"version", VERSION}, {std::string(BOOKMARKS), std::move(array)}}, 2) + "\n");
}

}  // namespace lamp::app
