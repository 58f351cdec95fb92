// The table of methods: its rows, their options, and their plans at many sizes and capacities, all without a device.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/method.h"

#include <gtest/gtest.h>
#include <glm/glm.hpp>

#include <algorithm>
#include <set>
#include <string>
#include <utility>

#include "lamplight/shader_code.h"
#include "render/shader_library.h"
#include "unit/devices.h"

namespace {

using lamp::DeviceTraits;
using lamp::Method;
using lamp::Options;
using lamp::OptionSpec;
using lamp::Plan;
using lamp::Problem;
using lamp::SubgroupOperations;
using lamp::test::LARGE_DEVICE;
using lamp::test::LARGE_PLAIN_DEVICE;
using lamp::test::LEAST_DEVICE;
using lamp::test::SOFTWARE_DEVICE;

constexpr glm::uvec2 SIZES[] = {{1, 1},       {1, 4096},    {4096, 1},     {15, 17},    {16, 16},       {17, 15},
                                {64, 64},     {65, 63},     {640, 360},    {1279, 721}, {1920, 1080},   {3840, 2160},
                                {4096, 4096}, {7680, 4320}, {16384, 1000}, {16384, 1},  {16384, 16384}, {32768, 32768}};
constexpr glm::uvec2 FEWER_SIZES[] = {{1, 1}, {65, 63}, {1920, 1080}, {16384, 16384}};  // options at other values
constexpr std::uint32_t CAPACITIES[] = {0, 1, 31, 32, 33, 512, 513, 4096, 65536, 1000000, 1 << 21, 1 << 22, 1 << 24};

Options defaults_of(const Method& method) { return lamp::resolve_options(method, {}).value(); }

Problem ordinary_problem(Options options, const DeviceTraits& traits = LARGE_DEVICE) {
  return {.width = 640, .height = 360, .light_capacity = 100, .options = std::move(options), .traits = traits};
}

/// The defaults, and each option alone at each of its values.
std::vector<std::vector<std::string>> settings_of(const Method& method) {
  std::vector<std::vector<std::string>> settings{{}};
  for (const OptionSpec& spec : method.options)
    for (const std::string& value : lamp::sample_values(spec))
      settings.push_back({std::string(spec.key) + "=" + value});
  return settings;
}

/// Its work is shared out among the threads of subgroups; other methods do without their operations where they must.
bool needs_subgroups(const Method& method) { return method.name == "lamplight"; }

/// The plan of a problem, or an error that names what is beyond which limit, or options that do not go together.
void expect_plan_or_limit(const Method& method, const Problem& problem) {
  const lamp::Result<Plan> made = lamp::make_plan(method, problem);
  if (!made) {
    const std::string text = made.error().text();
    if (problem.options.all() != defaults_of(method).all() && text.starts_with("option ")) return;
    const bool size = text.starts_with("size ") && text.find("pixels a side on this device") != std::string::npos;
    const bool buffer = text.find("buffer") != std::string::npos && text.find("hold at most") != std::string::npos;
    const bool groups = text.find("work groups") != std::string::npos && text.find("takes 1 to") != std::string::npos;
    const bool shared = text.find("shared memory, the device has") != std::string::npos;
    const bool operation = text.find("subgroup operation") != std::string::npos;
    EXPECT_TRUE(size || buffer || groups || shared || operation) << text;
    EXPECT_TRUE(!operation || (needs_subgroups(method) && problem.traits.compute_subgroups == SubgroupOperations{}));
    return;
  }
  const Plan& plan = made.value();
  EXPECT_FALSE(lamp::plan_check(plan, problem.traits).has_value());
  EXPECT_EQ(plan.light_capacity, problem.light_capacity);
  EXPECT_NE(lamp::find_shader(lamp::render_shaders(), "visit@" + plan.lookup.name), nullptr) << plan.lookup.name;
  EXPECT_GE(plan.cells, 1U);
  std::uint64_t sum = 0;
  std::set<std::string> names{"total"};  // the row that Stats adds
  for (const lamp::BufferDesc& buffer : plan.buffers) {
    sum += plan.bytes_of(buffer);
    EXPECT_TRUE(names.insert(buffer.name).second) << "a second buffer " << buffer.name;
  }
  EXPECT_EQ(plan.bytes(), sum);
  EXPECT_EQ(lamp::make_plan(method, problem).value().bytes(), sum) << "planning twice gives two answers";
}

class EveryMethod : public ::testing::TestWithParam<const Method*> {};

TEST_P(EveryMethod, PlansOrNamesTheLimit) {
  const Method& method = *GetParam();
  for (const std::vector<std::string>& settings : settings_of(method)) {
    const lamp::Result<Options> options = lamp::resolve_options(method, settings);
    ASSERT_TRUE(options) << options.error().text();
    for (const DeviceTraits& traits : {LARGE_DEVICE, LARGE_PLAIN_DEVICE, SOFTWARE_DEVICE, LEAST_DEVICE})
      for (const glm::uvec2 size : settings.empty() ? std::span<const glm::uvec2>(SIZES) : std::span(FEWER_SIZES))
        for (const std::uint32_t lights : CAPACITIES) {
          SCOPED_TRACE(std::to_string(size.x) + "x" + std::to_string(size.y) + ", " + std::to_string(lights) + " " +
                       (settings.empty() ? "" : settings[0]));
          expect_plan_or_limit(method, {.width = size.x,
                                        .height = size.y,
                                        .light_capacity = lights,
                                        .options = options.value(),
                                        .traits = traits});
          if (HasFailure()) return;
        }
  }
}

TEST_P(EveryMethod, PlansOrdinaryPicturesOnTheLeastDevice) {
  const Method& method = *GetParam();
  for (const glm::uvec2 size : {glm::uvec2(1, 1), glm::uvec2(1280, 720)})
    for (const std::uint32_t lights : {0U, 1U, 4096U}) {
      const auto made = lamp::make_plan(method, {.width = size.x,
                                                 .height = size.y,
                                                 .light_capacity = lights,
                                                 .options = defaults_of(method),
                                                 .traits = LEAST_DEVICE});
      EXPECT_EQ(made.ok(), !needs_subgroups(method)) << (made ? "" : made.error().text());
    }
}

// A row names the look-up of the plain walk.
TEST_P(EveryMethod, PlansWithItsDefaultsAsItsRowSays) {
  const Method& method = *GetParam();
  const Options defaults = defaults_of(method);
  const bool has_walks = std::ranges::find(method.options, "walk", &OptionSpec::key) != method.options.end();
  const bool scalar = has_walks && defaults.word("walk") != "plain";
  for (const DeviceTraits& traits : {LARGE_DEVICE, LARGE_PLAIN_DEVICE}) {
    if (needs_subgroups(method) && traits.compute_subgroups == SubgroupOperations{}) continue;
    const auto made = lamp::make_plan(method, ordinary_problem(defaults, traits));
    ASSERT_TRUE(made) << made.error().text();
    EXPECT_EQ(made.value().lookup.name,
              std::string(method.result) + (scalar && traits.compute_subgroups.arithmetic ? "_scalar" : ""));
    EXPECT_EQ(made.value().ordered, method.ordered);
    EXPECT_EQ(made.value().approximate, method.approximate);
    EXPECT_EQ(made.value().any_depth, method.any_depth);
  }
}

TEST_P(EveryMethod, ReadsDepthExactlyIfItsRowSaysSo) {
  const Method& method = *GetParam();
  const Plan plan = lamp::make_plan(method, ordinary_problem(defaults_of(method))).value();
  EXPECT_EQ(plan.binds(lamp::INPUT_DEPTH), method.needs_depth);
  EXPECT_EQ(std::ranges::find(plan.lookup.bindings, lamp::INPUT_DEPTH, &lamp::Binding::resource),
            plan.lookup.bindings.end())
      << "engines bind buffers only";
}

// A host that keeps no spheres gets a plan that makes them, in front of everything that reads them.
TEST_P(EveryMethod, MakesSpheresOfItsOwnExactlyIfItReadsAny) {
  const Method& method = *GetParam();
  Problem problem = ordinary_problem(defaults_of(method));
  const Plan brought = lamp::make_plan(method, problem).value();
  problem.own_spheres = true;
  const Plan own = lamp::make_plan(method, problem).value();
  const bool reads = brought.binds(lamp::INPUT_SPHERES);
  EXPECT_FALSE(own.binds(lamp::INPUT_SPHERES));
  EXPECT_EQ(own.passes.size(), brought.passes.size() + (reads ? 1 : 0));
  EXPECT_EQ(own.bytes(), brought.bytes() + (reads ? 100 * sizeof(lamp::shared::LightSphere) : 0));
  if (!reads) return;
  const auto maker = std::ranges::find(own.passes, "light spheres", &lamp::Pass::name);
  ASSERT_NE(maker, own.passes.end());
  EXPECT_TRUE(std::all_of(own.passes.begin(), maker, [](const auto& p) { return p.kind == lamp::PassKind::host; }));
}

// A host that keeps no records of 64 bytes gets a plan that makes them, and none where only spheres are read.
TEST_P(EveryMethod, MakesRecordsOfItsOwnExactlyIfItReadsAny) {
  const Method& method = *GetParam();
  Problem problem = ordinary_problem(defaults_of(method));
  const Plan standard = lamp::make_plan(method, problem).value();
  const bool reads = standard.binds(lamp::INPUT_LIGHTS);
  for (const lamp::LightForm form : {lamp::LightForm::record, lamp::LightForm::points, lamp::LightForm::spots}) {
    problem.light_layout = {.form = form, .lights = {.stride = 80}};
    const Plan own = lamp::make_plan(method, problem).value();
    EXPECT_EQ(own.bytes(), standard.bytes() + (reads ? 100 * sizeof(lamp::shared::Light) : 0));
    EXPECT_EQ(own.passes.size(), standard.passes.size() + (reads ? 1 : 0));
    EXPECT_EQ(own.binds(lamp::INPUT_LIGHTS), reads);
    EXPECT_EQ(own.binds(lamp::INPUT_CONES), reads && form == lamp::LightForm::spots);
    for (const lamp::Pass& pass : own.passes) {
      const bool binds =
          std::ranges::find(pass.bindings, lamp::INPUT_LIGHTS, &lamp::Binding::resource) != pass.bindings.end();
      EXPECT_EQ(binds, pass.name == "light records") << pass.name;
    }
  }
}

// What brute force looks at knows no cell: it alone has nothing to cut.
TEST_P(EveryMethod, ReadsRadialBoundsExactlyIfAsked) {
  const Method& method = *GetParam();
  EXPECT_FALSE(lamp::make_plan(method, ordinary_problem(defaults_of(method))).value().binds(lamp::INPUT_RADIAL));
  const lamp::Result<Options> radial = lamp::resolve_options(method, {"occlusion=radial"});
  // Lists of the world hold what a mirror shows too, and `all` makes none.
  ASSERT_EQ(radial.ok(), method.name != "all" && !method.any_point);
  if (!radial) return;
  const Plan plan = lamp::make_plan(method, ordinary_problem(radial.value())).value();
  EXPECT_TRUE(plan.binds(lamp::INPUT_RADIAL));
  EXPECT_EQ(std::ranges::find(plan.lookup.bindings, lamp::INPUT_RADIAL, &lamp::Binding::resource),
            plan.lookup.bindings.end());
}

TEST_P(EveryMethod, ReadsLightMeshesExactlyIfAsked) {
  const Method& method = *GetParam();
  EXPECT_FALSE(lamp::make_plan(method, ordinary_problem(defaults_of(method))).value().binds(lamp::INPUT_MESHES));
  const lamp::Result<Options> cut = lamp::resolve_options(method, {"proxy=cut"});
  ASSERT_EQ(cut.ok(), method.name.starts_with("drobot-raster"));
  if (!cut) return;
  EXPECT_TRUE(lamp::make_plan(method, ordinary_problem(cut.value())).value().binds(lamp::INPUT_MESHES));
}

// What is made ahead is read by the look-up, and by nothing in a frame.
TEST_P(EveryMethod, ReadsWhatIsMadeAheadExactlyIfItsRowSaysSo) {
  const Method& method = *GetParam();
  const Plan plan = lamp::make_plan(method, ordinary_problem(defaults_of(method))).value();
  EXPECT_EQ(plan.binds(lamp::INPUT_STILL), method.still);
  EXPECT_TRUE(!method.still || plan.passes.empty());
}

// No look-up reads a light: an engine's shader needs nothing of them but its own.
TEST_P(EveryMethod, LooksLightsUpWithoutReadingThem) {
  const Method& method = *GetParam();
  const Plan plan = lamp::make_plan(method, ordinary_problem(defaults_of(method))).value();
  for (const lamp::ResourceId input : {lamp::INPUT_LIGHTS, lamp::INPUT_CONES, lamp::INPUT_SPHERES})
    EXPECT_EQ(std::ranges::find(plan.lookup.bindings, input, &lamp::Binding::resource), plan.lookup.bindings.end());
}

// Every shader that reads through a look-up exists in a variant for this method's look-up.
TEST_P(EveryMethod, HasItsLookUpInEveryShader) {
  const Method& method = *GetParam();
  const auto has = [](const std::string& shader, const std::string& lookup) {
    return lamp::find_shader(lamp::render_shaders(), shader + "@" + lookup) != nullptr;
  };
  for (const char* shader : {"deferred", "forward", "visit"})
    EXPECT_TRUE(has(shader, std::string(method.result))) << shader << "@" << method.result;
  const auto made = lamp::make_plan(
      method,
      {.width = 64, .height = 64, .light_capacity = 100, .options = defaults_of(method), .traits = LARGE_DEVICE});
  ASSERT_TRUE(made);
  if (!made.value().fused) return;
  for (const char* shader : {"deferred", "visit"})
    EXPECT_TRUE(has(shader, made.value().fused->lookup.name)) << shader << "@" << made.value().fused->lookup.name;
}

TEST_P(EveryMethod, HasARowThatSaysWhatItIs) {
  const Method& method = *GetParam();
  for (const std::string_view text : {method.name, method.title, method.source, method.summary, method.result})
    EXPECT_FALSE(text.empty());
  EXPECT_EQ(method.name.find_first_not_of("abcdefghijklmnopqrstuvwxyz0123456789-."), std::string_view::npos);
  EXPECT_TRUE(method.summary.ends_with(".")) << method.summary;
  EXPECT_TRUE(method.plan != nullptr);
  std::set<std::string_view> keys;
  for (const OptionSpec& spec : method.options) {
    EXPECT_TRUE(keys.insert(spec.key).second) << spec.key;
    EXPECT_FALSE(spec.help.empty()) << spec.key;
    EXPECT_GE(spec.min, 0) << spec.key;
    EXPECT_LE(spec.max, 0xFFFFFFFFLL) << spec.key;
    EXPECT_TRUE(!spec.choices.empty() || spec.min < spec.max) << spec.key;
  }
}

TEST_P(EveryMethod, AcceptsItsDefaultsWrittenOut) {
  const Method& method = *GetParam();
  std::vector<std::string> written;
  written.reserve(method.options.size());
  for (const OptionSpec& spec : method.options)
    written.push_back(std::string(spec.key) + "=" + std::string(spec.fallback));
  const auto options = lamp::resolve_options(method, written);
  ASSERT_TRUE(options) << options.error().text();
  EXPECT_EQ(options.value().all(), defaults_of(method).all());
  EXPECT_EQ(options.value().all().size(), method.options.size());
}

TEST_P(EveryMethod, RefusesWhatIsNoValueOfAnOption) {
  const Method& method = *GetParam();
  for (const OptionSpec& spec : method.options) {
    std::vector<std::string> wrong{"", " ", "x", "-1", "1.5", "0x10", "+16", "16 ", "99999999999999999999"};
    if (spec.choices.empty()) wrong.push_back(std::to_string(spec.max + 1));
    if (spec.choices.empty()) wrong.push_back(std::to_string(spec.min - 1));
    for (const std::string& value : wrong) {
      const auto options = lamp::resolve_options(method, {std::string(spec.key) + "=" + value});
      ASSERT_FALSE(options) << spec.key << " accepts '" << value << "'";
      EXPECT_EQ(options.error().source, "option " + std::string(spec.key));
      EXPECT_NE(options.error().message.find("'" + value + "'"), std::string::npos) << options.error().message;
      const std::string expected = spec.choices.empty()
                                       ? "from " + std::to_string(spec.min) + " to " + std::to_string(spec.max)
                                       : std::string(spec.choices.back());
      EXPECT_NE(options.error().message.find(expected), std::string::npos) << options.error().message;
    }
  }
}

std::vector<const Method*> every_method() {
  std::vector<const Method*> all;
  for (const Method& method : lamp::methods()) all.push_back(&method);
  return all;
}
std::string test_name(const ::testing::TestParamInfo<const Method*>& row) {
  std::string name(row.param->name);
  std::ranges::replace_if(name, [](char c) { return c == '-' || c == '.'; }, '_');
  return name;
}
INSTANTIATE_TEST_SUITE_P(Table, EveryMethod, ::testing::ValuesIn(every_method()), test_name);

// Scalar walks need subgroup operations: with them, a look-up of its own; without, the plain one and a note.
TEST_P(EveryMethod, WalksPlainlyAndSaysSoWhereTheDeviceLacksAnOperation) {
  const Method& method = *GetParam();
  if (std::ranges::find(method.options, "walk", &OptionSpec::key) == method.options.end()) return;
  const auto plan = [&](const char* walk, const DeviceTraits& traits) {
    const auto options = lamp::resolve_options(method, {std::string("walk=") + walk}).value();
    return lamp::make_plan(method,
                           {.width = 64, .height = 64, .light_capacity = 100, .options = options, .traits = traits});
  };
  const auto plain = plan("plain", SOFTWARE_DEVICE);
  ASSERT_TRUE(plain) << plain.error().text();
  EXPECT_TRUE(plain.value().notes.empty());
  const std::string name = plain.value().lookup.name;
  int scalar_walks = 0;
  for (const char* walk : {"scalar-cell", "scalar-entity"}) {
    const auto with = plan(walk, SOFTWARE_DEVICE);
    if (!with) {
      EXPECT_EQ(with.error().source, "option walk");
      continue;
    }
    ++scalar_walks;
    EXPECT_EQ(with.value().lookup.name, name + "_scalar");
    EXPECT_TRUE(with.value().notes.empty());
    const auto without = plan(walk, LEAST_DEVICE);
    ASSERT_TRUE(without) << without.error().text();
    EXPECT_EQ(without.value().lookup.name, name);
    const std::string note = std::string("walk=plain instead of ") + walk;
    EXPECT_TRUE(std::ranges::any_of(without.value().notes, [&](const auto& n) { return n.starts_with(note); })) << note;
  }
  EXPECT_EQ(scalar_walks, name == "tile_typed" ? 0 : 1);
}

TEST(Methods, CombinationsThatMakeNoSenseAreRefusedWithTheReason) {
  struct Refusal {
    std::vector<std::string> settings;
    std::string source, reason;
  };
  const std::vector<Refusal> refusals{
      {{"container=bits", "order=append"}, "option order", "container=bits goes with order=index"},
      {{"spot=cone-segments"}, "option spot", "goes with bounds=mask"},
      {{"frusta=cached", "test=aabb"}, "option frusta", "frusta=cached goes with"},
      {{"frusta=cached", "test=exact"}, "option frusta", "frusta=cached goes with"},
      {{"bounds=none", "test=aabb"}, "option test", "bounds=none goes with"},
      {{"bounds=none", "test=exact"}, "option test", "bounds=none goes with"},
      {{"bounds=none", "spot=cone-sphere"}, "option spot", "bounds=none goes with"},
      {{"order=type", "walk=scalar-cell"}, "option walk", "order=type goes with walk=plain"},
      {{"bounds=none", "reduce=parallel"}, "option reduce", "bounds=none reduces nothing"}};
  const Method& tiled = *lamp::find_method("tiled").value();
  for (const auto& [settings, source, reason] : refusals) {
    const auto plan = lamp::make_plan(tiled, ordinary_problem(lamp::resolve_options(tiled, settings).value()));
    ASSERT_FALSE(plan) << settings.front() << " " << settings.back();
    EXPECT_NE(plan.error().text().find(source), std::string::npos) << plan.error().text();
    EXPECT_NE(plan.error().text().find(reason), std::string::npos) << plan.error().text();
  }
}

TEST(Methods, NamesAreUniqueAndFound) {
  std::set<std::string_view> names;
  for (const Method& method : lamp::methods()) {
    EXPECT_TRUE(names.insert(method.name).second) << method.name;
    const auto found = lamp::find_method(method.name);
    ASSERT_TRUE(found);
    EXPECT_EQ(found.value(), &method);
  }
  EXPECT_GE(names.size(), 4U);
}

TEST(Methods, AnUnknownNameBringsTheNearest) {
  const auto found = lamp::find_method("tilde-bits");
  ASSERT_FALSE(found);
  EXPECT_EQ(found.error().source, "method 'tilde-bits'");
  EXPECT_TRUE(found.error().message.starts_with("there is no such method; the nearest are tiled-bits, "))
      << found.error().message;
  EXPECT_FALSE(lamp::find_method("")) << "no method has no name";
  EXPECT_FALSE(lamp::find_method("Tiled")) << "names are exact";
}

TEST(MakePlan, RefusesSizesAndCapacitiesThatNoDeviceHas) {
  const Method& all = *lamp::find_method("all").value();
  const auto text = [&](std::uint32_t width, std::uint32_t height, std::uint32_t lights, const DeviceTraits& traits) {
    const auto made =
        lamp::make_plan(all, {.width = width, .height = height, .light_capacity = lights, .traits = traits});
    return made ? std::string() : made.error().text();
  };
  EXPECT_EQ(text(0, 10, 1, LEAST_DEVICE), "size 0x10: expected 1 to 4096 pixels a side on this device");
  EXPECT_EQ(text(10, 0, 1, LEAST_DEVICE), "size 10x0: expected 1 to 4096 pixels a side on this device");
  EXPECT_EQ(text(4097, 1, 1, LEAST_DEVICE), "size 4097x1: expected 1 to 4096 pixels a side on this device");
  EXPECT_EQ(text(1, 4097, 1, LEAST_DEVICE), "size 1x4097: expected 1 to 4096 pixels a side on this device");
  EXPECT_EQ(text(4096, 4096, 1, LEAST_DEVICE), "");
  EXPECT_EQ(text(65536, 65536, 1, {.max_image_size = 0xFFFFFFFF}), "");
  EXPECT_EQ(text(65537, 1, 1, {.max_image_size = 0xFFFFFFFF}),
            "size 65537x1: expected 1 to 65536 pixels a side on this device");
  EXPECT_EQ(text(1, 1, lamp::MAX_LIGHTS, LARGE_DEVICE), "");
  EXPECT_EQ(text(1, 1, lamp::MAX_LIGHTS + 1, LARGE_DEVICE), "light capacity: expected at most 16777216, got 16777217");
  EXPECT_EQ(text(1, 1, lamp::MAX_LIGHTS, LEAST_DEVICE),
            "method all: light buffer: needs 1073741824 bytes, the device's storage buffers hold at most 134217728");
}

}  // namespace
