// Text of unknown origin: nothing in it steers a terminal, and no message is longer than one reads.
// SPDX-License-Identifier: Apache-2.0
#include "files/printable.h"

#include <gtest/gtest.h>

#include "error.h"

namespace lamp::app {
namespace {

using namespace std::string_literals;

TEST(Printable, WordsOfAnyLanguageStayAsTheyAre) {
  for (const char* text : {"", "atrium", "Straße", "回廊", "🔦 lamp", "a\\b"}) EXPECT_EQ(printable(text), text);
}

TEST(Printable, ControlCharactersAreEscaped) {
  EXPECT_EQ(printable("red\x1b[31m"), "red\\x1b[31m");
  EXPECT_EQ(printable("two\nlines\r"), "two\\nlines\\x0d");
  EXPECT_EQ(printable("a\0b"s), "a\\x00b");
  EXPECT_EQ(printable("\x7f"), "\\x7f");
  EXPECT_EQ(printable("\xc2\x9b"
                      "31m"),
            "\\xc2\\x9b31m")
      << "the second set of control characters";
}

TEST(Printable, BytesThatAreNoUtf8AreEscaped) {
  EXPECT_EQ(printable("caf\xe9"), "caf\\xe9");
  EXPECT_EQ(printable("\xe5\x9b"), "\\xe5\\x9b") << "cut";
  EXPECT_EQ(printable("\xc0\xaf"), "\\xc0\\xaf") << "longer than it need be";
  EXPECT_EQ(printable("\xff\x80"), "\\xff\\x80");
}

TEST(Printable, AMessageKeepsItsBeginningAndItsEnd) {
  const std::string value(100'000, 'x');
  const std::string line = Error("scene.gltf: image 3: uri is '" + value + "', expected a relative path").what();
  EXPECT_LT(line.size(), 700U);
  EXPECT_TRUE(line.starts_with("scene.gltf: image 3: uri is 'xxx")) << line;
  EXPECT_TRUE(line.ends_with("xxx', expected a relative path")) << line;
  std::string wide;
  for (int i = 0; i < 1000; ++i) wide += "回";
  EXPECT_EQ(printable(one_line(wide)), one_line(wide)) << "is cut between characters";
}

}  // namespace
}  // namespace lamp::app
