// Lights as glTF text: what was written is read as it was, by itself and by the loader within a file that has a mesh.
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_light_text.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <glm/glm.hpp>
#include <limits>
#include <numbers>
#include <random>

#include "unit/gltf_builder.h"

namespace {

using namespace lamp::test;
using lamp::Light;
using lamp::LightType;
using lamp::app::gltf_refusal;
using lamp::app::gltf_text;
using lamp::app::lights_of_gltf;
using lamp::shared::INFINITE_RADIUS;

void expect_same(const Light& read, const Light& written) {
  EXPECT_EQ(read.type, written.type);
  EXPECT_EQ(glm::vec3(read.position), glm::vec3(written.position));
  EXPECT_EQ(std::min(read.range, INFINITE_RADIUS), std::min(written.range, INFINITE_RADIUS));
  EXPECT_EQ(glm::vec3(read.color), glm::vec3(written.color));
  EXPECT_EQ(read.intensity, written.intensity);
  if (written.type == LightType::point) return;
  const glm::vec3 direction = glm::normalize(glm::vec3(written.direction));
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(glm::vec3(read.direction)[i], direction[i], 2e-7F) << "component " << i;
  EXPECT_EQ(read.inner_angle, written.inner_angle);
  EXPECT_EQ(read.outer_angle, written.outer_angle);
}

std::vector<Light> some_lights() {
  std::mt19937 random(7);
  std::uniform_real_distribution<float> number(-1.0F, 1.0F);
  const auto any = [&] { return lamp::Vec3{number(random), number(random), number(random)}; };
  std::vector<Light> lights;
  for (int i = 0; i < 200; ++i)
    lights.push_back({.type = i % 3 == 0 ? LightType::point : LightType::spot,
                      .position = glm::vec3(any()) * 100.0F,
                      .range = 5.1F + number(random),
                      .color = glm::abs(glm::vec3(any())),
                      .intensity = 1.1F + number(random),
                      .direction = any(),
                      .inner_angle = 0.3F,
                      .outer_angle = 0.9F + 0.5F * number(random)});
  // Along every axis: -Z is no turn at all, +Z half a one.
  for (const glm::vec3 axis : {glm::vec3(1, 0, 0), glm::vec3(0, 1, 0), glm::vec3(0, 0, 1), glm::vec3(1e-7F, 0, 1)})
    for (const float sign : {1.0F, -1.0F})
      lights.push_back({.type = LightType::spot,
                        .direction = sign * axis,
                        .inner_angle = 0.1F,
                        .outer_angle = std::numbers::pi_v<float> / 2.0F});
  return lights;
}

TEST(GltfLightText, IsReadAsItWasWritten) {
  const std::vector<Light> lights = some_lights();
  const std::vector<Light> read = lights_of_gltf(gltf_text(lights, "light"), "text");
  ASSERT_EQ(read.size(), lights.size());
  for (std::size_t i = 0; i < lights.size(); ++i) {
    SCOPED_TRACE(i);
    expect_same(read[i], lights[i]);
  }
}

/// The loader of scenes takes the text's light and node in a file that has a mesh as well.
TEST(GltfLightText, IsALightOfAnyGltfFile) {
  for (const Light& light : some_lights()) {
    const json text = json::parse(gltf_text({&light, 1}, "light 3"));
    GltfBuilder builder = triangle();
    json node = text["nodes"][0];
    node["extensions"] = builder.light(text["extensions"]["KHR_lights_punctual"]["lights"][0]);
    builder.root(node);
    expect_same(load(builder).lights.at(0), light);
  }
}

TEST(GltfLightText, SaysWhatTheExtensionAllows) {
  const Light bright{.type = LightType::spot,
                     .color = {4.0F, 1.0F, 0.0F},
                     .intensity = 3.0F,
                     .inner_angle = 0.5F,
                     .outer_angle = 0.5F};
  const json light = json::parse(gltf_text({&bright, 1}, "lamp"))["extensions"]["KHR_lights_punctual"]["lights"][0];
  EXPECT_EQ(light["color"], (json{1.0, 0.25, 0.0}));
  EXPECT_EQ(light["intensity"], 12.0);
  EXPECT_LT(light["spot"]["innerConeAngle"], light["spot"]["outerConeAngle"]);
  EXPECT_FALSE(light.contains("range")) << "infinite";
}

TEST(GltfLightText, HasAVectorALine) {
  const Light light{.position = {1.0F, 2.0F, 3.5F}, .range = 2.0F};
  const std::string text = gltf_text({&light, 1}, "one [of] \\\"two\", [\"");
  EXPECT_NE(text.find("\"translation\": [1.0, 2.0, 3.5]"), std::string::npos) << text;
  EXPECT_NE(text.find("\"nodes\": [0]"), std::string::npos) << text;
  EXPECT_EQ(json::parse(text)["nodes"][0]["name"], "one [of] \\\"two\", [\"");
  EXPECT_EQ(lights_of_gltf(text, "text").size(), 1U);
}

std::string error_of(const auto& use) {
  try {
    use();
  } catch (const lamp::app::Error& error) {
    return error.what();
  }
  return "";
}

TEST(GltfLightText, RefusesWhatGltfCannotSay) {
  Light light{.type = LightType::spot, .range = 0.0F};
  const auto write = [&] { static_cast<void>(gltf_text({&light, 1}, "light 7")); };
  EXPECT_NE(error_of(write).find("light 7: range is 0"), std::string::npos) << error_of(write);
  light = {.type = LightType::spot, .outer_angle = 0.0F};
  EXPECT_NE(error_of(write).find("light 7: its outer angle is 0"), std::string::npos) << error_of(write);
  EXPECT_EQ(gltf_refusal(light, "light 7"), error_of(write)) << "a button asks without a text being made";
  for (const Light& writable : some_lights()) EXPECT_EQ(gltf_refusal(writable, "light"), "");
}

TEST(GltfLightText, SaysWhatIsWrongWithAText) {
  const std::string sun =
      R"({"asset": {"version": "2.0"}, "nodes": [{"extensions": {"KHR_lights_punctual": {"light": 0}}}],
    "extensions": {"KHR_lights_punctual": {"lights": [{"type": "directional"}]}}})";
  const std::string file = R"({"asset": {"version": "2.0"}, "buffers": [{"byteLength": 4, "uri": "secret.bin"}]})";
  const std::string dark =
      R"({"asset": {"version": "2.0"}, "nodes": [{"extensions": {"KHR_lights_punctual": {"light": 0}}}],
    "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": -1}]}}})";
  const std::vector<std::pair<std::string, std::string>> faults{{"hello", "pasted: "},
                                                                {"", "pasted: the file is empty"},
                                                                {sun, "pasted: has a directional light"},
                                                                {file, "pasted: buffer 0"},
                                                                {dark, "light 0: intensity is -1"}};
  for (const auto& [text, says] : faults) {
    const std::string words = error_of([&] { static_cast<void>(lights_of_gltf(text, "pasted")); });
    EXPECT_NE(words.find(says), std::string::npos) << words;
  }
}

}  // namespace
