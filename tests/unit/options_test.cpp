// Settings that become a method's options, and the names that are nearest to an unknown one.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "lamplight/method.h"

namespace {

using lamp::Method;

TEST(Options, HoldDefaultsAndWhatWasSet) {
  const Method& tiled = *lamp::find_method("tiled").value();
  EXPECT_EQ(lamp::resolve_options(tiled, {}).value().integer("tile"), 16U);
  const auto set = lamp::resolve_options(tiled, {"tile=32"});
  ASSERT_TRUE(set);
  EXPECT_EQ(set.value().integer("tile"), 32U);
  EXPECT_EQ(set.value().word("tile"), "32");
}

TEST(Options, AreGivenOnce) {
  const Method& tiled = *lamp::find_method("tiled").value();
  for (const char* again : {"tile=16", "tile=64"}) {
    const auto twice = lamp::resolve_options(tiled, {"tile=16", "test=exact", again});
    ASSERT_FALSE(twice) << again;
    EXPECT_TRUE(twice.error().source == "option tile") << twice.error().text();
  }
  EXPECT_EQ(lamp::resolve_options(tiled, {"tile=16", "tile=32"}).error().text(),
            "option tile: is given twice, expected once");
}

lamp::Problem problem_with(lamp::Options options) {
  return {.width = 640, .height = 360, .light_capacity = 5000, .options = std::move(options)};
}

TEST(Options, ThatAProblemDoesNotHaveAreTheMethodsDefaults) {
  int growing = 0;
  for (const Method& method : lamp::methods()) {
    SCOPED_TRACE(method.name);
    const auto bare = lamp::make_plan(method, problem_with({}));
    const auto defaults = lamp::make_plan(method, problem_with(lamp::resolve_options(method, {}).value()));
    ASSERT_EQ(bare.ok(), defaults.ok()) << (bare ? defaults : bare).error().text();
    if (!bare) continue;
    EXPECT_EQ(bare.value().bytes(), defaults.value().bytes());
    EXPECT_EQ(bare.value().lookup.constants, defaults.value().lookup.constants);
    const std::vector<std::uint32_t> needed(bare.value().capacities.size(), ~0U);
    const auto grown = lamp::grow_plan(method, problem_with({}), bare.value(), needed);
    if (grown) {
      EXPECT_EQ(grown->options.all().size(), method.options.size());
      ++growing;
    }
  }
  EXPECT_GT(growing, 0);
}

TEST(Options, OfAnotherMethodAreAnError) {
  const Method& tiled = *lamp::find_method("tiled").value();
  const auto made =
      lamp::make_plan(*lamp::find_method("all").value(), problem_with(lamp::resolve_options(tiled, {}).value()));
  ASSERT_FALSE(made);
  EXPECT_TRUE(made.error().text().ends_with(": method all has no options")) << made.error().text();
}

TEST(Options, AnUnknownKeyBringsTheKnownOnes) {
  const auto options = lamp::resolve_options(*lamp::find_method("tiled").value(), {"tle=8"});
  ASSERT_FALSE(options);
  EXPECT_EQ(options.error().source, "option 'tle'");
  EXPECT_TRUE(options.error().message.starts_with("method tiled has the options tile, ")) << options.error().message;
  const auto none = lamp::resolve_options(*lamp::find_method("all").value(), {"tile=8"});
  ASSERT_FALSE(none);
  EXPECT_EQ(none.error().text(), "option 'tile': method all has no options");
}

TEST(Options, AKeyWithoutAValueIsAnError) {
  for (const char* setting : {"tile", "", "tile:8"}) {
    const auto options = lamp::resolve_options(*lamp::find_method("tiled").value(), {setting});
    ASSERT_FALSE(options) << setting;
    EXPECT_EQ(options.error().text(), "option '" + std::string(setting) + "': expected KEY=VALUE");
  }
}

TEST(NearestNames, AreOrderedByEditsThenByName) {
  constexpr std::string_view NAMES[] = {"clustered", "tiled-bits", "tiled", "all"};
  using Names = std::vector<std::string>;
  EXPECT_EQ(lamp::nearest_names("tiled", NAMES), (Names{"tiled", "all", "tiled-bits"}));
  EXPECT_EQ(lamp::nearest_names("clusterd", NAMES, 1), Names{"clustered"});
  EXPECT_EQ(lamp::nearest_names("", NAMES, 2), (Names{"all", "tiled"})) << "every letter is an edit";
  EXPECT_EQ(lamp::nearest_names("bbb", std::span(NAMES).first(0)), Names{});
  EXPECT_EQ(lamp::nearest_names("x", NAMES, 0), Names{});
  EXPECT_EQ(lamp::nearest_names("x", NAMES, 9).size(), 4U);
  constexpr std::string_view TIES[] = {"b", "c", "a"};
  EXPECT_EQ(lamp::nearest_names("x", TIES), (Names{"a", "b", "c"}));
}

}  // namespace
