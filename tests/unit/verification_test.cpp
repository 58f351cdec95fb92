// What a plan promises, held against what was found: the rule that `lamp verify` and the tests share.
// SPDX-License-Identifier: Apache-2.0
#include "render/verification.h"

#include <gtest/gtest.h>

#include <limits>

namespace lamp::app {
namespace {

HdrImage image_with(float value) { return {.width = 2, .height = 1, .pixels = {glm::vec4(0.5F), glm::vec4(value)}}; }

TEST(Verification, APairThatBothLookUpsMissCountsOnce) {
  const Findings separate{.missed = 3, .evaluations = 10, .useful = 12, .first_miss = "pixel (1, 2): light 3"};
  const Findings fused{.missed = 3, .evaluations = 10, .useful = 12, .first_miss = "pixel (4, 5): light 6"};
  const Findings both = of_both(separate, fused);
  EXPECT_EQ(both.missed, 3);
  EXPECT_EQ(both.missed_fused, 3);
  EXPECT_EQ(both.evaluations, 10);
  EXPECT_EQ(both.useful, 12);
  EXPECT_EQ(both.first_miss, "pixel (1, 2): light 3");
}

TEST(Verification, WhatOnlyOneLookUpGetsWrongIsKept) {
  const Findings good{.evaluations = 10};
  const Findings faulty{.missed = 2, .unordered = true, .first_miss = "pixel (4, 5): light 6"};
  for (const Findings& both : {of_both(good, faulty), of_both(faulty, good)}) {
    EXPECT_EQ(both.missed, 2);
    EXPECT_TRUE(both.unordered);
    EXPECT_EQ(both.first_miss, "pixel (4, 5): light 6");
  }
  EXPECT_EQ(of_both(good, faulty).missed_fused, 2);
  EXPECT_EQ(of_both(faulty, good).missed_fused, 0);
}

TEST(Verification, TheGpuVerifiesWhereTheOracleIsSlow) {
  EXPECT_EQ(chosen(VerifierChoice::by_pairs, ORACLE_PAIRS), Verifier::oracle);
  EXPECT_EQ(chosen(VerifierChoice::by_pairs, ORACLE_PAIRS + 1), Verifier::gpu);
  EXPECT_EQ(chosen(VerifierChoice::gpu, 0), Verifier::gpu);
  EXPECT_EQ(chosen(VerifierChoice::oracle, ~0ULL), Verifier::oracle);
}

TEST(Verification, WhatWasNotCountedHasNoExcess) {
  EXPECT_EQ(Findings{.list_sum = 6}.excess(), std::nullopt);
  EXPECT_EQ((Findings{.list_sum = 6, .truth_sum = 4}.excess()), 1.5);
}

TEST(Verification, UnorderedListsMayRoundOrderedOnesMayNot) {
  const HdrImage reference = image_with(9.0F);
  EXPECT_EQ(largest_value(reference), 9.0F);
  EXPECT_EQ(picture_tolerance({.ordered = true}, reference), 0.0F);
  EXPECT_FLOAT_EQ(picture_tolerance({.ordered = false}, reference), 10.0F * UNORDERED_TOLERANCE);
}

TEST(Verification, APictureBeyondItsToleranceFails) {
  const Plan ordered{.ordered = true};
  const Plan unordered{.ordered = false};
  EXPECT_TRUE(keeps_promises(ordered, {}, {.max_abs = 0.0F, .tolerance = 0.0F}));
  EXPECT_FALSE(keeps_promises(ordered, {}, {.max_abs = 1e-6F, .tolerance = 0.0F}));
  EXPECT_TRUE(keeps_promises(unordered, {}, {.max_abs = 1e-4F, .tolerance = 1e-3F}));
  EXPECT_FALSE(keeps_promises(unordered, {}, {.max_abs = 2e-3F, .tolerance = 1e-3F}));
  constexpr float INFINITE = std::numeric_limits<float>::infinity();
  EXPECT_FALSE(keeps_promises(unordered, {}, {.max_abs = INFINITE, .tolerance = INFINITE}));
}

TEST(Verification, MissesAndDisorderFailUnlessTheRowAllowsThem) {
  const PictureDifference none;
  const Findings missed{.missed = 1};
  const Findings disorder{.unordered = true};
  EXPECT_FALSE(keeps_promises({.ordered = false}, {.repeated = 1}, none));
  EXPECT_FALSE(keeps_promises({.ordered = true}, {.changed_runs = 1}, none));
  EXPECT_TRUE(keeps_promises({.ordered = true}, {.changed_runs = 0}, none));
  EXPECT_TRUE(keeps_promises({.ordered = false}, {.changed_runs = 1}, none));
  EXPECT_FALSE(keeps_promises({.ordered = false}, missed, none));
  EXPECT_TRUE(keeps_promises({.ordered = false, .approximate = true}, missed, {.max_abs = 1.0F}));
  EXPECT_FALSE(keeps_promises({.ordered = true}, disorder, none));
  EXPECT_FALSE(keeps_promises({.ordered = true, .approximate = true}, disorder, none));
  EXPECT_TRUE(keeps_promises({.ordered = false}, disorder, none));
}

}  // namespace
}  // namespace lamp::app
