// The cameras that nodes of a glTF file carry.
// Based on: Khronos, glTF 2.0 specification, section 3.10 (cameras).
// Promise: rigid poses, whatever scale the nodes have.
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_cameras.h"

#include <fmt/format.h>

#include <map>
#include <optional>
#include <set>

#include "error.h"
#include "scene/flight.h"
#include "scene/gltf_error.h"

namespace lamp::app {
namespace {

/// Keeps the place, the direction of view (-Z) and the side that is up; drops scale, shear and mirroring. Nothing where
/// the node is flat.
std::optional<glm::mat4> rigid_pose(const PlacedNode& placed) {
  const auto back = axis_of(placed, 2);
  const auto up = axis_of(placed, 1);
  if (!back || !up) return std::nullopt;
  const glm::dvec3 right = glm::cross(*up, *back);
  if (!(glm::length(right) > 1e-12)) return std::nullopt;
  const glm::dvec3 x = glm::normalize(right);
  return glm::mat4(glm::dmat4(glm::dvec4(x, 0.0), glm::dvec4(glm::cross(*back, x), 0.0), glm::dvec4(*back, 0.0),
                              placed.world_from_node[3]));
}

void set_projection(const tinygltf::Camera& from, Camera& camera) {
  if (from.type == "perspective") {
    camera.fov_y = static_cast<float>(from.perspective.yfov);
    camera.near_m = static_cast<float>(from.perspective.znear);
    camera.far_m = static_cast<float>(from.perspective.zfar);  // missing: 0, which is infinite here
    return;
  }
  camera.orthographic = true;
  camera.half_height = static_cast<float>(from.orthographic.ymag);
  camera.near_m = static_cast<float>(from.orthographic.znear);
  camera.far_m = static_cast<float>(from.orthographic.zfar);
}

/// What no picture can be made of is the file's fault, and known here alone.
void check_view(const Camera& camera, const std::string& file, const std::string& element) {
  try {
    static_cast<void>(view_of(camera, 1, 1, "camera"));
  } catch (const Error& error) {
    gltf_fail(file, element, error.what());
  }
}

/// Names that no other camera has: NAME, "NAME 2", "NAME 3", ...
class UniqueNames {
 public:
  std::string add(const std::string& name) {
    std::size_t& count = counts_[name];
    std::string unique = ++count == 1 ? name : fmt::format("{} {}", name, count);
    // A camera may be named "NAME 2" by the file.
    while (!taken_.insert(unique).second) unique = fmt::format("{} {}", name, ++count);
    return unique;
  }

 private:
  std::map<std::string, std::size_t> counts_;  ///< how far the numbers of a name have got
  std::set<std::string> taken_;
};

}  // namespace

std::vector<Camera> read_cameras(GltfDocument& document, std::span<const PlacedNode> nodes) {
  std::vector<Camera> cameras;
  UniqueNames names;
  std::size_t hidden = 0;
  for (const PlacedNode& placed : nodes) {
    const tinygltf::Node& node = document.model.nodes[static_cast<std::size_t>(placed.node)];
    if (node.camera < 0) continue;
    const std::optional<glm::mat4> pose = rigid_pose(placed);
    if (!pose) {
      ++hidden;
      continue;
    }
    const tinygltf::Camera& from = document.model.cameras[static_cast<std::size_t>(node.camera)];
    const std::string element = fmt::format("camera {}", node.camera);
    const std::string& own = from.name.empty() ? element : from.name;

    Camera camera;
    camera.name = names.add(node.name.empty() ? own : node.name);
    camera.world_from_camera = *pose;
    set_projection(from, camera);
    check_view(camera, document.origin.file, element);
    cameras.push_back(camera);
  }
  note_hidden(hidden, "cameras", document.notes);
  return cameras;
}

}  // namespace lamp::app
