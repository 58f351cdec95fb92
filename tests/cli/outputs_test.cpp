// What the commands make: pictures, heat maps, numbers; the same again from the same seed.
// SPDX-License-Identifier: Apache-2.0
#include <ImfRgbaFile.h>

#include <algorithm>
#include <set>

#include "cli/cli_test.h"
#include "image/image.h"

namespace lamp::cli {
namespace {

using Outputs = CliTest;

// The Stats object of every run, and what a verified one has besides.
constexpr const char* STATS[] = {"device",   "driver", "scene",  "method",    "options",  "width",
                                 "height",   "lights", "frames", "passes",    "cull_ms",  "shade_ms",
                                 "frame_ms", "bytes",  "cells",  "list_mean", "list_max", "overflowed_cells"};
constexpr const char* VERIFIED[] = {
    "missed",         "evaluations", "useful",  "waste",  "excess",      "image_max_abs_diff",
    "boundary_pairs", "unfollowed",  "verdict", "reason", "approximate", "ordered"};

void expect_stats(const nlohmann::json& stats) {
  for (const char* key : STATS) EXPECT_TRUE(stats.contains(key)) << key;
  EXPECT_EQ(stats.at("scene"), "plane");
  EXPECT_EQ(stats.at("width"), 64);
  EXPECT_EQ(stats.at("height"), 36);
  EXPECT_GE(stats.at("lights").get<int>(), 8);
  EXPECT_GE(stats.at("cells").get<int>(), 1);
  EXPECT_TRUE(stats.at("options").is_object());
  std::uint64_t sum = 0;
  for (const auto& [name, bytes] : stats.at("bytes").items())
    if (name != "total") sum += bytes.get<std::uint64_t>();
  EXPECT_EQ(stats.at("bytes").at("total").get<std::uint64_t>(), sum);
  ASSERT_FALSE(stats.at("passes").empty());
  for (const nlohmann::json& pass : stats.at("passes")) {
    EXPECT_FALSE(pass.at("name").get<std::string>().empty());
    EXPECT_LE(pass.at("ms_p5").get<double>(), pass.at("ms_median").get<double>());
    EXPECT_LE(pass.at("ms_median").get<double>(), pass.at("ms_p95").get<double>());
  }
}

bool is_one_colour(const app::LdrImage& image) {
  return std::ranges::all_of(image.pixels, [&](const glm::u8vec4& pixel) { return pixel == image.pixels.front(); });
}

TEST_F(Outputs, RenderSaysWhatWouldFit) {
  const auto rendered_with = [this](const std::string& capacity) {
    return json_of(small({"render", "--method", "clustered", "--json", "--option", "mean_capacity=" + capacity}));
  };
  const nlohmann::json overflowed = rendered_with("1");
  EXPECT_GT(overflowed.at("overflowed_cells"), 0);
  const std::string needed = overflowed.at("fits_with").at("mean_capacity");
  EXPECT_GT(std::stoi(needed), 1);
  const nlohmann::json fits = rendered_with(needed);
  EXPECT_EQ(fits.at("overflowed_cells"), 0);
  EXPECT_FALSE(fits.contains("fits_with"));
}

TEST_F(Outputs, GrowMakesRoomAndSaysSo) {
  const auto grown = [this](std::vector<std::string> arguments) {
    const std::vector<std::string> tight = {"--method", "clustered", "--option", "mean_capacity=1", "--json", "--grow"};
    arguments.insert(arguments.end(), tight.begin(), tight.end());
    return json_of(small(arguments));
  };
  const nlohmann::json rendered = grown({"render"});
  const nlohmann::json verified = grown({"verify", "--runs", "3"}).at(0);
  EXPECT_EQ(verified.at("changed_runs"), 0);
  for (const nlohmann::json& stats : {rendered, verified}) {
    EXPECT_EQ(stats.at("overflowed_cells"), 0);
    const std::string capacity = stats.at("options").at("mean_capacity");
    EXPECT_GT(std::stoi(capacity), 1);
    EXPECT_EQ(stats.at("notes").back(), "room was made with mean_capacity=" + capacity);
  }
}

// A depth buffer's lists fit; those at any depth, for the corridor's glass, do not.
TEST_F(Outputs, RenderCountsWhatDoesNotFitForTransparentSurfaces) {
  const auto rendered = [this](const char* more) {
    return output_of({"render", "corridor", "--method", "lamplight", "--lights", "16384", "--range", "200", "--size",
                      "40x40", "--samples", "1", more});
  };
  const nlohmann::json short_lists = nlohmann::json::parse(rendered("--json"));
  EXPECT_EQ(short_lists.at("overflowed_cells"), 0);
  EXPECT_GT(short_lists.at("transparent").at("overflowed_cells"), 0);
  EXPECT_EQ(short_lists.at("transparent").at("method"), "lamplight");
  EXPECT_GT(short_lists.at("transparent").at("bytes"), 0);
  EXPECT_NE(rendered("--frames=1").find("overflow  of transparent surfaces' own lists"), std::string::npos);
  const std::string grown = rendered("--grow");
  EXPECT_EQ(grown.find("\noverflow"), std::string::npos) << grown;
  EXPECT_NE(grown.find("room was made for transparent surfaces with depth=none, mean_capacity="), std::string::npos);
}

TEST_F(Outputs, EitherVerifierFindsTheSame) {
  const auto verified_by = [this](const char* verifier) {  // one method of each kind; tests/gpu has them all
    return json_of(small({"verify", "--json", "--verifier", verifier, "--method", "tiled", "--method", "clustered",
                          "--method", "stewart", "--method", "lamplight", "--method", "world-tree"}));
  };
  const nlohmann::json oracle = verified_by("oracle");
  const nlohmann::json gpu = verified_by("gpu");
  ASSERT_EQ(oracle.size(), gpu.size());
  for (std::size_t i = 0; i < oracle.size(); ++i) {
    SCOPED_TRACE(oracle[i].at("method").get<std::string>());
    EXPECT_EQ(oracle[i].at("verifier"), "oracle");
    EXPECT_EQ(gpu[i].at("verifier"), "gpu");
    for (const char* key : {"missed", "evaluations", "useful", "waste", "list_mean", "list_max", "image_max_abs_diff",
                            "boundary_pairs", "unfollowed", "verdict", "reason", "approximate", "ordered"})
      EXPECT_EQ(oracle[i].at(key), gpu[i].at(key)) << key;
    if (oracle[i].at("missed") == 0) {
      EXPECT_EQ(oracle[i].at("excess"), gpu[i].at("excess"));
    }
  }
}

TEST_F(Outputs, VerifyPrintsStatsOfEveryMethod) {
  const nlohmann::json all = json_of(small({"verify", "--json"}));
  ASSERT_TRUE(all.is_array());
  std::set<std::string> ordered;
  std::set<std::string> approximate;
  const nlohmann::json table = json_of({"list", "methods", "--json"});
  for (const nlohmann::json& row : table) {
    if (row.at("approximate")) approximate.insert(row.at("name"));
    if (row.at("ordered") && !row.at("approximate")) ordered.insert(row.at("name"));
  }
  EXPECT_EQ(all.size(), table.size());
  for (const nlohmann::json& stats : all) {
    SCOPED_TRACE(stats.at("method").get<std::string>());
    expect_stats(stats);
    for (const char* key : VERIFIED) EXPECT_TRUE(stats.contains(key)) << key;
    EXPECT_TRUE(stats.at("missed") == 0 || approximate.contains(stats.at("method")));
    EXPECT_EQ(stats.at("verdict"), stats.at("missed") == 0 ? "ok" : "approximate");
    EXPECT_EQ(stats.at("reason"), "");
    EXPECT_EQ(stats.at("approximate"), approximate.contains(stats.at("method")));
    EXPECT_TRUE(stats.at("ordered") == ordered.contains(stats.at("method")) || stats.at("approximate"));
    EXPECT_GT(stats.at("useful").get<int>(), 0);
    EXPECT_GE(stats.at("evaluations").get<int>(), stats.at("useful").get<int>());
    EXPECT_GE(stats.at("waste").get<double>(), 1.0);
    EXPECT_GE(stats.at("excess").get<double>(), 1.0);
    EXPECT_TRUE(stats.at("image_max_abs_diff") == 0.0 || !ordered.contains(stats.at("method")));
  }
}

// A list that does not fit means all lights, more than a software device's loops have rounds for.
TEST_F(Outputs, VerifySaysWhatCouldNotBeChecked) {
  const Arguments crowded{"verify",   "plane", "--lights", "66000",       "--size",    "16x9",
                          "--method", "tiled", "--option", "capacity=16", "--verifier"};
  for (const char* verifier : {"oracle", "gpu"}) {
    SCOPED_TRACE(verifier);
    Arguments command = crowded;
    command.emplace_back(verifier);
    const Outcome table = lamp(command);
    if (table.exit_code == 0) GTEST_SKIP() << "the device ends no loops";
    EXPECT_EQ(table.exit_code, UNCHECKED) << table.out << table.err;
    EXPECT_NE(table.out.find("could not check"), std::string::npos) << table.out;
    EXPECT_NE(table.out.find("the device ended the light walks of "), std::string::npos) << table.out;
    EXPECT_EQ(table.out.find("FAILED"), std::string::npos) << table.out;
    command.emplace_back("--json");
    const nlohmann::json row = nlohmann::json::parse(lamp(command).out).at(0);
    EXPECT_EQ(row.at("verdict"), "could not check");
    EXPECT_TRUE(row.at("reason").get<std::string>().starts_with("the device ended the light walks of "));
    EXPECT_EQ(row.at("missed"), 0);
    EXPECT_GT(row.at("unfollowed").get<int>(), 0);
    EXPECT_TRUE(row.at("excess").is_null());
    EXPECT_FALSE(row.at("excess_reason").get<std::string>().empty());
  }
}

// Brute force's shading loses lights beyond that: its row cannot be had, and no picture is held against its.
TEST_F(Outputs, VerifyOfEveryMethodLeavesOutWhatTheDeviceCannotWalk) {
  const Outcome all = lamp({"verify", "plane", "--lights", "65000", "--size", "8x8"});
  if (all.out.find("pictures not compared") == std::string::npos) GTEST_SKIP() << "the device ends no loops";
  EXPECT_EQ(all.exit_code, UNCHECKED) << all.out << all.err;
  EXPECT_NE(all.out.find("all                      could not check: method all: look-up all: walks 65001 lights"),
            std::string::npos)
      << all.out;
  EXPECT_EQ(all.out.find("FAILED"), std::string::npos) << all.out;
}

TEST_F(Outputs, LightsWithoutRangeReachEverything) {
  const nlohmann::json row = json_of({"verify", "wall", "--lights", "600", "--spots", "0", "--range", "inf", "--size",
                                      "16x9", "--method", "stewart", "--method", "tight", "--json"});
  for (const nlohmann::json& stats : row) {
    EXPECT_EQ(stats.at("verdict"), "ok");
    EXPECT_EQ(stats.at("useful").get<int>() % 600, 0) << "every light at every pixel, and none of the scene's own";
  }
}

TEST_F(Outputs, WhatIsInfiniteIsNullInJsonAndExplained) {
  const Arguments useless{"verify", "atrium", "--lights", "8",        "--range",
                          "0.0001", "--size", "16x9",     "--method", "all"};
  const std::string table = output_of(useless);
  EXPECT_NE(table.find("inf: lights are walked, and none of them reaches its pixel"), std::string::npos) << table;
  Arguments as_json = useless;
  as_json.emplace_back("--json");
  const nlohmann::json row = json_of(as_json).at(0);
  for (const std::string key : {"waste", "excess"}) {
    EXPECT_TRUE(row.at(key).is_null());
    EXPECT_EQ(row.at(key + "_reason"), "lights are walked, and none of them reaches its pixel");
  }
  EXPECT_NE(output_of({"verify", "--help"}).find("inf"), std::string::npos);
}

TEST_F(Outputs, VerifyTakesMethodsAndTheirOptions) {
  const nlohmann::json both = json_of(small({"verify", "--json", "--method", "clustered", "--method", "tiled"}));
  ASSERT_EQ(both.size(), 2U);
  EXPECT_EQ(both[0].at("method"), "clustered");
  EXPECT_EQ(both[1].at("method"), "tiled");
  const nlohmann::json one = json_of(small({"verify", "--json", "--method", "tiled", "--option", "tile=8"}));
  ASSERT_EQ(one.size(), 1U);
  EXPECT_EQ(one[0].at("options").at("tile"), "8");
  EXPECT_EQ(one[0].at("cells"), 8 * 5);
  const std::string table = output_of(small({"verify", "--method", "tiled"}));
  EXPECT_NE(table.find("missed"), std::string::npos);
  EXPECT_NE(table.find("  ok\n"), std::string::npos) << table;
}

TEST_F(Outputs, RenderWritesAllItIsAskedFor) {
  const std::string text = output_of(small({"render", "--method", "clustered", "--out", "new/lamp.png", "--heatmap",
                                            "heat.png", "--overlay", "over.png", "--stats", "stats.json"}));
  for (const char* file : {"new/lamp.png", "heat.png", "over.png", "stats.json"})
    EXPECT_NE(text.find(file), std::string::npos) << file;
  EXPECT_EQ(text.find('\033'), std::string::npos) << "escape codes in a pipe";
  EXPECT_EQ(text.find('\r'), std::string::npos) << "progress in a pipe";
  EXPECT_EQ(files(), (std::vector<std::string>{"heat.png", "new", "new/lamp.png", "over.png", "stats.json"}));

  const app::LdrImage picture = app::read_png(path("new/lamp.png"));
  EXPECT_EQ(picture.width, 64U);
  EXPECT_EQ(picture.height, 36U);
  EXPECT_FALSE(is_one_colour(picture));
  for (const char* map : {"heat.png", "over.png"}) {
    const app::LdrImage image = app::read_png(path(map));
    EXPECT_GE(image.width, 64U) << map;
    EXPECT_GE(image.height, 36U) << map;
    EXPECT_FALSE(is_one_colour(image)) << map;
  }
  const nlohmann::json stats = nlohmann::json::parse(read("stats.json"));
  expect_stats(stats);
  EXPECT_EQ(stats.at("method"), "clustered");
  EXPECT_FALSE(stats.contains("missed")) << "nothing was held against the oracle";
}

TEST_F(Outputs, RenderPrintsItsNumbersAsJson) {
  expect_stats(json_of(small({"render", "--json"})));
  EXPECT_EQ(files(), std::vector<std::string>{"lamp.png"});
}

TEST_F(Outputs, ExrHoldsLinearLight) {
  (void)output_of(small({"render", "--out", "lamp.exr"}));
  EXPECT_EQ(files(), std::vector<std::string>{"lamp.exr"});
  Imf::RgbaInputFile file(path("lamp.exr").c_str());
  const Imath::Box2i window = file.dataWindow();
  ASSERT_EQ(window.max.x - window.min.x + 1, 64);
  ASSERT_EQ(window.max.y - window.min.y + 1, 36);
  std::vector<Imf::Rgba> pixels(64 * 36);
  file.setFrameBuffer(pixels.data() - window.min.x - window.min.y * 64, 1, 64);
  file.readPixels(window.min.y, window.max.y);
  EXPECT_TRUE(std::ranges::all_of(pixels, [](const Imf::Rgba& p) { return p.r >= 0.0F && p.r.isFinite(); }));
  EXPECT_TRUE(std::ranges::any_of(pixels, [](const Imf::Rgba& p) { return p.r > 0.0F; }));
}

TEST_F(Outputs, CompareShowsTwoMethodsSideBySide) {
  const nlohmann::json json = json_of(small({"compare", "tiled", "clustered", "--json", "--out", "two.png"}));
  expect_stats(json.at("a"));
  expect_stats(json.at("b"));
  EXPECT_EQ(json.at("a").at("method"), "tiled");
  EXPECT_EQ(json.at("b").at("method"), "clustered");
  EXPECT_EQ(json.at("image_max_abs_diff"), 0.0);
  EXPECT_GE(app::read_png(path("two.png")).width, 4U * 64U);
  const std::string table = output_of(small({"compare", "tiled", "clustered", "--out", "two.png"}));
  EXPECT_NE(table.find("largest difference of the pictures: 0\n"), std::string::npos) << table;
}

TEST_F(Outputs, CompareTakesOptionsOfEachMethod) {
  const nlohmann::json json = json_of(small({"compare", "tiled:tile=8", "tiled:tile=32,bounds=mask", "--json"}));
  EXPECT_EQ(json.at("a").at("options").at("tile"), "8");
  EXPECT_EQ(json.at("b").at("options").at("tile"), "32");
  EXPECT_EQ(json.at("b").at("options").at("bounds"), "mask");
  EXPECT_EQ(json.at("image_max_abs_diff"), 0.0);
  const std::string table = output_of(small({"compare", "tiled:tile=8", "all"}));
  EXPECT_NE(table.find("\ntiled:tile=8 "), std::string::npos) << table;
}

TEST_F(Outputs, AnEndingMayBeInCapitals) {
  for (const char* file : {"a.PNG", "b.png", "c.EXR", "d.exr"}) (void)output_of(small({"render", "--out", file}));
  EXPECT_EQ(read("a.PNG"), read("b.png"));
  EXPECT_EQ(read("c.EXR"), read("d.exr"));
  const std::string words =
      output_of({"verify", "plane", "--points", "9", "--lights", "8", "--method", "world-cells", "--cut", "cut.PNG"});
  EXPECT_NE(words.find("\npicture: cut.PNG\n"), std::string::npos) << words;
}

TEST_F(Outputs, SameSeedSamePicture) {
  for (const char* file : {"a.png", "b.png"}) (void)output_of(small({"render", "--seed", "7", "--out", file}));
  (void)output_of(small({"render", "--seed", "8", "--out", "c.png"}));
  EXPECT_EQ(read("a.png"), read("b.png"));
  EXPECT_NE(read("a.png"), read("c.png"));
}

TEST_F(Outputs, AFrameOfTheFlightIsAnotherPicture) {
  for (const char* frame : {"0", "40"})
    (void)output_of(small({"render", "--frame", frame, "--out", std::string(frame) + ".png"}));
  EXPECT_NE(read("0.png"), read("40.png"));
}

TEST_F(Outputs, AnOldFileSurvivesAFailureAndIsReplacedBySuccess) {
  write("lamp.png", "old");
  EXPECT_EQ(lamp({"render", "nowhere.gltf"}).exit_code, 2);
  EXPECT_EQ(read("lamp.png"), "old");
  (void)output_of(small({"render"}));
  EXPECT_TRUE(read("lamp.png").starts_with("\x89PNG"));
  EXPECT_EQ(files(), std::vector<std::string>{"lamp.png"});
}

// Also where nothing is there yet, not even the folder.
TEST_F(Outputs, LinksAreFollowed) {
  namespace fs = std::filesystem;
  fs::create_symlink("new/target.png", path("lamp.png"));
  fs::create_symlink("new/frame", path("frame"));
  fs::create_symlink("new/bench", path("bench"));
  fs::create_symlink("new/page.html", path("page.html"));
  for (int i = 0; i < 2; ++i) {
    (void)output_of(small({"render", "--method", "tiled", "--heatmap", "heat.png"}));
    (void)output_of(small({"capture", "--out", "frame"}));
    (void)output_of(small({"bench", "--method", "tiled", "--frames", "1", "--out", "bench"}));
    (void)output_of({"report", "bench/results.json", "--out", "page.html"});
    for (const char* link : {"lamp.png", "frame", "bench", "page.html"})
      EXPECT_TRUE(fs::is_symlink(path(link))) << link;
  }
  EXPECT_TRUE(read("new/target.png").starts_with("\x89PNG"));
  for (const char* file : {"new/frame/frame.json", "new/bench/results.json", "new/page.html"})
    EXPECT_TRUE(fs::is_regular_file(path(file))) << file;
  expect_error(BAD_INPUT, small({"render", "--heatmap", "new/target.png"}), {"new/target.png: is asked for twice"});
  fs::create_symlink("circle.png", path("circle.png"));
  const Outcome circle = lamp(small({"render", "--out", "circle.png"}));
  EXPECT_EQ(circle.exit_code, BAD_INPUT);
  EXPECT_NE(circle.err.find("circle.png: cannot be written: Too many levels of symbolic links"), std::string::npos);
  (void)output_of(small({"capture", "--out", "frame/../other"}));  // beside the folder that the link leads to
  EXPECT_TRUE(fs::is_regular_file(path("new/other/frame.json")));
}

TEST_F(Outputs, ErrorsNameTheFileAndTheReason) {
  std::filesystem::create_symlink("/dev/full", path("full.png"));
  std::filesystem::create_symlink("/dev/full", path("full.json"));
  std::filesystem::create_symlink("/dev/full", path("full.html"));
  const char* reason = "No space left on device";
  expect_error(BAD_INPUT, small({"render", "--out", "full.png"}), {"full.png: cannot be written: ", reason});
  expect_error(BAD_INPUT, small({"compare", "all", "tiled", "--out", "full.png"}),
               {"full.png: cannot be written", reason});
  const Outcome stats = lamp(small({"render", "--stats", "full.json"}));
  EXPECT_EQ(stats.exit_code, BAD_INPUT);
  EXPECT_NE(stats.err.find(reason), std::string::npos) << stats.err;
  const std::string long_name(300, 'x');
  expect_error(BAD_INPUT, small({"render", "--out", long_name + ".png"}), {long_name, "File name too long"});
  expect_error(BAD_INPUT, small({"capture", "--out", long_name}), {long_name, "File name too long"});
  expect_error(BAD_INPUT, small({"bench", "--method", "tiled", "--out", long_name}), {long_name, "File name too long"});
  (void)output_of(small({"render", "--method", "tiled", "--out", long_name.substr(0, 251) + ".png"}));
}

TEST_F(Outputs, AFolderForTemporaryFilesThatIsNone) {
  expect_error(BAD_INPUT, small({"render", "--shader-dir", LAMPLIGHT_SOURCE_DIR}),
               {"/nonexistent/lamp-", "No such file or directory", "TMPDIR"}, {{"TMPDIR", "/nonexistent"}});
  expect_error(BAD_INPUT, small({"render", "--shader-dir", LAMPLIGHT_SOURCE_DIR}),
               {"glslc: cannot be started: No such file or directory"}, {{"PATH", "/nonexistent"}});
  std::filesystem::create_directory(path("bin"));
  std::filesystem::create_symlink("/bin/true", path("bin/glslc"));
  expect_error(BAD_INPUT, small({"render", "--shader-dir", LAMPLIGHT_SOURCE_DIR}), {"glslc gave no SPIR-V"},
               {{"PATH", path("bin").string()}});
  // Only what compiles shaders needs one.
  EXPECT_EQ(lamp(small({"render", "--method", "tiled"}), {{"TMPDIR", "/nonexistent"}}).exit_code, 0);
}

TEST_F(Outputs, ShadersOfACheckoutGiveTheSamePicture) {
  (void)output_of(small({"render", "--out", "embedded.png"}));
  (void)output_of(small({"render", "--out", "anew.png", "--shader-dir", LAMPLIGHT_SOURCE_DIR}));
  EXPECT_EQ(read("embedded.png"), read("anew.png"));
}

}  // namespace
}  // namespace lamp::cli
