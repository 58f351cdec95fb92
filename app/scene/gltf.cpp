// glTF 2.0 (.gltf, .glb) to a Scene, through tinygltf.
// Based on: Khronos, glTF 2.0 specification; KHR_lights_punctual; KHR_texture_transform.
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "files/read_file.h"
#include "scene/default_view.h"
#include "scene/gltf_cameras.h"
#include "scene/gltf_document.h"
#include "scene/gltf_error.h"
#include "scene/gltf_images.h"
#include "scene/gltf_lights.h"
#include "scene/gltf_material.h"
#include "scene/gltf_meshes.h"
#include "scene/gltf_nodes.h"
#include "scene/gltf_probes.h"
#include "scene/gltf_resources.h"

namespace lamp::app {
namespace {

/// What glTF does not say: how light it is where no light reaches.
constexpr glm::vec3 AMBIENT{0.02F, 0.02F, 0.025F};
constexpr glm::vec3 SKY{0.01F, 0.012F, 0.02F};

void check_extent(const Box& box, const std::string& file) {
  const glm::vec3 reach = glm::max(glm::abs(box.min), glm::abs(box.max));
  const float furthest = std::max({reach.x, reach.y, reach.z});
  if (!(furthest <= FURTHEST_M)) {
    gltf_fail(file, "scene", fmt::format("reaches {} m, expected at most {} m from the origin", furthest, FURTHEST_M));
  }
}

/// Of the file's own cameras and of the default ones, which stand outside of what is large.
void check_eyes(const Scene& scene, const std::string& file) {
  const auto check = [&file](const std::string& element, const glm::vec3& eye) {
    const double distance = glm::length(glm::dvec3(eye));
    if (!(distance <= double{FURTHEST_M}))
      gltf_fail(file, element,
                fmt::format("stands {:g} m from the origin, expected at most {:g} m", distance, FURTHEST_M));
  };
  for (const Camera& camera : scene.cameras)
    check(fmt::format("camera '{}'", camera.name), glm::vec3(camera.world_from_camera[3]));
  for (const FlightKey& key : scene.flight->keys) check("flight", key.eye);
}

/// The files of its buffers, and those of the images that it shows, each once.
std::vector<std::filesystem::path> files_beside(const GltfDocument& document, std::span<const GltfImageUse> uses) {
  std::vector<std::filesystem::path> files;
  const auto add = [&files](const std::filesystem::path& file) {
    if (std::ranges::find(files, file) == files.end()) files.push_back(file);
  };
  for (const std::filesystem::path& file : document.files) add(file);
  for (const GltfImageUse& use : uses) {
    const GltfImage& image = document.images[static_cast<std::size_t>(use.image)];
    if (image.buffer_view >= 0) continue;
    if (const auto file = external_file(image.uri, document.origin, image.name)) add(*file);
  }
  return files;
}

Scene to_scene(GltfDocument document, std::string name) {
  Scene scene;
  scene.name = std::move(name);
  scene.ambient = AMBIENT;
  scene.sky = SKY;

  GltfMaterials materials = read_materials(document);
  scene.materials = std::move(materials.materials);
  const std::vector<PlacedNode> nodes = place_nodes(document);
  add_meshes(document, nodes, scene);

  GltfLights lights = read_lights(document, nodes);
  scene.lights = std::move(lights.lights);
  scene.directional_lights = std::move(lights.directional_lights);

  scene.probes = read_probes(document, nodes);

  const Box box = bounds(scene);
  check_extent(box, document.origin.file);
  scene.cameras = read_cameras(document, nodes);
  const bool has_eye = !scene.cameras.empty() && !scene.cameras[0].orthographic;
  scene.flight = has_eye ? flight_at(scene.cameras[0], box) : default_flight(box);
  if (scene.cameras.empty()) scene.cameras.push_back(default_camera(box));
  check_eyes(scene, document.origin.file);

  // Last, as it takes longest: every other mistake in the file has been found by now.
  scene.images = read_images(document, materials.images);
  scene.files = files_beside(document, materials.images);
  scene.notes = std::move(document.notes);
  return scene;
}

}  // namespace

Scene load_gltf(const std::filesystem::path& file) {
  constexpr std::uint64_t LARGEST = std::uint64_t{1} << 32;  // bytes; a .glb cannot be larger
  GltfOrigin origin{file.string(), file.has_parent_path() ? file.parent_path() : std::filesystem::path(".")};
  return within_memory(origin.file, [&] {
    const std::vector<std::byte> bytes = read_file(file, {.expected = "a glTF file", .most_bytes = LARGEST});
    Scene scene = to_scene(read_document(bytes, origin), file.stem().string());
    scene.files.insert(scene.files.begin(), file);
    return scene;
  });
}

Scene load_gltf(std::span<const std::byte> bytes, const std::filesystem::path& folder, const std::string& name) {
  return to_scene(read_document(bytes, {name, folder}), name);
}

}  // namespace lamp::app
