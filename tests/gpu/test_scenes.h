// Scenes for tests, each made once a process, and the reliefs of what their cameras see.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "gpu/gpu_test.h"
#include "scene/builtin.h"
#include "scene/open_air.h"

namespace lamp::app {

/// A scene with what its tests need. Stays where it is: the GPU's form refers to the scene.
struct TestScene {
  explicit TestScene(Scene made) : scene(std::move(made)), air(find_open_air(scene)), gpu(test_context(), scene) {}
  TestScene(const TestScene&) = delete;
  TestScene& operator=(const TestScene&) = delete;

  Scene scene;
  OpenAir air;
  GpuScene gpu;
};

[[nodiscard]] const TestScene& builtin_test_scene(std::string_view name);

/// The built-in scenes that are not adversarial, or those that are.
[[nodiscard]] std::vector<BuiltinScene> ordinary_scenes();
[[nodiscard]] std::vector<BuiltinScene> adversarial_scenes();

/// What `--projection` offers, without "camera".
[[nodiscard]] std::vector<std::string_view> tested_projections();

/// A name as GoogleTest takes it: letters, digits and underscores.
[[nodiscard]] std::string test_name(std::string_view name);

/// A scene that gives the same depths for a view, but quickly: one quad for each pixel that is not sky, which faces the
/// eye. At small sizes nearly all of a frame's time would go into geometry that is smaller than a pixel.
[[nodiscard]] Scene relief_of(const View& view, std::span<const float> depth);

}  // namespace lamp::app
