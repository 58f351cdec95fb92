// A scene as rays read it, for those who ask for it now and then: made at the first question, and kept.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "render/mirror_scene.h"
#include "render/renderer.h"

namespace lamp::app {

class KeptRays {
 public:
  /// Instances of the scene have moved.
  void move() { moved_ = true; }

  /// Where its instances are: that of the renderer's mirrors, or one's own, which takes a while to make. The scene must
  /// be the same one each time, and live on. Throws what MirrorScene does.
  [[nodiscard]] const MirrorScene& of(Context& context, const GpuScene& scene, Renderer& renderer);

 private:
  std::optional<MirrorScene> rays_;
  bool moved_ = false;  ///< since it was asked for last
};

}  // namespace lamp::app
