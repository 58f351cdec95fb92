// What a stage keeps of a scene and of its lights, from state to state.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/light_mover.h"
#include "view/stage.h"

namespace lamp::app {

struct Stage::KeptScene {
  std::string name;
  Scene scene;
  std::optional<OpenAir> air;
  std::unique_ptr<GpuScene> gpu;
};

struct Stage::KeptLights {
  std::string key;
  MovingLights made;  ///< without edits
  std::vector<gpu::DecalData> decals;
  std::string edits;
  std::shared_ptr<const MovingLights> moving;
  PathTime time;
  std::shared_ptr<const FrameLights> lights;
  bool brought = false;  ///< to the renderer, wherever they were then
  std::unique_ptr<LightMover> mover;
};

}  // namespace lamp::app
