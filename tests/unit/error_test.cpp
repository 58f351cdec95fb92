// Errors and results: the one line, and which of the two a Result holds.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/error.h"

#include <gtest/gtest.h>

#include <memory>
#include <type_traits>

#include "error.h"

namespace {

using lamp::Error;
using lamp::Result;

// A text alone would be half an error; worse, `throw Error("...")` would mean the wrong type where app/error.h is
// missing.
static_assert(!std::is_constructible_v<Error, std::string>);
static_assert(!std::is_constructible_v<Error, const char*>);

TEST(Error, TextNamesTheSourceIfThereIsOne) {
  EXPECT_EQ((Error{"light 3", "range must be > 0"}.text()), "light 3: range must be > 0");
  EXPECT_EQ((Error{"", "range must be > 0"}.text()), "range must be > 0");
}

TEST(Result, HoldsAValueOrAnError) {
  Result<int> good = 7;
  ASSERT_TRUE(good.ok());
  EXPECT_TRUE(static_cast<bool>(good));
  EXPECT_EQ(good.value(), 7);
  good.value() = 8;
  EXPECT_EQ(std::as_const(good).value(), 8);

  const Result<int> bad = Error{"option tile", "too large"};
  EXPECT_FALSE(bad.ok());
  EXPECT_FALSE(static_cast<bool>(bad));
  EXPECT_EQ(bad.error().source, "option tile");
  EXPECT_EQ(bad.error().message, "too large");
}

TEST(Result, MovesWhatCannotBeCopied) {
  Result<std::unique_ptr<int>> made = std::make_unique<int>(5);
  ASSERT_TRUE(made);
  const std::unique_ptr<int> taken = std::move(made.value());
  EXPECT_EQ(*taken, 5);
}

TEST(ResultDeathTest, ReadingWhatIsNotThereSaysWhatToDo) {
#ifdef NDEBUG
  GTEST_SKIP() << "assertions are off in this build";
#else
  EXPECT_DEATH((void)Result<int>(Error{"a", "b"}).value(), "check ok\\(\\) before value\\(\\)");
  EXPECT_DEATH((void)Result<int>(1).error(), "check ok\\(\\) before error\\(\\)");
#endif
}

TEST(AppError, CarriesTheLineAndTheExitCode) {
  const lamp::app::Error plain("scene.gltf: light 3: range must be > 0");
  EXPECT_STREQ(plain.what(), "scene.gltf: light 3: range must be > 0");
  EXPECT_EQ(plain.exit(), lamp::app::Exit::bad_input);
  const lamp::app::Error of_library(Error{"device X", "lacks it"}, lamp::app::Exit::no_device);
  EXPECT_STREQ(of_library.what(), "device X: lacks it");
  EXPECT_EQ(of_library.exit(), lamp::app::Exit::no_device);
}

}  // namespace
