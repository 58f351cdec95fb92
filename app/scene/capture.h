// Captured frames: a folder with frame.json, depth, and what else a renderer's G-buffer holds.
// The format: docs/capture.md.
// Promise: what was written is read back bit for bit; bad input is an Error that names the file and the element.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "scene/scene.h"

namespace lamp::app {

inline constexpr const char* CAPTURE_FILE = "frame.json";

/// Loads a capture's folder: a scene without meshes whose `captured` is filled, with the capture's lights and one
/// camera, named "capture". Depth becomes reversed device depth; what the folder lacks becomes neutral.
/// Throws Error with one line (file, element, what is wrong, what was expected).
[[nodiscard]] Scene load_capture(const std::filesystem::path& folder);

/// What a capture of a scene's frame holds: surfaces instead of meshes, and all lights of the frame.
[[nodiscard]] Scene captured_scene(const Scene& scene, std::vector<Light> lights, CapturedFrame captured);

enum class LightsFormat { npy, json };

/// Writes a scene whose `captured` is filled, with its lights, ambient light and sky. The folder appears whole or not
/// at all; one that is empty or holds a capture alone is replaced. Throws Error.
void write_capture(const std::filesystem::path& folder, const Scene& scene, LightsFormat lights);

/// Throws Error unless `write_capture` may make or replace this folder. Asked before long work begins; makes nothing.
void check_capture_folder(const std::filesystem::path& folder);

}  // namespace lamp::app
