// A capture's lights: objects of frame.json, or rows of sixteen floats.
// Promise: what is written is read back bit for bit; every light that is read passes check_shown_lights.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "error.h"
#include "files/json_values.h"
#include "scene/capture_json.h"
#include "scene/npy.h"

namespace lamp::app {
namespace {

constexpr std::array<std::string_view, 8> LIGHT_KEYS{"type",      "position",  "range",       "color",
                                                     "intensity", "direction", "inner_angle", "outer_angle"};

void check(std::span<const Light> lights, const std::string& file) {
  if (const auto error = check_shown_lights(lights)) throw Error(fmt::format("{}: {}", file, error->text()));
  for (std::size_t i = 0; i < lights.size(); ++i) {
    const glm::vec3 reach = glm::abs(glm::vec3(lights[i].position));
    const float furthest = std::max({reach.x, reach.y, reach.z});
    if (furthest > FURTHEST_M)
      throw Error(
          fmt::format("{}: light {}: position reaches {:g} m, expected at most {:g} m, as squares of distances must "
                      "fit 32-bit numbers",
                      file, i, furthest, FURTHEST_M));
  }
}

LightType type_of(const JsonObject& object) {
  const std::string type = object.text("type", "\"point\" or \"spot\"");
  if (type != "point" && type != "spot")
    object.fail(fmt::format("type is {}, expected \"point\" or \"spot\"", shown(object.json.at("type"))));
  return type == "spot" ? LightType::spot : LightType::point;
}

Light light_of(const JsonObject& object) {
  object.check_keys(LIGHT_KEYS);
  Light light;
  light.type = type_of(object);
  light.position = object.vector("position");
  if (object.has("range")) light.range = object.real("range");
  if (object.has("color")) light.color = object.vector("color");
  if (object.has("intensity")) light.intensity = object.real("intensity");
  if (object.has("direction") || light.type == LightType::spot) light.direction = object.vector("direction");
  if (object.has("inner_angle")) light.inner_angle = object.real("inner_angle");
  if (object.has("outer_angle")) light.outer_angle = object.real("outer_angle");
  return light;
}

nlohmann::json array_of(const glm::vec3& v) { return {v.x, v.y, v.z}; }

/// Columns 0 .. 13; docs/capture.md names them.
Light light_of(std::span<const float> row) {
  return {.type = row[13] == 1.0F ? LightType::spot : LightType::point,
          .position = {row[0], row[1], row[2]},
          .range = row[3],
          .color = {row[4], row[5], row[6]},
          .intensity = row[7],
          .direction = {row[8], row[9], row[10]},
          .inner_angle = row[11],
          .outer_angle = row[12]};
}

std::array<float, LIGHT_COLUMNS> row_of(const Light& l) {
  return {l.position.x,  l.position.y,
          l.position.z,  l.range,
          l.color.x,     l.color.y,
          l.color.z,     l.intensity,
          l.direction.x, l.direction.y,
          l.direction.z, l.inner_angle,
          l.outer_angle, l.type == LightType::spot ? 1.0F : 0.0F};
}

}  // namespace

std::vector<Light> parse_lights(const nlohmann::json& array, const std::string& file) {
  std::vector<Light> lights;
  for (std::size_t i = 0; i < array.size(); ++i)
    lights.push_back(light_of(JsonObject{array[i], file, fmt::format("light {}", i)}));
  check(lights, file);
  return lights;
}

nlohmann::json lights_json(std::span<const Light> lights) {
  nlohmann::json array = nlohmann::json::array();
  for (const Light& light : lights) {
    const bool spot = light.type == LightType::spot;
    nlohmann::json object{{"type", spot ? "spot" : "point"},
                          {"position", array_of(light.position)},
                          {"color", array_of(light.color)},
                          {"intensity", light.intensity}};
    if (light.range < shared::INFINITE_RADIUS) object["range"] = light.range;
    if (spot)
      object.update({{"direction", array_of(light.direction)},
                     {"inner_angle", light.inner_angle},
                     {"outer_angle", light.outer_angle}});
    array.push_back(std::move(object));
  }
  return array;
}

std::vector<Light> read_npy_lights(std::span<const std::byte> bytes, const std::string& file) {
  const Table table = read_npy(bytes, file, LIGHT_COLUMNS);
  std::vector<Light> lights;
  lights.reserve(table.rows());
  for (std::size_t i = 0; i < table.rows(); ++i) {
    const std::span<const float> row = table.row(i);
    if (row[13] != 0.0F && row[13] != 1.0F)
      throw Error(
          fmt::format("{}: light {}: type (column 13) is {}, expected 0 (point) or 1 (spot)", file, i, row[13]));
    for (const std::size_t column : {14U, 15U})
      if (row[column] != 0.0F)
        throw Error(fmt::format("{}: light {}: column {} is {}, expected 0 (reserved)", file, i, column, row[column]));
    lights.push_back(light_of(row));
  }
  check(lights, file);
  return lights;
}

std::string npy_lights(std::span<const Light> lights) {
  Table table{.columns = LIGHT_COLUMNS};
  table.values.reserve(lights.size() * LIGHT_COLUMNS);
  for (const Light& light : lights) {
    const std::array<float, LIGHT_COLUMNS> row = row_of(light);
    table.values.insert(table.values.end(), row.begin(), row.end());
  }
  return npy_bytes(table);
}

}  // namespace lamp::app
