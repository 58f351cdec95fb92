// What a plan promises, held against what was found: the rule that `lamp verify` and the tests share.
// SPDX-License-Identifier: Apache-2.0
#include "render/judgement.h"

#include <gtest/gtest.h>

#include <limits>

#include "render/shaders/sky_cell.h"

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
  EXPECT_EQ(of_both({}, {.repeated = 4}).repeated, 4U);
}

/// Of a picture of 2 x 2 pixels: a cell of two of them, sky, and a cell of its own.
TEST(Verification, AddsUpPixelsAndTheirCells) {
  const Truth truth{.rows = 2, .offsets = {0, 1, 3, 3, 4}, .lights = {0, 0, 2, 2}, .boundary_pairs = 5};
  const std::vector<Visit> visits{{.visited = 2, .cell = 7},
                                  {.visited = 2, .cell = 7, .missed = 1, .first_missed = 2, .unordered = true},
                                  {.visited = 9, .cell = gpu::SKY_CELL},
                                  {.visited = 5, .cell = 9}};
  Verification verification(2);
  verification.add(truth, visits);
  const Findings found = verification.findings();
  EXPECT_EQ(found.missed, 1U);
  EXPECT_EQ(found.first_miss, "pixel (1, 0): light 2");
  EXPECT_EQ(found.evaluations, 9U);
  EXPECT_EQ(found.useful, 4U);
  EXPECT_EQ(found.boundary_pairs, 5U);
  EXPECT_EQ(found.list_max, 5U);
  EXPECT_EQ(found.list_sum, 7U);
  EXPECT_EQ(found.cells_seen, 2U);
  EXPECT_EQ(found.truth_sum, 3U) << "light 0 of cell 7 once";
  EXPECT_TRUE(found.unordered);
  EXPECT_EQ(verification.misses().size(), 1U);
  EXPECT_EQ(verification.misses()[0], (PixelMisses{.pixel = 1, .missed = 1}));

  Truth next = truth;  // rows below, which see the same cells
  next.first_row = 2;
  verification.add(next, visits);
  const Findings both = verification.findings();
  EXPECT_EQ(both.missed, 2U);
  EXPECT_EQ(both.list_sum, 7U);
  EXPECT_EQ(both.cells_seen, 2U);
  EXPECT_EQ(both.truth_sum, 3U);
  EXPECT_EQ(both.first_miss, found.first_miss);
  EXPECT_EQ(verification.misses()[1], (PixelMisses{.pixel = 5, .missed = 1}));
}

TEST(Verification, WhatTheDeviceEndsIsOfNoOtherNumber) {
  const Truth truth{.rows = 1, .offsets = {0, 1, 2}, .lights = {0, 1}};
  Verification verification(2);
  verification.add(truth, std::vector<Visit>{{.visited = 1, .cell = 0},
                                             {.visited = 7, .cell = 1, .missed = 1, .unordered = true, .ended = true}});
  const Findings found = verification.findings();
  EXPECT_EQ(found.unfollowed, 1U);
  EXPECT_EQ(found.first_unfollowed, "pixel (1, 0)");
  EXPECT_EQ(found.evaluations, 1U);
  EXPECT_EQ(found.missed, 0U);
  EXPECT_FALSE(found.unordered);
  EXPECT_EQ(found.truth_sum, std::nullopt) << "its cell may have more";
}

TEST(Verification, PicturesOfSeveralViewsStandSideBySide) {
  const HostDepth depth{.samples = 4, .views = 2};
  const Truth truth{.first_row = 3, .rows = 1, .offsets = {0, 0, 1}, .lights = {8}};
  Verification verification(2, depth);
  verification.add(truth, std::vector<Visit>{{.visited = 1, .cell = 0}, {.cell = 1, .missed = 1, .first_missed = 8}},
                   {.view = 1, .sample = 3});
  EXPECT_EQ(verification.findings().first_miss, "view 1, sample 3, pixel (1, 3): light 8");
  EXPECT_EQ(verification.misses()[0], (PixelMisses{.pixel = (3 * 2 + 1) * 2 + 1, .missed = 1}));
}

