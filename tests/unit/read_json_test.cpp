// Every reader of JSON refuses what a lenient parser takes, and what would exhaust stack or memory.
// SPDX-License-Identifier: Apache-2.0
#include "files/read_json.h"

#include <gtest/gtest.h>

#include <functional>

#include "bench/calibration_file.h"
#include "bench/results.h"
#include "bench/suite.h"
#include "error.h"
#include "scene/capture_json.h"
#include "unit/gltf_builder.h"

namespace lamp::test {
namespace {

using namespace std::string_literals;
using Reader = std::function<void(const std::string&)>;

const std::vector<Reader>& readers() {
  static const std::vector<Reader> READERS{
      [](const std::string& text) { static_cast<void>(app::parse_json(text, "file")); },
      [](const std::string& text) { static_cast<void>(app::load_gltf(std::as_bytes(std::span(text)), {}, "file")); },
      [](const std::string& text) { static_cast<void>(app::parse_manifest(text, "file")); },
      [](const std::string& text) { static_cast<void>(app::parse_suite(text, "file")); },
      [](const std::string& text) { static_cast<void>(app::parse_results(text, "file")); },
      [](const std::string& text) { static_cast<void>(app::parse_calibration(text, "file")); },
  };
  return READERS;
}

void expect_of_all(const std::string& text, const std::string& says) {
  for (std::size_t i = 0; i < readers().size(); ++i) {
    try {
      readers()[i](text);
      ADD_FAILURE() << "reader " << i << " took it";
    } catch (const app::Error& error) {
      EXPECT_TRUE(std::string_view(error.what()).starts_with("file: ")) << error.what();
      EXPECT_NE(std::string_view(error.what()).find(says), std::string_view::npos)
          << "reader " << i << " says: " << error.what() << "\nwant: " << says;
    }
  }
}

TEST(ReadJson, NestsNoDeeperThanAnyFormatDoes) {
  expect_of_all(std::string(1'000'000, '['), "is nested too deep, expected at most 64 levels");
  std::string objects;
  for (int i = 0; i < 100'000; ++i) objects += R"({"a": )";
  expect_of_all(objects, "a/a/a: is nested too deep");
}

TEST(ReadJson, KeysAreThereOnce) {
  expect_of_all(R"({"version": 1, "version": 1})",
                "file: version: is there twice, expected every key of an object once");
  expect_of_all(R"({"a": [1, {"b": {}}, {"b": 1, "c": 2, "b": 3}]})", "file: a/2/b: is there twice");
  expect_of_all(R"({"a": 1, "\u0061": 2})", "file: a: is there twice");
}

TEST(ReadJson, NothingFollowsTheDocument) {
  expect_of_all("{}\0garbage"s, "file: byte 2 is 0, expected JSON text");
  expect_of_all("{}\0"s, "byte 2 is 0");
  expect_of_all("{} {}", "is no JSON: parse error at line 1, column 4");
}

TEST(ReadJson, NumbersFitADouble) {
  expect_of_all(R"({"a": {"b": [0, 1, 1e400]}})", "file: a/b/2: is no JSON: number overflow parsing '1e400'");
}

TEST(ReadJson, TextIsUtf8) { expect_of_all("{\"caf\xe9\": 1}", "is no JSON: parse error at line 1"); }

TEST(ReadJson, ADocumentOfTooManyValuesIsRefusedWhileItIsRead) {
  EXPECT_EQ(app::parse_json("[1, [2], {}]", "file", 5).size(), 3U);
  EXPECT_THROW(static_cast<void>(app::parse_json("[1, [2], {}]", "file", 4)), app::Error);
}

// Of linear cost: a parser that looks through the array again behind each of its objects does not end in a test's time.
TEST(ReadJson, LongArraysOfObjectsAreRead) {
  constexpr std::size_t COUNT = 400'000;
  std::string text = "[{}";
  for (std::size_t i = 1; i < COUNT; ++i) text += ",{}";
  EXPECT_EQ(app::parse_json(text + "]", "long.json").size(), COUNT);
}

TEST(ReadJson, WhatIsNoUtf8IsReplacedOnWriting) {
  EXPECT_EQ(app::json_text({{"scene", "caf\xe9\x7f\xc2\x9b.gltf"}}, -1), R"({"scene":"caf\ufffd\u007f\u009b.gltf"})")
      << "and no terminal acts on it";
}

TEST(ReadJson, ChunksFilledUpWithNulsAreRead) {
  std::string glb = triangle().glb();
  const std::size_t end = glb.find("BIN") - 4;
  std::size_t spaces = 0;
  while (glb[end - 1 - spaces] == ' ') glb[end - 1 - spaces++] = '\0';
  EXPECT_GT(spaces, 0U) << "else the test shows nothing";
  EXPECT_EQ(error_text(glb), "");
}

}  // namespace
}  // namespace lamp::test
