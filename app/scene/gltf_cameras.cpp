// The cameras that nodes of a glTF file carry.
// Based on: Khronos, glTF 2.0 specification, section 3.10 (cameras).
// Promise: rigid poses, whatever scale the nodes have.
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_cameras.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

#include "scene/gltf_error.h"

namespace lamp::app {
namespace {

/// Keeps the place, the direction of view (-Z) and the side that is up; drops scale, shear and mirroring.
glm::mat4 rigid_pose(const GltfDocument& document, const PlacedNode& placed) {
  const glm::dmat4& world = placed.world_from_node;
  const glm::dvec3 back(world[2]);
  const glm::dvec3 right = glm::cross(glm::dvec3(world[1]), back);
  if (!(glm::length(back) > 1e-12) || !(glm::length(right) > 1e-12)) {
    gltf_fail(document.origin.file, fmt::format("node {}", placed.node),
              "its transform flattens the camera, expected a scale that is not 0");
  }
  const glm::dvec3 z = glm::normalize(back);
  const glm::dvec3 x = glm::normalize(right);
  return glm::mat4(glm::dmat4(glm::dvec4(x, 0.0), glm::dvec4(glm::cross(z, x), 0.0), glm::dvec4(z, 0.0), world[3]));
}

void set_perspective(const tinygltf::PerspectiveCamera& from, const std::string& file, const std::string& element,
                     Camera& camera) {
  if (from.yfov >= glm::pi<double>()) {
    gltf_fail(file, element, fmt::format("yfov is {}, expected less than pi radians", from.yfov));
  }
  if (from.zfar != 0.0 && from.zfar <= from.znear) {
    gltf_fail(file, element, fmt::format("zfar is {}, expected more than znear, {}", from.zfar, from.znear));
  }
  camera.fov_y = static_cast<float>(from.yfov);
  camera.near_m = static_cast<float>(from.znear);
  camera.far_m = static_cast<float>(from.zfar);  // missing: 0, which is infinite here
}

void set_orthographic(const tinygltf::OrthographicCamera& from, const std::string& file, const std::string& element,
                      Camera& camera) {
  if (from.ymag == 0.0) gltf_fail(file, element, "ymag is 0, expected another number");
  if (from.zfar <= from.znear) {
    gltf_fail(file, element, fmt::format("zfar is {}, expected more than znear, {}", from.zfar, from.znear));
  }
  camera.orthographic = true;
  camera.half_height = static_cast<float>(std::abs(from.ymag));
  camera.near_m = static_cast<float>(from.znear);
  camera.far_m = static_cast<float>(from.zfar);
}

/// The first of NAME, "NAME 2", "NAME 3", ... that no camera has.
std::string unique_name(const std::string& name, const std::vector<Camera>& cameras) {
  std::string candidate = name;
  for (int number = 2; std::ranges::find(cameras, candidate, &Camera::name) != cameras.end(); ++number) {
    candidate = fmt::format("{} {}", name, number);
  }
  return candidate;
}

}  // namespace

std::vector<Camera> read_cameras(const GltfDocument& document, std::span<const PlacedNode> nodes) {
  std::vector<Camera> cameras;
  for (const PlacedNode& placed : nodes) {
    const tinygltf::Node& node = document.model.nodes[static_cast<std::size_t>(placed.node)];
    if (node.camera < 0) continue;
    const tinygltf::Camera& from = document.model.cameras[static_cast<std::size_t>(node.camera)];
    const std::string element = fmt::format("camera {}", node.camera);
    const std::string& own = from.name.empty() ? element : from.name;

    Camera camera;
    camera.name = unique_name(node.name.empty() ? own : node.name, cameras);
    camera.world_from_camera = rigid_pose(document, placed);
    if (from.type == "perspective") {
      set_perspective(from.perspective, document.origin.file, element, camera);
    } else {
      set_orthographic(from.orthographic, document.origin.file, element, camera);
    }
    cameras.push_back(camera);
  }
  return cameras;
}

}  // namespace lamp::app
