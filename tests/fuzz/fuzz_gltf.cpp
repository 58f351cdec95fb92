// Fuzzes the glTF loader: any bytes give a scene or an Error, without crash, leak or undefined behaviour.
// Seeds: corpus_gltf/. Build with -DLAMPLIGHT_FUZZ=ON; other files are never opened, as there is no folder.
// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>

#include "error.h"
#include "scene/gltf.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    const lamp::app::Scene scene =
        lamp::app::load_gltf(std::as_bytes(std::span(data, size)), std::filesystem::path(), "fuzz");
    // What renders trusts: every index in range.
    for (const lamp::app::Mesh& mesh : scene.meshes) {
      if (mesh.material >= scene.materials.size()) std::abort();
      for (std::uint32_t i = 0; i < mesh.index_count; ++i) {
        if (mesh.vertex_offset + scene.indices.at(mesh.first_index + i) >= scene.vertices.size()) std::abort();
      }
    }
    if (scene.cameras.empty() || lamp::check_lights(scene.lights)) std::abort();
  } catch (const lamp::app::Error&) {
    return 0;
  }
  return 0;
}
