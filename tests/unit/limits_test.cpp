// The largest problems: 16 million lights, 16 384 x 16 384 pixels, and one beyond: planned, or refused in one line.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <glm/glm.hpp>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>

#include "lamplight/method.h"
#include "lamplight/shared/lamplight.h"
#include "unit/devices.h"

namespace lamp {
namespace {

constexpr std::uint32_t SIDE = 16384;

Problem problem_of(const Method& method, std::uint32_t width, std::uint32_t height, std::uint32_t lights,
                   const DeviceTraits& traits) {
  return {.width = width,
          .height = height,
          .light_capacity = lights,
          .options = resolve_options(method, {}).value(),
          .traits = traits};
}

class Limits : public ::testing::TestWithParam<const Method*> {};

TEST_P(Limits, SizesNeverShrinkAsAProblemGrows) {
  DeviceTraits boundless = test::LARGE_DEVICE;
  boundless.max_storage_buffer_bytes = ~0ULL;
  boundless.memory_bytes = ~0ULL;
  boundless.max_groups = {~0U, ~0U, ~0U};
  boundless.max_image_size = MAX_IMAGE_SIZE;
  const auto sizes = [&](std::uint32_t side, std::uint32_t lights) {
    std::map<std::string, std::uint64_t> bytes;
    const Result<Plan> plan = make_plan(*GetParam(), problem_of(*GetParam(), side, side, lights, boundless));
    EXPECT_TRUE(plan) << (plan ? "" : plan.error().text());
    if (!plan) return bytes;
    for (const BufferDesc& buffer : plan.value().buffers) bytes[buffer.name] = buffer.bytes;
    bytes["cells"] = plan.value().cells;
    return bytes;
  };
  // Cells grow with the picture in `lamplight`, and have bits or lists; the bits that clusters fall back to have a
  // limit.
  std::set<std::string> may_shrink{"cell depth ranges", "cell counts", "cell bits",  "cells", "pieces",
                                   "cell lists",        "piece lists", "tile spans", "hits"};
  if (GetParam()->result == "cluster_lists") may_shrink.insert("tile bits");
  for (std::uint32_t lights = 1024; lights < MAX_LIGHTS; lights *= 2)
    for (const auto& [name, bytes] : sizes(SIDE, lights))
      if (!may_shrink.contains(name)) {
        EXPECT_GE(sizes(SIDE, 2 * lights)[name], bytes) << name << ", " << 2 * lights << " lights";
      }
  for (std::uint32_t side = 64; side < MAX_IMAGE_SIZE / 2; side *= 2)
    for (const auto& [name, bytes] : sizes(side, MAX_LIGHTS))
      if (!may_shrink.contains(name)) {
        EXPECT_GE(sizes(2 * side, MAX_LIGHTS)[name], bytes) << name << ", " << 2 * side << " pixels a side";
      }
}

/// A plan within every limit, or a line that names a limit of the device.
void expect_planned_or_refused(const Method& method, const Problem& problem) {
  const Result<Plan> plan = make_plan(method, problem);
  if (!plan) {
    EXPECT_NE(plan.error().text().find("the device"), std::string::npos) << plan.error().text();
    return;
  }
  EXPECT_LE(plan.value().bytes(), problem.traits.memory_bytes);
  for (const BufferDesc& buffer : plan.value().buffers)
    EXPECT_LE(buffer.bytes, problem.traits.max_storage_buffer_bytes) << buffer.name;
}

TEST_P(Limits, SixteenMillionLightsAreAtLeastPlannedWhereListsHoldThem) {
  const Method& method = *GetParam();
  const bool bits = method.result.find("bits") != std::string_view::npos || method.result == "tile_zbins";
  const Result<Plan> uhd = make_plan(method, problem_of(method, 3840, 2160, MAX_LIGHTS, test::LARGE_DEVICE));
  EXPECT_EQ(uhd.ok(), !bits) << (uhd ? "planned" : uhd.error().text());
  if (bits) {
    EXPECT_NE(uhd.error().text().find("bits: needs"), std::string::npos) << uhd.error().text();
  }
  const Result<Plan> large = make_plan(method, problem_of(method, SIDE, SIDE, MAX_LIGHTS, test::LARGE_DEVICE));
  if (method.name == "all" || method.name == "tiled" || method.name == "clustered" || method.name == "lamplight") {
    EXPECT_TRUE(large) << (large ? "" : large.error().text());
  } else if (bits) {
    EXPECT_FALSE(large);
  }
}

TEST_P(Limits, EverySizeIsPlannedOrRefused) {
  DeviceTraits least = {};
  least.max_image_size = SIDE;
  for (const DeviceTraits& traits : {test::LARGE_DEVICE, least})
    for (const std::uint32_t side : {1U, 4096U, SIDE})
      for (const std::uint32_t lights : {0U, 1U << 16, 1U << 20, 1U << 21, MAX_LIGHTS})
        expect_planned_or_refused(*GetParam(), problem_of(*GetParam(), side, side, lights, traits));
}

TEST_P(Limits, OneBeyondIsRefused) {
  const Method& method = *GetParam();
  const Result<Plan> lights = make_plan(method, problem_of(method, 64, 64, MAX_LIGHTS + 1, test::LARGE_DEVICE));
  ASSERT_FALSE(lights);
  EXPECT_EQ(lights.error().text(), "light capacity: expected at most 16777216, got 16777217");
  const Result<Plan> size = make_plan(method, problem_of(method, 64, 32769, 1, test::LARGE_DEVICE));
  ASSERT_FALSE(size);
  EXPECT_EQ(size.error().text(), "size 64x32769: expected 1 to 32768 pixels a side on this device");
  DeviceTraits small = test::LARGE_DEVICE;
  small.max_storage_buffer_bytes = 64 * 1000;
  const Result<Plan> buffer = make_plan(method, problem_of(method, 8, 8, 1001, small));
  ASSERT_FALSE(buffer);
  EXPECT_NE(buffer.error().text().find("the device's storage buffers hold at most 64000"), std::string::npos)
      << buffer.error().text();
  DeviceTraits tight = test::LARGE_DEVICE;
  tight.memory_bytes = 1;
  const Result<Plan> memory = make_plan(method, problem_of(method, 64, 64, 64, tight));
  EXPECT_EQ(memory.ok(), method.name == "all" || method.still);  // they have no buffer of their own
  if (!memory) {
    EXPECT_NE(memory.error().text().find("memory: all buffers together need"), std::string::npos);
  }
}

INSTANTIATE_TEST_SUITE_P(Of, Limits, ::testing::ValuesIn([] {
                           std::vector<const Method*> all;
                           for (const Method& method : methods()) all.push_back(&method);
                           return all;
                         }()),
                         [](const auto& test) {
                           std::string name(test.param->name);
                           std::ranges::replace_if(name, [](unsigned char c) { return std::isalnum(c) == 0; }, '_');
                           return name;
                         });

TEST(LoopLimits, ADeviceThatEndsLoopsWalksNoMoreLights) {
  DeviceTraits traits = test::LARGE_DEVICE;
  traits.max_loop_rounds = 65535;
  const auto plan = [&](std::string_view name, std::uint32_t lights) {
    const Method& method = *find_method(name).value();
    return make_plan(method, problem_of(method, 640, 360, lights, traits));
  };
  EXPECT_TRUE(plan("all", 63487));  // shading takes two rounds more for every 64 of them
  const Result<Plan> all = plan("all", 63488);
  ASSERT_FALSE(all);
  EXPECT_EQ(all.error().text(),
            "method all: look-up all: walks 63488 lights, but the device ends a thread's loops after 65535 rounds");
  for (const char* name : {"tiled", "tiled-bits", "clustered"}) {
    EXPECT_TRUE(plan(name, 21845).value().notes.empty());
    ASSERT_EQ(plan(name, 21846).value().notes.size(), 1U);
    EXPECT_EQ(plan(name, 21846).value().notes.front(),
              "a pixel that walks more than 21845 lights can lose some: the device ends a thread's loops after 65535 "
              "rounds");
  }
  // Of the words of bits a subgroup looks for the least light of all its pixels.
  EXPECT_TRUE(plan("drobot-tiled", 10922).value().notes.empty());
  EXPECT_EQ(plan("drobot-tiled", 10923).value().notes.front(),
            "a pixel that walks more than 10922 lights can lose some: the device ends a thread's loops after 65535 "
            "rounds");
  EXPECT_TRUE(plan("world-cells", 285).value().notes.empty());
  EXPECT_EQ(
      plan("world-cells", 8191).value().notes,
      (std::vector<std::string>{
          "a point that walks more than 234 lights of more than four levels, whose ranges differ 16 times and more, "
          "can lose some: the device ends a thread's loops after 65535 rounds"}));
  EXPECT_EQ(plan("world-cells", 8192).value().notes.back(),
            "a pixel that walks more than 8191 lights can lose some: the device ends a thread's loops after 65535 "
            "rounds");
  // Of 32 threads of a subgroup, each may bring a cell of its own.
  EXPECT_TRUE(plan("olsson-clustered", 682).value().notes.empty());
  EXPECT_EQ(plan("olsson-clustered", 683).value().notes.front(),
            "a pixel that walks more than 682 lights can lose some: the device ends a thread's loops after 65535 "
            "rounds");
}

TEST(LoopLimits, LamplightWalksInAsManyStepsARoundAsItTakes) {
  DeviceTraits traits = test::LARGE_DEVICE;
  traits.max_loop_rounds = 65535;
  const Method& method = *find_method("lamplight").value();
  const auto plan = [&](std::uint32_t lights) {
    return make_plan(method, problem_of(method, 640, 360, lights, traits)).value();
  };
  EXPECT_EQ(plan(21845).lookup.name, "cell_lists");
  for (const auto& [lights, steps] :
       {std::pair{21846U, 1U}, {63000U, 1U}, {65536U, 2U}, {262144U, 8U}, {1U << 19, 16U}}) {
    const Plan stepped = plan(lights);
    EXPECT_EQ(stepped.lookup.name, "cell_lists_stepped");
    EXPECT_EQ(stepped.lookup.constants.back(), steps) << lights;
    EXPECT_GE(stepped.lookup.most_walked, lights);
    EXPECT_TRUE(stepped.notes.empty());
  }
  ASSERT_EQ(plan(1U << 20).notes.size(), 1U);
  EXPECT_EQ(plan(1U << 20).notes.front(),
            "a pixel that walks more than 1015791 lights can lose some: the device ends a thread's loops after 65535 "
            "rounds");
  traits.max_loop_rounds = 1;
  EXPECT_EQ(plan(1U << 20).lookup.most_walked, 0U) << "words without a light take all the rounds";
  ASSERT_EQ(plan(1U << 20).notes.size(), 1U);
}

// Pieces of cells are work groups of an indirect dispatch, which no check sees while it runs.
TEST(PieceLimits, PiecesStayBelowTheWorkGroupsOfADevice) {
  const Method& method = *find_method("lamplight").value();
  DeviceTraits traits = test::LARGE_DEVICE;
  traits.max_groups[0] = 65535;
  const Plan plan = make_plan(method, problem_of(method, 3840, 2160, MAX_LIGHTS, traits)).value();
  const auto pieces = std::ranges::find(plan.buffers, "pieces", &BufferDesc::name);
  EXPECT_LE(pieces->bytes / sizeof(shared::LightPiece), 65535);
  EXPECT_GT(pieces->bytes / sizeof(shared::LightPiece), 60000);
}

// A hit names its cell in HIT_CELL_BITS bits, whatever the picture.
TEST(CellLimits, EveryCellOfThePlannersLargestPicturesHasANumber) {
  const Method& method = *find_method("lamplight").value();
  DeviceTraits boundless = test::LARGE_DEVICE;
  boundless.max_storage_buffer_bytes = boundless.memory_bytes = ~0ULL;
  boundless.max_groups = {~0U, ~0U, ~0U};
  boundless.max_image_size = MAX_IMAGE_SIZE;
  std::uint64_t most = 0;
  for (const glm::uvec2 size : {glm::uvec2(MAX_IMAGE_SIZE), {MAX_IMAGE_SIZE, MAX_IMAGE_SIZE - 1}, {MAX_IMAGE_SIZE, 1}})
    for (const char* tile : {"tile=8", "tile=16", "tile=32"})
      for (const char* slices : {"slices=2", "slices=4", "slices=5", "slices=32"})
        for (const char* depth : {"depth=buffer", "depth=none"})
          for (const std::uint32_t lights : {1U, 1U << 17, MAX_LIGHTS}) {
            Problem problem = problem_of(method, size.x, size.y, lights, boundless);
            problem.options = resolve_options(method, {tile, slices, depth, "cells=list"}).value();
            const Plan plan = make_plan(method, problem).value();
            const std::uint64_t bytes = std::ranges::find(plan.buffers, "cells", &BufferDesc::name)->bytes;
            most = std::max(most, bytes / sizeof(shared::LightCell));
          }
  EXPECT_GT(most, 500'000U);
  EXPECT_LE(most, 1ULL << shared::HIT_CELL_BITS);
}

/// Lists that a plan keeps: of all its cells, or of each.
std::uint64_t entries_of(const Plan& plan, std::string_view option) {
  const auto found = std::ranges::find(plan.capacities, option, &Capacity::option);
  return found == plan.capacities.end() ? ~0ULL : found->entries;
}

TEST_P(Limits, SmallProblemsHaveRoomForEveryLightInEveryCell) {
  constexpr std::uint64_t SMALL = 5U << 18;
  const Method& method = *GetParam();
  std::uint32_t checked = 0;
  bool has_lists = false;
  for (const glm::uvec2 size : {glm::uvec2(1, 1), {320, 180}, {640, 360}, {4000, 3}, {1920, 1080}})
    for (const std::uint32_t lights : {1U, 129U, 600U, 1400U, 5000U, 65536U}) {
      const Plan plan = make_plan(method, problem_of(method, size.x, size.y, lights, test::LARGE_DEVICE)).value();
      // A list in shared memory holds no more than 2048.
      const bool is_limited = entries_of(plan, "capacity") != ~0ULL && lights > 2048;
      has_lists = has_lists || !plan.capacities.empty();
      if (plan.cells * lights > SMALL || is_limited) continue;
      SCOPED_TRACE(std::to_string(size.x) + "x" + std::to_string(size.y) + ", " + std::to_string(lights) + " lights");
      ++checked;
      EXPECT_GE(entries_of(plan, "capacity"), lights);
      EXPECT_GE(entries_of(plan, "mean_capacity"), plan.cells * lights);
      if (entries_of(plan, "mean_cells") == ~0ULL) continue;
      const std::uint64_t cell_bytes = std::ranges::find(plan.buffers, "cells", &BufferDesc::name)->bytes;
      const std::uint64_t pieces = (lights + shared::PIECE - 1) / shared::PIECE;
      EXPECT_GE(entries_of(plan, "mean_cells"), cell_bytes / sizeof(shared::LightCell) * pieces * shared::PIECE);
    }
  EXPECT_TRUE(checked > 1U || !has_lists);
}

TEST(SmallProblems, TakeNoMoreThanAskedForBelowADefault) {
  const auto entries = [](std::string_view name, std::string_view option, const std::string& value) {
    const Method& method = *find_method(name).value();
    Problem problem = problem_of(method, 320, 180, 600, test::LARGE_DEVICE);
    std::vector<std::string> settings{std::string(option) + "=" + value};
    if (name == "tiled" && option == "mean_capacity") settings.emplace_back("order=type");
    problem.options = resolve_options(method, settings).value();
    return entries_of(make_plan(method, problem).value(), option);
  };
  EXPECT_EQ(entries("clustered", "mean_capacity", "511"), 5U * 3 * 24 * 511);
  EXPECT_EQ(entries("clustered", "mean_capacity", "512"), 5U * 3 * 24 * 600);
  EXPECT_EQ(entries("tiled", "capacity", "511"), 511U);
  EXPECT_EQ(entries("tiled", "capacity", "512"), 600U);
  EXPECT_EQ(entries("tiled", "mean_capacity", "127"), 20U * 12 * 127);
  EXPECT_EQ(entries("tiled", "mean_capacity", "128"), 20U * 12 * 600);
  EXPECT_EQ(entries("lamplight", "mean_capacity", "31"), 20U * 12 * 31 + 4 * 600);
  EXPECT_EQ(entries("lamplight", "mean_capacity", "32"), 20U * 12 * 600);
}

// What large problems took before small ones had room for everything.
TEST(SmallProblems, LeaveLargeOnesAsTheyAre) {
  const auto entries = [](std::string_view name, std::string_view option, std::uint32_t lights) {
    const Method& method = *find_method(name).value();
    return entries_of(make_plan(method, problem_of(method, 1920, 1080, lights, test::LARGE_DEVICE)).value(), option);
  };
  EXPECT_EQ(entries("lamplight", "mean_capacity", 4096), 8160U * 32 + 4 * 4096);
  EXPECT_EQ(entries("lamplight", "mean_capacity", 65536), 8160U * 32 + 4 * 65536);
  EXPECT_EQ(entries("clustered", "mean_capacity", 65536), 30U * 17 * 24 * 512);
  EXPECT_EQ(entries("tiled", "capacity", 4096), 512U);
  EXPECT_EQ(entries("primal", "capacity", 4096), 1024U);
  EXPECT_EQ(entries("primal", "mean_capacity", 4096), 2040U * 128);
}

// Below that no light can miss its place: needles may be in every cell.
TEST(LamplightMemory, FewLightsHaveRoomInEveryCell) {
  const Method& method = *find_method("lamplight").value();
  const auto cell_entries = [&](std::uint32_t lights, const std::vector<std::string>& settings) {
    Problem problem = problem_of(method, 640, 360, lights, test::LARGE_DEVICE);
    problem.options = resolve_options(method, settings).value();
    return make_plan(method, problem).value().capacities.front().entries;
  };
  constexpr std::uint64_t CELLS = 10ULL * 6;  // of 64 pixels
  EXPECT_GE(cell_entries(1024, {}), CELLS * 1024);
  EXPECT_GE(cell_entries(2048, {}), CELLS * 2048);
  EXPECT_LT(cell_entries(65536, {}), CELLS * 65536);
  EXPECT_EQ(cell_entries(1024, {"mean_cells=0"}), CELLS * 2 * shared::PIECE);
}

// Bits need no scan and no scatter, and as much memory as there are lights and cells.
TEST(LamplightMemory, CellsHaveBitsWhileTheseAreSmall) {
  const Method& method = *find_method("lamplight").value();
  const auto passes = [&](std::uint32_t lights, const std::vector<std::string>& settings) {
    Problem problem = problem_of(method, 1920, 1080, lights, test::LARGE_DEVICE);
    problem.options = resolve_options(method, settings).value();
    const Plan plan = make_plan(method, problem).value();
    const bool has_bits = std::ranges::find(plan.buffers, "cell bits", &BufferDesc::name) != plan.buffers.end();
    EXPECT_EQ(has_bits, plan.passes.size() == 3);
    return plan.passes.size();
  };
  EXPECT_EQ(passes(shared::PIECE + 1, {}), 3U);
  EXPECT_EQ(passes(65536, {}), 3U);
  EXPECT_EQ(passes(262144, {}), 6U);
  EXPECT_EQ(passes(64, {"cells=list"}), 6U);
  EXPECT_EQ(passes(262144, {"cells=bits"}), 3U);
  // As few lights as a piece holds: cells look at them all, in one pass.
  EXPECT_EQ(passes(1, {}), 1U);
  EXPECT_EQ(passes(shared::PIECE, {}), 1U);
  EXPECT_EQ(passes(shared::PIECE, {"cells=bits"}), 3U);
}

TEST(LamplightMemory, CellsGatherNoMoreThanAPiece) {
  const Method& method = *find_method("lamplight").value();
  DeviceTraits traits = test::LARGE_DEVICE;
  const auto refusal = [&](std::uint32_t lights, const std::vector<std::string>& settings) {
    Problem problem = problem_of(method, 640, 360, lights, traits);
    problem.options = resolve_options(method, settings).value();
    const Result<Plan> plan = make_plan(method, problem);
    return plan ? "" : plan.error().text();
  };
  EXPECT_EQ(refusal(shared::PIECE, {"cells=gather"}), "");
  EXPECT_NE(refusal(shared::PIECE + 1, {"cells=gather"}).find("up to 128 lights"), std::string::npos);
  EXPECT_NE(refusal(64, {"cells=gather", "depth=none"}).find("option cells"), std::string::npos);
  EXPECT_NE(refusal(64, {"prune=pixel", "depth=none"}).find("option prune"), std::string::npos);
  EXPECT_EQ(refusal(64, {"cells=gather", "occlusion=radial", "boxes=shape"}), "");
  traits.max_storage_buffer_bytes = 40 * 23 * 64 * 4 - 4;  // less than the lists of all tiles, of 64 lights each
  EXPECT_NE(refusal(64, {"cells=gather"}).find("option cells"), std::string::npos);
}

TEST(LamplightMemory, AMillionLightsAt4KStayInTheirBudget) {
  constexpr std::uint64_t MIB = 1ULL << 20;
  const Method& method = *find_method("lamplight").value();
  const Plan plan = make_plan(method, problem_of(method, 3840, 2160, 1U << 20, test::LARGE_DEVICE)).value();
  EXPECT_LE(plan.bytes(), 48 * MIB);
  EXPECT_LE(std::ranges::find(plan.buffers, "tile lists", &BufferDesc::name)->bytes, 5 * MIB);
}

TEST(FramesInFlight, AreOneToFourAndWhatTheHostWritesHasASlotForEach) {
  const Method& method = *find_method("drobot-zbin").value();
  Problem problem = problem_of(method, 64, 64, 100, test::LARGE_DEVICE);
  problem.options = resolve_options(method, {"sort=cpu"}).value();
  const auto bytes = [&](std::uint32_t frames) {
    problem.frames_in_flight = frames;
    return make_plan(method, problem).value().bytes();
  };
  std::uint64_t written = 0;
  const Plan plan = make_plan(method, problem).value();
  for (const BufferDesc& buffer : plan.buffers)
    if (buffer.memory == BufferMemory::upload) written += buffer.bytes;
  EXPECT_GE(written, 4 * (100 + 8096)) << "the order of lights, a word for each bin";
  EXPECT_EQ(bytes(2), bytes(1) + written);
  EXPECT_EQ(bytes(4), bytes(1) + 3 * written);
  EXPECT_GE(bytes(1), 2 * written) << "what shaders read, and a slot that the host writes";
  for (const std::uint32_t frames : {0U, 5U}) {
    problem.frames_in_flight = frames;
    EXPECT_EQ(make_plan(method, problem).error().text(),
              "frames in flight: expected 1 to 4, got " + std::to_string(frames));
  }
  problem.options = resolve_options(method, {}).value();
  problem.frames_in_flight = 1;
  std::uint64_t counted = 0;
  const Plan sorted = make_plan(method, problem).value();
  for (const BufferDesc& buffer : sorted.buffers)
    if (buffer.memory == BufferMemory::counts) counted += sorted.all_bytes(buffer);
  EXPECT_EQ(bytes(4), bytes(1) + 3 * counted) << "nothing is written by the host";
}

}  // namespace
}  // namespace lamp
