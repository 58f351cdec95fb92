// Lines that are broken at blanks.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "system/print.h"

namespace lamp::app {
namespace {

TEST(Wrapped, BreaksAtBlanks) {
  EXPECT_EQ(wrapped("", 10, 2), "");
  EXPECT_EQ(wrapped("one two", 7, 2), "one two");
  EXPECT_EQ(wrapped("one two", 6, 2), "one\n  two");
  EXPECT_EQ(wrapped("one two three", 10, 2), "one two\n  three");
  EXPECT_EQ(wrapped("times     cull 1, shade 2", 17, 10), "times     cull 1,\n          shade 2");
}

TEST(Wrapped, KeepsWordsThatFitNowhere) {
  EXPECT_EQ(wrapped("picture   a/very/long/name.png", 12, 10), "picture   a/very/long/name.png");
  EXPECT_EQ(wrapped("a longword b", 4, 0), "a\nlongword\nb");
}

TEST(Wrapped, CountsLetters) { EXPECT_EQ(wrapped("\u00b5\u00b5 \u00b5\u00b5", 5, 0), "\u00b5\u00b5 \u00b5\u00b5"); }

}  // namespace
}  // namespace lamp::app
