// What a stage keeps of a scene and of its lights, from state to state.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/kept_rays.h"
#include "render/light_mover.h"
#include "render/probe_captures.h"
#include "view/stage.h"

namespace lamp::app {

struct Stage::KeptScene {
  std::string name;
  Setup setup;
  Scene& scene = setup.scene;  ///< of it, its instances where they were moved
  int moved_to = -1;           ///< frame, of instances that move
  std::optional<OpenAir> air;
  std::optional<Box> bounds;
  std::unique_ptr<GpuScene> gpu;
  KeptRays rays;
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

/// Lists of lights that stand still. They stay while a renderer refers to them.
struct Stage::KeptStill {
  std::string key;
  std::shared_ptr<const MovingLights> of;  ///< of which these stand still
  std::vector<shared::Light> lights;
  StillSetup made;
  std::unique_ptr<StillLists> lists;
  std::optional<Occluders> occluders;
};

/// Probes and what they show. They stay while a renderer refers to them.
struct Stage::KeptProbes {
  std::unique_ptr<FlatProbes> flat;
  std::unique_ptr<ProbeCaptures> captures;
  std::string seen;  ///< what they were renewed for last

  [[nodiscard]] const ProbeSet& set() const { return captures ? captures->set() : flat->set; }
};

}  // namespace lamp::app
