// Scripts that are wrong are refused before anything is done, with file, line and what was expected.
// SPDX-License-Identifier: Apache-2.0
#include "view/script.h"

#include <gtest/gtest.h>

namespace lamp::app {
namespace {

std::string error_of(const std::string& text) {
  try {
    static_cast<void>(parse_script(text, "demo.jsonl"));
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(Script, HasOneThingALine) {
  const auto script =
      parse_script("{\"wait\": 3}\n\n# a comment\n  {\"hold\": \"w\", \"frames\": 4}\r\n", "demo.jsonl");
  ASSERT_EQ(script.size(), 2);
  EXPECT_EQ(script[0].what, "wait");
  EXPECT_EQ(script[1].name, "demo.jsonl: line 4");
}

TEST(Script, SaysWhatIsWrong) {
  const std::vector<std::pair<std::string, std::string>> faults{
      {"{\"wait\": 3}\n{\"wayt\": 3}",
       "demo.jsonl: line 2: 'wayt': there is no such thing to do; the nearest are wait"},
      {"[]", "demo.jsonl: line 1: is [], expected an object"},
      {"{", "demo.jsonl: line 1"},
      {R"({"wait": 3, "key": "h"})", "expected one thing a line"},
      {R"({"wait": -3})", "wait is -3, expected a number of frames"},
      {R"({"wait": "ever"})", "wait is \"ever\", expected a number of frames"},
      {R"({"key": "ctrl+esc"})", "'esc': there is no such key; the nearest are"},
      {R"({"drag": [1, 2]})", "drag is 1, expected two numbers"},
      {R"({"set": 3})", "set is 3, expected an object"},
      {R"({"frames": 3})", "line 1: has frames alone, expected one of set, "},
      {R"({"wait": 3, "frames": 3})", "frames: belongs to hold, not to wait"},
      {R"({"expect": {"shown": 1}})", "line 1: expect: 'shown' is no place in the report, expected one such as /"},
      {R"({"expect": {"/shown/lights": {"mni": 1}}})",
       "/shown/lights is {\"mni\":1}, expected a value or numbers as min"},
  };
  for (const auto& [text, says] : faults) EXPECT_NE(error_of(text).find(says), std::string::npos) << error_of(text);
}

TEST(Keys, AreAllInTheHelp) {
  for (const KeyHelp& key : key_help()) {
    EXPECT_FALSE(key.does.empty());
    EXPECT_EQ(key.does.back(), '.') << key.keys;
  }
}

}  // namespace
}  // namespace lamp::app