TEST(Verification, ListsAreTheSameInLengthAndLights) {
  const std::vector<Visit> lists{{.visited = 2, .hash = 5}, {.visited = 1, .hash = 6}};
  std::vector<Visit> others = lists;
  EXPECT_TRUE(same_lists(lists, others));
  others[1].visited = 3;
  EXPECT_FALSE(same_lists(lists, others));
  others[1] = {.visited = 1, .hash = 7};
  EXPECT_FALSE(same_lists(lists, others));
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

TEST(Verification, SumsBeyondThirtyTwoBitsDifferOnlyWhereOnePictureHasThem) {
  constexpr float INFINITE = std::numeric_limits<float>::infinity();
  const HdrImage beyond = image_with(INFINITE);
  EXPECT_EQ(max_abs_difference(beyond, beyond), 0.0F);
  EXPECT_EQ(max_abs_difference(beyond, image_with(9.0F)), INFINITE);
  const HdrImage broken = image_with(std::numeric_limits<float>::quiet_NaN());
  EXPECT_EQ(max_abs_difference(broken, broken), INFINITE);
  HdrImage translucent = beyond;
  translucent.pixels[0].a = 0.25F;
  EXPECT_EQ(max_abs_difference(beyond, translucent), 0.25F);
}

Verdict verdict_of(const Plan& plan, const Findings& findings, const std::optional<PictureDifference>& difference) {
  const Judgement judgement = judge(plan, findings, difference);
  const bool needs_reason = judgement.verdict == Verdict::failed || judgement.verdict == Verdict::unchecked;
  EXPECT_EQ(judgement.reason.empty(), !needs_reason) << judgement.reason;
  return judgement.verdict;
}

TEST(Judgement, APictureBeyondItsToleranceFails) {
  const Plan ordered{.ordered = true};
  const Plan unordered{.ordered = false};
  EXPECT_EQ(verdict_of(ordered, {}, std::nullopt), Verdict::ok);
  EXPECT_EQ(verdict_of(ordered, {}, {{.max_abs = 0.0F, .tolerance = 0.0F}}), Verdict::ok);
  EXPECT_EQ(verdict_of(ordered, {}, {{.max_abs = 1e-6F, .tolerance = 0.0F}}), Verdict::failed);
  EXPECT_EQ(verdict_of(unordered, {}, {{.max_abs = 1e-4F, .tolerance = 1e-3F}}), Verdict::ok);
  EXPECT_EQ(verdict_of(unordered, {}, {{.max_abs = 2e-3F, .tolerance = 1e-3F}}), Verdict::failed);
  constexpr float INFINITE = std::numeric_limits<float>::infinity();
  EXPECT_EQ(verdict_of(unordered, {}, {{.max_abs = INFINITE, .tolerance = INFINITE}}), Verdict::failed);
  EXPECT_EQ(judge(unordered, {}, {{.max_abs = INFINITE, .tolerance = INFINITE}}).reason, NOT_FINITE);
}

TEST(Judgement, MissesAndDisorderFailUnlessTheRowAllowsThem) {
  const PictureDifference none;
  const Findings missed{.missed = 1};
  const Findings disorder{.unordered = true};
  EXPECT_EQ(verdict_of({.ordered = false}, {.repeated = 1}, none), Verdict::failed);
  EXPECT_EQ(verdict_of({.ordered = true}, {.changed_runs = 1}, none), Verdict::failed);
  EXPECT_EQ(verdict_of({.ordered = true}, {.changed_runs = 0}, none), Verdict::ok);
  EXPECT_EQ(verdict_of({.ordered = false}, {.changed_runs = 1}, none), Verdict::ok);
  EXPECT_EQ(verdict_of({.ordered = false}, missed, none), Verdict::failed);
  EXPECT_EQ(verdict_of({.ordered = false, .approximate = true}, missed, {{.max_abs = 1.0F}}), Verdict::approximate);
  EXPECT_EQ(verdict_of({.ordered = false, .approximate = true}, {}, none), Verdict::ok);
  EXPECT_EQ(verdict_of({.ordered = true}, disorder, none), Verdict::failed);
  EXPECT_EQ(verdict_of({.ordered = true, .approximate = true}, disorder, none), Verdict::failed);
  EXPECT_EQ(verdict_of({.ordered = false}, disorder, none), Verdict::ok);
}

TEST(Judgement, WhatTheDeviceEndsCouldNotBeCheckedAndAMissElsewhereStillFails) {
  const Findings ended{.unfollowed = 2, .first_unfollowed = "pixel (1, 2)"};
  Findings missed = ended;
  missed.missed = 1;
  for (const bool approximate : {false, true}) {
    const Plan plan{.approximate = approximate};
    EXPECT_EQ(verdict_of(plan, ended, std::nullopt), Verdict::unchecked);
    EXPECT_EQ(verdict_of(plan, missed, std::nullopt), approximate ? Verdict::unchecked : Verdict::failed);
  }
  EXPECT_EQ(judge({}, ended, std::nullopt).reason,
            "the device ended the light walks of 2 pixels before their end, the first: pixel (1, 2)");
  EXPECT_EQ(of_both({}, ended).unfollowed, 2U);
  EXPECT_EQ(of_both({}, ended).first_unfollowed, "pixel (1, 2)");
}

TEST(Judgement, APictureOfLongerWalksThanTheDeviceIsSureToFinishSaysNothing) {
  const PictureDifference different{.max_abs = 1.0F};
  Plan plan;
  plan.lookup.most_walked = 100;
  EXPECT_EQ(verdict_of(plan, {.list_max = 100}, different), Verdict::failed);
  EXPECT_EQ(verdict_of(plan, {.list_max = 101}, different), Verdict::unchecked);
  EXPECT_EQ(verdict_of(plan, {.list_max = 101}, PictureDifference{}), Verdict::ok);
}

TEST(Judgement, TheWorseOneCounts) {
  const Judgement failed{Verdict::failed, "a"};
  const Judgement unchecked{Verdict::unchecked, "b"};
  EXPECT_EQ(worse_of(failed, unchecked).reason, "a");
  EXPECT_EQ(worse_of(unchecked, failed).reason, "a");
  EXPECT_EQ(worse_of(unchecked, {}).reason, "b");
  EXPECT_EQ(exit_of(Verdict::failed), Exit::check_failed);
  EXPECT_EQ(exit_of(Verdict::unchecked), Exit::unchecked);
  EXPECT_EQ(exit_of(Verdict::approximate), Exit::done);
  EXPECT_EQ(exit_of(Verdict::ok), Exit::done);
}

}  // namespace
}  // namespace lamp::app
