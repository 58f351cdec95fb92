// Suites as data: the built-in ones, what a file may say, what it may not, and what it multiplies out to.
// SPDX-License-Identifier: Apache-2.0
#include "bench/suite.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "bench/groups.h"
#include "error.h"

namespace lamp::app {
namespace {

/// A suite of one series with these members besides its name.
std::string suite_with(const std::string& members, const std::string& more = "") {
  return R"({"version": 1, "name": "mine", )" + more + R"("series": [{"name": "one")" +
         (members.empty() ? "" : ", " + members) + "}]}";
}

std::string error_of(const std::string& text) {
  try {
    static_cast<void>(parse_suite(text, "mine.json"));
  } catch (const Error& error) {
    return error.what();
  }
  return "no error";
}

void expect_error(const std::string& text, const std::vector<std::string>& parts) {
  const std::string line = error_of(text);
  EXPECT_TRUE(line.starts_with("mine.json: ")) << line;
  for (const std::string& part : parts)
    EXPECT_NE(line.find(part), std::string::npos) << "\"" << part << "\" is not in: " << line;
}

TEST(BenchSuite, EveryBuiltInSuiteIsOneAndNamesItself) {
  const std::vector<std::string> names = suite_names();
  for (const char* name : {"quick", "stewart-1.3", "stewart-1.6", "stewart-flight", "article", "primal", "tests",
                           "tile-size", "lights", "drobot-scalarisation", "drobot-memory", "drobot-zbin",
                           "drobot-raster", "proxies", "shadows", "adversarial", "auto", "hosts"})
    EXPECT_NE(std::ranges::find(names, name), names.end()) << name;
  for (const std::string& name : names) {
    SCOPED_TRACE(name);
    const Suite suite = load_suite(name);
    EXPECT_EQ(suite.name, name);
    EXPECT_FALSE(suite.title.empty());
    EXPECT_FALSE(suite.about.empty());
    const Expansion expansion = expand(suite, {});
    EXPECT_FALSE(expansion.groups.empty());
    std::set<std::string> keys;
    for (const Group& group : expansion.groups)
      for (const GroupEntry& entry : group.entries)
        EXPECT_TRUE(keys.insert(key_of(group, entry)).second) << "measured twice: " << key_of(group, entry);
  }
}

TEST(BenchSuite, KeysThatNothingWouldRead) {
  expect_error(suite_with(R"("frame": 3, "cameras": ["room"])"), {"cameras", "none beside a frame"});
  for (const char* key : {R"("lights": [4])", R"("frame": 3)", R"("cameras": ["room"])"})
    expect_error(suite_with(std::string(key) + R"(, "flight": {"to": 9})"), {"none where there is a flight"});
  expect_error(suite_with(R"("flight": {"to": 9}, "chart": {"x": "method"})"), {"x", "lights where there is a flight"});
  expect_error(suite_with(R"("atlas": 1024)"), {"atlas", "none without shadows"});
  expect_error(suite_with(R"("shadow_budget": "9")"), {"shadow_budget", "none without shadows"});
  expect_error(suite_with(R"("shadows": "pcf", "shadow_blur": "lines")"), {"shadow_blur", "none with pcf"});
  expect_error(suite_with(R"("mirror_lists": "brute-force")"), {"mirror_lists", "none without mirror"});
  for (const char* off :
       {R"("shadows": "off", "atlas": 1024, "shadow_blur": "lines")", R"("mirror": 0, "mirror_lists": "brute-force")"})
    EXPECT_EQ(error_of(suite_with(off)), "no error") << "what is off by name may have them, as on the command line";
}

TEST(BenchSuite, HostsThatCannotHaveIt) {
  const auto hosted = [](const std::string& host, const std::string& members) {
    return suite_with(R"("methods": [{"name": "tiled", "host": ")" + host + R"("}], )" + members);
  };
  expect_error(hosted("changing-size", R"("stereo": 0.06)"), {"stereo", "0 with host changing-size"});
  expect_error(hosted("changing-size", R"("depth_samples": 4)"), {"depth_samples", "1 with host changing-size"});
  expect_error(hosted("culler", R"("decals": [3])"), {"decals", "none with host culler"});
  expect_error(hosted("host-barriers", R"("probes": [3])"), {"probes", "none with host host-barriers"});
  expect_error(hosted("culler", R"("paths": ["tiled-deferred"])"), {"paths", "no tiled-deferred with host culler"});
  expect_error(suite_with(R"("methods": [{"name": "tiled", "host": "culler", "path": "tiled-deferred"}])"),
               {"method tiled: path", "none of tiled-deferred with host culler"});
  expect_error(suite_with(R"("methods": [{"name": "tiled", "still_lists": "world-tree"}])"),
               {"still: expected more than 0", "got none"});
}

TEST(BenchSuite, LabelsTellEntriesApart) {
  const Suite suite = parse_suite(
      suite_with(
          R"("still": 1, "methods": ["tiled", {"name": "tiled", "path": "forward"}, {"name": "tiled", "host": "culler"},
      {"name": "tiled", "still_lists": "world-tree", "still_occlusion": 32},
      {"name": "tiled", "still_lists": "world-tree", "still_bytes": 64}])"),
      "mine.json");
  std::vector<std::string> labels;
  for (const SuiteMethod& method : suite.series[0].methods) labels.push_back(method.label);
  EXPECT_EQ(labels, (std::vector<std::string>{"tiled", "tiled, forward", "tiled, culler", "tiled, world-tree 32",
                                              "tiled, world-tree, 64 bytes"}));
  expect_error(suite_with(R"("methods": ["tiled", {"name": "tight", "label": "tiled"}])"),
               {"two have the label 'tiled'"});
  expect_error(suite_with(R"("methods": ["tiled", "tiled"])"), {"two have the label 'tiled'"});
}

TEST(BenchSuite, NothingIsMeasuredTwice) {
  expect_error(suite_with(R"("methods": ["tiled", {"name": "tiled", "label": "again"}])"),
               {"'tiled' and 'again' ask for the same"});
  expect_error(
      suite_with(R"("methods": ["tiled", {"name": "tiled", "path": "forward"}], "paths": ["deferred", "forward"])"),
      {"'tiled' and 'tiled, forward' ask for the same, by the path forward"});
  expect_error(suite_with(R"("lights": [16, 4, 16])"), {"lights", "16 once"});
  expect_error(suite_with(R"("paths": ["deferred", "deferred"])"), {"paths", "deferred once"});
  expect_error(suite_with(R"("options": {"tile": ["8", "8"]})"), {"options: tile", "8 once"});
}

TEST(BenchSuite, KeysThatAreUnknown) {
  expect_error(suite_with("", R"("titel": "x", )"), {"key 'titel'", "nearest are title"});
  expect_error(suite_with(R"("lihgts": [1])"), {"series 'one'", "key 'lihgts'", "lights"});
  expect_error(suite_with(R"("chart": {"z": "lights"})"), {"series 'one': chart", "key 'z'"});
  expect_error(suite_with(R"("verify": {"row": 3})"), {"series 'one': verify", "key 'row'", "rows"});
  expect_error(suite_with(R"("flight": {"form": 3})"), {"series 'one': flight", "key 'form'"});
  expect_error(suite_with(R"("methods": [{"name": "tiled", "label": "x", "option": ["tile=8"]}])"),
               {"key 'option'", "options"});
}

TEST(BenchSuite, ValuesThatAreWrong) {
  expect_error("{", {"is no JSON"});
  expect_error("[]", {"expected an object"});
  expect_error(R"({"version": 2, "name": "mine", "series": []})", {"version: expected 1, got 2"});
  expect_error(R"({"name": "mine", "series": []})", {"version: expected 1, got none"});
  expect_error(R"({"version": 1, "name": "mine"})", {"series: is missing"});
  expect_error(R"({"version": 1, "series": [{"name": "a"}]})", {"name: is missing"});
  expect_error(R"({"version": 1, "name": "mine", "series": [{"name": "a"}, {"name": "a"}]})",
               {"'a'", "name of another"});
  expect_error(suite_with(R"("lights": 5)"), {"lights", "list of whole numbers", "got 5"});
  expect_error(suite_with(R"("lights": [-1])"), {"lights"});
  expect_error(suite_with(R"("lights": [99999999])"), {"lights", "16777216"});
  expect_error(suite_with(R"("lights": [])"), {"lights"});
  expect_error(suite_with(R"("spots": [1.5])"), {"spots", "from 0 to 1"});
  expect_error(suite_with(R"("frames": 0)"), {"frames", "from 1"});
  expect_error(suite_with(R"("methods": ["tield"])"), {"method 'tield'", "tiled"});
  expect_error(suite_with(R"("methods": [{"name": "tiled", "options": ["tile=9"]}])"), {"tiled", "tile", "9"});
  expect_error(suite_with(R"("methods": [{"name": "auto", "options": ["tile=8"]}])"),
               {"series 'one': method auto: chooses its own options; expected none, got tile=8"});
  expect_error(suite_with(R"("methods": [])"), {"methods"});
  expect_error(suite_with(R"("chart": {"y": "speed"})"), {"chart", "y", "cull+shade", "speed"});
  expect_error(suite_with(R"("chart": {"x": "weather"})"), {"chart", "x", "option:KEY"});
  expect_error(suite_with(R"("chart": {"x": "option:weather"})"), {"chart", "x", "option:KEY of a KEY"});
  expect_error(suite_with(R"("chart": {"x": "option:tile"}, "options": {"test": ["aabb"]})"), {"chart", "x"});
  EXPECT_EQ(error_of(suite_with(R"("chart": {"x": "option:tile"}, "options": {"tile": ["8"]})")), "no error");
  expect_error(suite_with(R"("flight": {"from": 9, "to": 3})"),
               {"series 'one': flight: to: expected 9 or more, as from says, got 3"});
  expect_error(suite_with(R"("flight": {"from": 7})"), {"series 'one': flight: to: is missing; expected the most"});
  expect_error(suite_with(R"("flight": {"from": 1, "to": 3}, "chart": {"y": "bytes"})"),
               {"chart", "y", "cull, shade, cull+shade, frame, as each frame of a flight has them alone"});
  expect_error(suite_with(R"("verify": 3)"), {"verify", "true, false or"});
  EXPECT_THROW(static_cast<void>(load_suite("nowhere.json")), Error);
}

std::string numbers(std::size_t count, double step = 1.0) {
  std::string text = "[0";
  for (std::size_t i = 1; i < count; ++i) text += fmt::format(", {}", static_cast<double>(i) * step);
  return text + "]";
}

TEST(BenchSuite, WhatMultipliesBeyondMemoryIsCountedFirst) {
  const std::string lists =
      R"("methods": ["tiled"], "spots": )" + numbers(4000, 1e-4) + R"(, "lights": )" + numbers(4000);
  expect_error(suite_with(lists), {"series 'one'", "out to 16000000 configurations", "expected at most 65536"});
  std::string options;
  for (char key = 'a'; key <= 'z'; ++key)
    options += fmt::format(R"({}"{}": ["1", "2", "3", "4", "5", "6", "7", "8"])", key == 'a' ? "" : ", ", key);
  expect_error(suite_with(R"("methods": ["tiled"], "options": {)" + options + "}"), {"series 'one'", "configurations"});
  std::string series;
  for (int i = 0; i < 20; ++i)
    series +=
        fmt::format(R"({}{{"name": "{}", "methods": ["tiled"], "lights": {}}})", i == 0 ? "" : ", ", i, numbers(4000));
  expect_error(R"({"version": 1, "name": "mine", "series": [)" + series + "]}",
               {"series '14'", "out to 60000 configurations"});
  const std::string label = R"("methods": [{"name": "tiled", "label": ")" + std::string(100'000, 'x') + "\"}]";
  expect_error(suite_with(label + R"(, "lights": )" + numbers(20'000)), {"series 'one'", "bytes of text"});
}

TEST(BenchSuite, ASeriesThatIsNotTimed) {
  const Suite suite = parse_suite(suite_with(R"("timed": false)"), "mine.json");
  const Group group = expand(suite, {.frames = 7, .most_frames = 5}).groups.at(0);
  EXPECT_EQ(group.frames, 0U);
  EXPECT_EQ(group.warm_up, 0U);
  EXPECT_EQ(words_of(group.verify), "nothing");
  EXPECT_NE(group.unchecked.find("neither timed nor verified"), std::string::npos);
  expect_error(suite_with(R"("timed": 1)"), {"timed", "true or false"});
  for (const char* other : {R"("verify": true)", R"("pictures": true)", R"("flight": {"from": 1, "to": 2})"})
    expect_error(suite_with(R"("timed": false, )" + std::string(other)), {"timed", "expected true where"});
}

TEST(BenchSuite, SweepsMultiply) {
  const Suite suite = parse_suite(suite_with(R"("methods": ["tiled", {"name": "all", "path": "standard-deferred"}],
      "options": {}, "scenes": ["plane", "posts"], "lights": [1, 2, 3], "sizes": ["8x8", "16x8"], "spots": [0, 1],
      "paths": ["forward", "deferred"])"),
                                  "mine.json");
  const Expansion all = expand(suite, {});
  EXPECT_EQ(all.groups.size(), 2U * 3U * 2U * 2U);
  EXPECT_EQ(all.groups.front().entries.size(), 3U) << "tiled on two paths, all on its own";
  const Expansion fewer = expand(suite, {.max_lights = 2, .max_pixels = 64});
  EXPECT_EQ(fewer.groups.size(), 2U * 2U * 1U * 2U);
  EXPECT_EQ(fewer.left_out, (24U - 8U) * 3U);
  const Expansion smaller = expand(suite, {.scale = 0.3, .max_pixels = 12});
  EXPECT_EQ(smaller.left_out, 0U);
  EXPECT_EQ(smaller.groups.front().size, "2x2");
  EXPECT_EQ(smaller.groups.back().size, "5x2");
  EXPECT_EQ(expand(suite, {.scale = 0.01}).groups.back().size, "1x1");
}

TEST(BenchSuite, NoOptionsMayBeAnEmptyList) {
  const Suite suite = parse_suite(suite_with(R"("methods": [{"name": "tiled", "options": []}])"), "mine.json");
  EXPECT_TRUE(suite.series.at(0).methods.at(0).options.empty());
}

TEST(BenchSuite, SeriesThatAreNotNamedAreLeftOut) {
  const Suite suite = load_suite("world");
  const Expansion all = expand(suite, {});
  const Expansion mirrors = expand(suite, {.series = {"mirror", "mirror-grid"}});
  ASSERT_EQ(mirrors.groups.size(), 6U);
  EXPECT_EQ(mirrors.groups.front().series, "mirror");
  EXPECT_EQ(mirrors.groups.back().series, "mirror-grid");
  EXPECT_GT(all.groups.size(), mirrors.groups.size());
  EXPECT_EQ(mirrors.left_out, 0U) << "that series were not asked for is no limit";
}

TEST(BenchSuite, SweptOptionsBelongToEveryMethod) {
  const Suite suite =
      parse_suite(suite_with(R"("methods": ["tiled", "stewart"], "options": {"tile": ["8", "16"], "test": ["aabb"]})"),
                  "mine.json");
  const Group group = expand(suite, {}).groups.at(0);
  ASSERT_EQ(group.entries.size(), 4U);
  for (const GroupEntry& entry : group.entries) EXPECT_EQ(entry.swept.size(), 2U);
  EXPECT_EQ(group.entries[0].options, (std::vector<std::string>{"test=aabb", "tile=8"}));
}

TEST(BenchSuite, TheGpuVerifierChecksTheListsOfEveryRow) {
  const Suite suite = parse_suite(
      suite_with(R"("lights": [1000, 262144], "sizes": ["1000x500"], "verify": {"rows": 32})"), "mine.json");
  const Expansion all = expand(suite, {.verifier = VerifierChoice::by_pairs, .every_list = true});
  EXPECT_EQ(words_of(all.groups[0].verify), "32 rows");
  EXPECT_EQ(words_of(all.groups[1].verify), "32 rows, every list, by gpu");
  const Expansion software = expand(suite, {.verifier = VerifierChoice::by_pairs});
  EXPECT_EQ(words_of(software.groups[1].verify), "32 rows") << "32 rows are few enough for the oracle";
}

/// Whatever the limits ask for.
TEST(BenchSuite, TheOracleAloneChecksWhatTheGpuVerifierDoesNotKnow) {
  for (const char* unknown :
       {R"("decals": [8])", R"("probes": [8])", R"("depth_samples": 4)", R"("stereo": 0.06)", R"("shadows": "pcf")"}) {
    const Suite suite = parse_suite(suite_with(unknown), "mine.json");
    const Expansion all = expand(suite, {.verifier = VerifierChoice::gpu});
    EXPECT_EQ(all.groups.at(0).verify.verifier, Verifier::oracle) << unknown;
  }
  EXPECT_EQ(expand(parse_suite(suite_with(R"("seed": 2)"), "mine.json"), {.verifier = VerifierChoice::gpu})
                .groups.at(0)
                .verify.verifier,
            Verifier::gpu);
}

TEST(BenchSuite, LimitsOfADevice) {
  const Suite suite =
      parse_suite(suite_with(R"("lights": [100, 1000], "sizes": ["100x10"], "frames": 50, "warm_up": 9)"), "mine.json");
  const Expansion slow = expand(suite, {.most_frames = 5, .most_pairs = 500'000});
  EXPECT_EQ(slow.groups[0].frames, 5U);
  EXPECT_EQ(slow.groups[0].warm_up, 1U);
  EXPECT_EQ(slow.groups[0].verify.what, Verify::What::picture);
  EXPECT_EQ(slow.groups[0].unchecked, "");
  EXPECT_EQ(words_of(slow.groups[0].verify), "picture");
  EXPECT_EQ(words_of(slow.groups[1].verify), "picture, lists alone");
  EXPECT_NE(slow.groups[1].unchecked.find("too many lights for brute force"), std::string::npos);
  const Expansion short_loops = expand(suite, {.most_walked = 999});
  EXPECT_EQ(words_of(short_loops.groups[0].verify), "picture");
  EXPECT_EQ(words_of(short_loops.groups[1].verify), "picture, lists alone");
  const Expansion slower = expand(suite, {.most_pairs = 100});
  EXPECT_EQ(words_of(slower.groups[1].verify), "nothing");
  EXPECT_EQ(slower.groups[1].unchecked, "not verified: too many lights for the oracle");
  const Expansion by_gpu = expand(suite, {.most_pairs = 100, .verifier = VerifierChoice::gpu, .every_list = true});
  EXPECT_EQ(words_of(by_gpu.groups[1].verify), "picture, lists alone, by gpu");
  EXPECT_NE(by_gpu.groups[1].unchecked.find("held against the GPU verifier"), std::string::npos);
  const Expansion asked = expand(suite, {.frames = 70, .most_frames = 5});
  EXPECT_EQ(asked.groups[0].frames, 70U) << "the command line has the last word";
  EXPECT_EQ(asked.groups[0].warm_up, 9U);
}

TEST(BenchSuite, AFlightGoesUpAndDown) {
  const LightWave wave{.from = 7, .to = 980, .waves = 2};
  EXPECT_EQ(lights_at(wave, 0, 400), 7U);
  EXPECT_EQ(lights_at(wave, 100, 400), 980U);
  EXPECT_EQ(lights_at(wave, 200, 400), 7U);
  EXPECT_EQ(lights_at(wave, 300, 400), 980U);
  EXPECT_EQ(lights_at(wave, 50, 400), lights_at(wave, 150, 400));
  for (std::uint32_t i = 0; i < 400; ++i) {
    EXPECT_GE(lights_at(wave, i, 400), 7U);
    EXPECT_LE(lights_at(wave, i, 400), 980U);
  }
  EXPECT_EQ(lights_at(wave, 0, 1), 980U) << "one frame is the one with the most lights";
}

TEST(BenchSuite, PicturesAreOfTheMostLightsOfEachScene) {
  const Suite suite =
      parse_suite(suite_with(R"("scenes": ["plane", "posts"], "lights": [1, 9, 3], "pictures": true)"), "mine.json");
  for (const Group& group : expand(suite, {}).groups) EXPECT_EQ(group.pictures, group.lights == 9) << group.scene;
}

}  // namespace
}  // namespace lamp::app
