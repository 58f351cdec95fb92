// Reads extras.lamplight_probe: numbers are in the node's space, but for the blend distance.
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_probes.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>

#include "files/printable.h"
#include "scene/gltf_error.h"
#include "scene/scene.h"

namespace lamp::app {
namespace {

constexpr std::array<std::string_view, 6> MEMBERS{"shape",           "half_extents",          "blend",
                                                  "parallax_center", "parallax_half_extents", "capture"};

/// One probe's object, and how errors name it.
struct Source {
  const tinygltf::Value& value;
  const std::string& file;
  std::string element;

  [[noreturn]] void fail(const std::string& problem) const { gltf_fail(file, element, problem); }
};

double number_of(const Source& from, const tinygltf::Value& value, const std::string& member) {
  if (!value.IsNumber()) from.fail(fmt::format("{} is not a number, expected one", member));
  const double number = value.GetNumberAsDouble();
  if (!(std::abs(number) <= FURTHEST_M))
    from.fail(fmt::format("{} is {}, expected a finite number up to {:g}", member, number, FURTHEST_M));
  return number;
}

std::optional<glm::dvec3> vector_of(const Source& from, const std::string& member) {
  if (!from.value.Has(member)) return std::nullopt;
  const tinygltf::Value& value = from.value.Get(member);
  if (!value.IsArray() || value.ArrayLen() != 3) from.fail(fmt::format("{} is not an array of three numbers", member));
  glm::dvec3 vector(0.0);
  for (int i = 0; i < 3; ++i) vector[i] = number_of(from, value.Get(i), fmt::format("{}[{}]", member, i));
  return vector;
}

std::optional<glm::dvec3> extents_of(const Source& from, const std::string& member) {
  const std::optional<glm::dvec3> extents = vector_of(from, member);
  if (extents && !(std::min({extents->x, extents->y, extents->z}) > 0.0))
    from.fail(
        fmt::format("{} is ({}, {}, {}), expected three numbers > 0", member, extents->x, extents->y, extents->z));
  return extents;
}

ProbeShape shape_of(const Source& from) {
  if (!from.value.Has("shape")) return ProbeShape::box;
  const tinygltf::Value& value = from.value.Get("shape");
  const std::string shape = value.IsString() ? value.Get<std::string>() : "not a string";
  if (shape != "box" && shape != "ellipsoid") from.fail(fmt::format("shape is {}, expected box or ellipsoid", shape));
  return shape == "box" ? ProbeShape::box : ProbeShape::ellipsoid;
}

/// Unit axes of the node, and metres that one of its units is along each.
struct Axes {
  glm::dmat3 unit{1.0};
  glm::dvec3 metres{1.0};
};

Axes axes_of(const Source& from, const glm::dmat4& world_from_node) {
  Axes axes;
  for (int i = 0; i < 3; ++i) {
    const glm::dvec3 axis(world_from_node[i]);
    axes.metres[i] = glm::length(axis);
    axes.unit[i] = axis / axes.metres[i];
  }
  for (int i = 0; i < 3; ++i)
    if (std::abs(glm::dot(axes.unit[i], axes.unit[(i + 1) % 3])) > 1e-4)
      from.fail("its node's transform shears, expected axes at right angles");
  if (glm::determinant(axes.unit) < 0.0) axes.unit[0] = -axes.unit[0];  // volumes are their own mirror images
  return axes;
}

Probe probe_of(const Source& from, const glm::dmat4& world_from_node) {
  if (!from.value.IsObject()) from.fail("is not an object");
  const Axes axes = axes_of(from, world_from_node);
  const auto world = [&](const std::optional<glm::dvec3>& place) {
    return glm::vec3(world_from_node * glm::dvec4(place.value_or(glm::dvec3(0.0)), 1.0));
  };
  const std::optional<glm::dvec3> half = extents_of(from, "half_extents");
  if (!half) from.fail("has no half_extents, expected three numbers > 0");
  Probe probe{.shape = shape_of(from),
              .center = world(std::nullopt),
              .orientation = glm::quat(glm::normalize(glm::quat_cast(axes.unit))),
              .half_extents = *half * axes.metres,
              .parallax_center = world(vector_of(from, "parallax_center")),
              .parallax_half_extents = extents_of(from, "parallax_half_extents").value_or(*half) * axes.metres,
              .capture = world(vector_of(from, "capture"))};
  if (from.value.Has("blend")) {
    const double blend = number_of(from, from.value.Get("blend"), "blend");
    if (blend < 0.0) from.fail(fmt::format("blend is {}, expected a number >= 0", blend));
    probe.blend_m = static_cast<float>(blend);
  }
  const glm::vec3 least = glm::min(probe.half_extents, probe.parallax_half_extents);
  const glm::vec3 most = glm::max(probe.half_extents, probe.parallax_half_extents);
  if (!(std::min({least.x, least.y, least.z}) > 0.0F) || !(std::max({most.x, most.y, most.z}) <= FURTHEST_M))
    from.fail(
        fmt::format("its volumes are too small or too large for 32 bits, expected extents up to {} m", FURTHEST_M));
  return probe;
}

}  // namespace

std::vector<Probe> read_probes(GltfDocument& document, std::span<const PlacedNode> nodes) {
  std::vector<Probe> probes;
  std::size_t hidden = 0;
  for (const PlacedNode& placed : nodes) {
    const tinygltf::Value& extras = document.model.nodes[static_cast<std::size_t>(placed.node)].extras;
    if (!extras.IsObject() || !extras.Has(PROBE_KEY)) continue;
    const Source from{.value = extras.Get(PROBE_KEY),
                      .file = document.origin.file,
                      .element = fmt::format("node {}: extras.{}", placed.node, PROBE_KEY)};
    if (!axis_of(placed, 0) || !axis_of(placed, 1) || !axis_of(placed, 2)) {
      ++hidden;
      continue;
    }
    probes.push_back(probe_of(from, placed.world_from_node));
    std::vector<std::string> unknown = from.value.Keys();
    std::erase_if(unknown, [](const std::string& key) { return std::ranges::find(MEMBERS, key) != MEMBERS.end(); });
    if (!unknown.empty())
      document.notes.push_back(one_line(fmt::format("{}: {} members are not known, left out: {}", from.element,
                                                    unknown.size(), fmt::join(unknown, ", "))));
  }
  note_hidden(hidden, "probes", document.notes);
  return probes;
}

}  // namespace lamp::app
