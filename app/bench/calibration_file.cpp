// Reads and writes calibrations.
// Promise: a damaged or foreign file in the cache is measured anew, never trusted.
// SPDX-License-Identifier: Apache-2.0
#include "bench/calibration_file.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <filesystem>

#include "error.h"
#include "files/content_hash.h"
#include "files/json_values.h"
#include "files/read_file.h"
#include "files/read_json.h"
#include "files/utf8_path.h"
#include "image/write_file.h"
#include "system/temporary.h"

namespace lamp::app {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr std::string_view CALIBRATION_FORMAT = "lamplight-calibration";
constexpr int VERSION = 5;  // of the file and of the model: grows when an old file would mislead

/// Throws Error unless the key has this very value.
void expect(const JsonObject& object, std::string_view key, const json& wanted) {
  const json& value = object.at(key, shown(wanted));
  if (value != wanted) object.fail(fmt::format("{} is {}, expected {}", key, shown(value), shown(wanted)));
}

template <std::size_t COUNT>
std::array<double, COUNT> parse_terms(const JsonObject& entry, std::string_view key) {
  const std::vector<double> numbers = entry.numbers(key, COUNT);
  std::array<double, COUNT> terms{};
  for (std::size_t i = 0; i < COUNT; ++i) {
    if (numbers[i] < 0.0) entry.fail(fmt::format("{}[{}] is {}, expected a number >= 0", key, i, shown(numbers[i])));
    terms[i] = numbers[i];
  }
  return terms;
}

}  // namespace

json to_json(const Calibration& calibration) {
  json document{{"format", CALIBRATION_FORMAT},
                {"version", VERSION},
                {"device", calibration.device},
                {"driver", calibration.driver},
                {"candidates", json::array()}};
  const std::span<const AutoCandidate> candidates = auto_candidates();
  for (std::size_t i = 0; i < candidates.size(); ++i)
    document["candidates"].push_back({{"candidate", candidates[i].label()},
                                      {"cull", calibration.costs[i].cull},
                                      {"shade", calibration.costs[i].shade}});
  return document;
}

Calibration parse_calibration(std::string_view text, const std::string& source) {
  const json document = parse_json(text, source);
  const JsonObject object{.json = document, .file = source, .element = ""};
  if (!document.is_object()) object.fail(fmt::format("is {}, expected an object", shown(document)));
  expect(object, "format", CALIBRATION_FORMAT);
  expect(object, "version", VERSION);
  Calibration calibration{.device = object.text("device", "a name"), .driver = object.text("driver", "a name")};
  const std::span<const AutoCandidate> candidates = auto_candidates();
  const std::string expected = fmt::format("an array of {} candidates", candidates.size());
  const json& list = object.at("candidates", expected);
  if (!list.is_array()) object.fail(fmt::format("candidates is {}, expected {}", shown(list), expected));
  if (list.size() != candidates.size())
    object.fail(fmt::format("candidates is an array of {}, expected {}", list.size(), expected));
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const JsonObject entry{.json = list[i], .file = source, .element = fmt::format("candidates[{}]", i)};
    if (!list[i].is_object()) entry.fail(fmt::format("is {}, expected an object", shown(list[i])));
    expect(entry, "candidate", candidates[i].label());
    calibration.costs.push_back(
        {.cull = parse_terms<CULL_TERMS>(entry, "cull"), .shade = parse_terms<SHADE_TERMS>(entry, "shade")});
  }
  return calibration;
}

Calibration load_calibration(const std::string& file, const std::string& name) {
  constexpr std::uint64_t LARGEST = 1U << 24;  // bytes
  return parse_calibration(
      text_of(read_file(utf8_path(file), {.name = name, .expected = "a calibration of lamp", .most_bytes = LARGEST})),
      name);
}

std::string cached_calibration_file(const std::string& device, const std::string& driver) {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return value == nullptr ? fs::path() : utf8_path(value);
  };
  fs::path folder = variable("XDG_CACHE_HOME");
  if (!folder.is_absolute()) folder = variable("LOCALAPPDATA");  // a relative one is to be ignored
  if (folder.empty() && !variable("HOME").empty()) folder = variable("HOME") / ".cache";
  if (folder.empty()) return {};
  const std::string name = hash_text(hash_of(device + "\n" + driver));  // any device's name gives one of a file
  return (folder / "lamplight" / fmt::format("calibration-{}.json", name)).string();
}

std::optional<Calibration> read_cached_calibration(const std::string& file, const std::string& device,
                                                   const std::string& driver) {
  if (file.empty()) return std::nullopt;
  try {
    Calibration calibration = load_calibration(file, file);
    if (calibration.device == device && calibration.driver == driver) return calibration;
  } catch (const Error&) {
    return std::nullopt;  // what is not there, or no calibration, is replaced by one
  }
  return std::nullopt;
}

std::string keep_calibration(const std::string& file, const Calibration& calibration) {
  if (file.empty()) return "none of XDG_CACHE_HOME, LOCALAPPDATA and HOME is there";
  try {
    NewFolders folders(utf8_path(file).parent_path());
    write_file(utf8_path(file), json_text(to_json(calibration), 1) + "\n");
    folders.keep();
  } catch (const fs::filesystem_error& failure) {
    return fmt::format("{}: its folder cannot be made: {}", file, failure.code().message());
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

}  // namespace lamp::app
