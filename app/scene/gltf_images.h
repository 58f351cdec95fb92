// Decodes the images that materials use, in parallel.
// Based on: stb_image (PNG and JPEG, the two formats of glTF 2.0).
// Promise: an image that cannot be read or decoded is an Error that names it, never a blank.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "scene/gltf_document.h"
#include "scene/gltf_material.h"
#include "scene/scene.h"

namespace lamp::app {

/// One image for each use. Throws the Error of the first use that fails.
[[nodiscard]] std::vector<Image> read_images(const GltfDocument& document, std::span<const GltfImageUse> uses);

}  // namespace lamp::app
