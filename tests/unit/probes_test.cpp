// Reflection probes on the host: their order, placement, checks, ellipsoids as entities.
// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "oracle/reference.h"
#include "render/place_probes.h"
#include "render/probe_set.h"
#include "render/scene_occluders.h"
#include "scene/builtin.h"
#include "unit/gltf_builder.h"

namespace lamp::app {
namespace {

using test::GltfBuilder;
using test::json;

Scene built_in(std::string_view name) { return std::ranges::find(builtin_scenes(), name, &BuiltinScene::name)->make(); }

TEST(Probes, AscendByVolumeThenAsTheyWereMade) {
  std::vector<Probe> probes(5);
  probes[0].half_extents = glm::vec3(3.0F);
  probes[1].half_extents = {1.0F, 4.0F, 1.0F};
  probes[2].half_extents = {4.0F, 1.0F, 1.0F};
  probes[3] = {.shape = ProbeShape::ellipsoid, .half_extents = {4.0F, 1.0F, 1.0F}};
  probes[4].half_extents = glm::vec3(0.1F);
  EXPECT_EQ(by_volume(probes), (std::vector<std::uint32_t>{4, 3, 1, 2, 0}));
  const std::vector<gpu::ProbeData> packed = pack(probes);
  EXPECT_EQ(packed[1].slot, 3U);
  EXPECT_EQ(packed[1].ellipsoid, 1U);
  EXPECT_EQ(packed[4].slot, 0U);
  EXPECT_NEAR(volume_of(probes[3]), 4.0 / 3.0 * 3.14159265358979 * 4.0, 1e-6);
}

TEST(Probes, IdsLieBehindTheDecals) {
  const EntityRanges ids = entity_ranges(7, 3, 2);
  EXPECT_EQ(ids.decals.first, 7U);
  EXPECT_EQ(ids.decals.end, 10U);
  EXPECT_EQ(ids.probes.first, 10U);
  EXPECT_EQ(ids.probes.end, 12U);
  EXPECT_EQ(ids.boxes.first, 7U);
  EXPECT_EQ(ids.boxes.end, 12U);
  EXPECT_EQ(entity_ranges(7, 3).decals.count(), 3U);
  EXPECT_EQ(entity_ranges(7, 3).probes.count(), 0U);
}

TEST(Probes, EllipsoidsAreEnclosedAndReachWhatTheyHold) {
  const gpu::ProbeData probe = pack({Probe{.shape = ProbeShape::ellipsoid,
                                           .center = {1, 2, 3},
                                           .orientation = glm::normalize(glm::quat(0.9F, 0.1F, -0.3F, 0.2F)),
                                           .half_extents = {4.0F, 0.5F, 2.0F}}})[0];
  const shared::Light sphere = bounding_light(probe.volume, EntityShape::ellipsoid);
  EXPECT_NEAR(sphere.range, 4.0F, 0.001F);
  EXPECT_GT(sphere.range, 4.0F);
  EXPECT_GT(bounding_light(probe.volume).range, 4.4F) << "of the box";
  const glm::dvec3 center(glm::vec3(probe.volume.center));
  const glm::dvec3 along(glm::vec3(probe.volume.axis_y));
  const auto ask = [&](double share) {
    return reach(probe.volume, EntityShape::ellipsoid, center + 0.5 * share * along);
  };
  EXPECT_EQ(ask(0.9999), Reach::inside);
  EXPECT_EQ(ask(1.0 + 2e-6), Reach::boundary);
  EXPECT_EQ(ask(1.0001), Reach::outside);
  const glm::dvec3 corner = center + 0.9 * (glm::dvec3(glm::vec3(probe.volume.axis_x)) * 4.0 + 0.5 * along);
  EXPECT_EQ(reach(probe.volume, EntityShape::box, corner), Reach::inside);
  EXPECT_EQ(reach(probe.volume, EntityShape::ellipsoid, corner), Reach::outside);
}

TEST(PlaceProbes, StandInOpenAirWithWallsAround) {
  for (const char* name : {"corridor", "plane"}) {
    SCOPED_TRACE(name);
    const Scene scene = built_in(name);
    const std::vector<Probe> probes = place_probes(scene, 40, 1);
    ASSERT_EQ(probes.size(), 40U);
    EXPECT_FALSE(check_probes(probes).has_value());
    const Occluders walls = scene_occluders(scene);
    for (const Probe& probe : probes) {
      const glm::vec3 from_center = glm::abs(probe.capture - probe.parallax_center);
      EXPECT_TRUE(glm::all(glm::lessThan(from_center, probe.parallax_half_extents)));
      EXPECT_FALSE(walls.any_hit({.from = probe.capture, .to = glm::dvec3(probe.capture) + glm::dvec3(0, 0.01, 0)}));
    }
    const std::vector<Probe> more = place_probes(scene, 50, 1);
    const std::vector<Probe> other = place_probes(scene, 40, 2);
    for (std::size_t i = 0; i < probes.size(); ++i) EXPECT_EQ(probes[i].capture, more[i].capture);
    EXPECT_NE(probes[0].capture, other[0].capture);
    EXPECT_EQ(probes[5].half_extents, place_probes(scene, 40, 1)[5].half_extents);
    EXPECT_TRUE(place_probes(scene, 0, 1).empty());
  }
}

TEST(Probes, AreChecked) {
  const auto message = [](const Probe& bad) {
    const auto error = check_probes({Probe{}, bad});
    return error ? error->text() : std::string();
  };
  constexpr float NOT_A_NUMBER = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(message({}), "");
  EXPECT_NE(message({.half_extents = glm::vec3(0.0F)}).find("probe 1: volume: half extents"), std::string::npos);
  EXPECT_NE(message({.parallax_half_extents = glm::vec3(-1.0F)}).find("parallax volume"), std::string::npos);
  EXPECT_NE(message({.blend_m = NOT_A_NUMBER}).find("blend distance"), std::string::npos);
  EXPECT_NE(message({.capture = glm::vec3(NOT_A_NUMBER)}).find("capture"), std::string::npos);
}

GltfBuilder with_probe(const json& probe, const json& node = json::object()) {
  GltfBuilder builder = test::triangle();
  json whole = node;
  whole["extras"] = {{"lamplight_probe", probe}};
  builder.root(whole);
  return builder;
}

TEST(GltfProbes, AreRead) {
  const double half = std::sqrt(0.5);
  const Scene scene =
      test::load(with_probe({{"shape", "ellipsoid"},
                             {"half_extents", {1, 2, 3}},
                             {"blend", 0.5},
                             {"parallax_center", {0, 1, 0}},
                             {"capture", {0, 0, 1}},
                             {"color", 3},
                             {"blnd", 1}},
                            {{"translation", {10, 0, 0}}, {"rotation", {half, 0, 0, half}}, {"scale", {2, 2, 2}}}));
  ASSERT_EQ(scene.probes.size(), 1U);
  const Probe& probe = scene.probes[0];
  EXPECT_EQ(probe.shape, ProbeShape::ellipsoid);
  EXPECT_LT(glm::length(probe.center - glm::vec3(10, 0, 0)), 1e-5F);
  EXPECT_LT(glm::length(probe.half_extents - glm::vec3(2, 4, 6)), 1e-5F);
  EXPECT_LT(glm::length(probe.parallax_half_extents - glm::vec3(2, 4, 6)), 1e-5F);
  EXPECT_LT(glm::length(probe.parallax_center - glm::vec3(10, 0, 2)), 1e-5F);
  EXPECT_LT(glm::length(probe.capture - glm::vec3(10, -2, 0)), 1e-5F);
  EXPECT_EQ(probe.blend_m, 0.5F) << "not scaled with the node";
  ASSERT_EQ(scene.notes.size(), 1U);
  EXPECT_EQ(scene.notes[0], "node 1: extras.lamplight_probe: 2 members are not known, left out: blnd, color");
  EXPECT_EQ(place_probes(scene, 1, 1).size(), 1U);
}

TEST(GltfProbes, AreHiddenByAScaleOfZero) {
  const Scene scene = test::load(with_probe({{"half_extents", {1, 1, 1}}}, {{"scale", {1, 0, 1}}}));
  EXPECT_TRUE(scene.probes.empty());
  EXPECT_EQ(scene.notes, std::vector<std::string>{"1 probes left out: a scale of 0 hides them"});
}

TEST(GltfProbes, AreGeneratedInScenesOfEveryExtentButNone) {
  GltfBuilder builder = test::triangle();
  builder.document["nodes"][0]["scale"] = {0.02, 0.02, 0.02};
  const std::vector<Probe> probes = place_probes(test::load(builder), 4, 1);
  EXPECT_FALSE(check_probes(probes).has_value());
  for (const Probe& probe : probes)
    for (int i = 0; i < 3; ++i) EXPECT_LT(probe.half_extents[i], 0.02F);
  builder.document["nodes"][0]["scale"] = {0, 0, 0};
  try {
    static_cast<void>(place_probes(test::load(builder), 4, 1));
    ADD_FAILURE() << "probes of a point";
  } catch (const Error& error) {
    EXPECT_STREQ(error.what(),
                 "scene 'test.gltf': is a single point, which leaves no room for generated probes, expected at most 0 "
                 "probes");
  }
}

TEST(GltfProbes, MistakesAreNamed) {
  const auto error = [](const json& probe, const json& node = json::object()) {
    return test::error_text(with_probe(probe, node).gltf());
  };
  const std::string where = "test.gltf: node 1: extras.lamplight_probe: ";
  EXPECT_EQ(error({{"blend", 1}}), where + "has no half_extents, expected three numbers > 0");
  EXPECT_EQ(error({{"half_extents", {1, 2}}}), where + "half_extents is not an array of three numbers");
  EXPECT_EQ(error({{"half_extents", {1, "x", 2}}}), where + "half_extents[1] is not a number, expected one");
  EXPECT_EQ(error({{"half_extents", {1, nullptr, 2}}}), where + "half_extents is not an array of three numbers")
      << "NaN, as JSON writers put it";
  EXPECT_EQ(error({{"half_extents", {1, 0, 2}}}), where + "half_extents is (1, 0, 2), expected three numbers > 0");
  EXPECT_EQ(error({{"half_extents", {1, 1e300, 2}}}),
            where + "half_extents[1] is 1e+300, expected a finite number up to 1e+15");
  EXPECT_EQ(error({{"half_extents", {1, 1, 1}}, {"shape", "cone"}}),
            where + "shape is cone, expected box or ellipsoid");
  EXPECT_EQ(error({{"half_extents", {1, 1, 1}}, {"blend", -1}}), where + "blend is -1, expected a number >= 0");
  EXPECT_EQ(error({{"half_extents", nullptr}}), where + "half_extents is not an array of three numbers");
  EXPECT_EQ(error({{"half_extents", {1, 1, 1}}, {"blend", nullptr}}), where + "blend is not a number, expected one");
  EXPECT_EQ(error({{"half_extents", {1, 1, 1}}, {"shape", nullptr}}),
            where + "shape is not a string, expected box or ellipsoid");
  EXPECT_EQ(error({{"half_extents", {1, 1, 1}}, {"capture", json::array()}}),
            where + "capture is not an array of three numbers");
  EXPECT_EQ(error({{"half_extents", {1, 1, 1}}, {"parallax_center", json::object()}}),
            where + "parallax_center is not an array of three numbers");
  EXPECT_EQ(error("box"), where + "is not an object");
  EXPECT_EQ(error(json::object()), where + "has no half_extents, expected three numbers > 0");
  EXPECT_EQ(error(nullptr), where + "is not an object");
  EXPECT_EQ(error(json::array()), where + "is not an object");
}

}  // namespace
}  // namespace lamp::app
