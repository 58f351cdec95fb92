// Asks the shadows of a session's frame.
// SPDX-License-Identifier: Apache-2.0
#include "commands/verify_shadows.h"

#include <string>

#include "commands/pictures.h"
#include "render/scene_occluders.h"
#include "system/progress.h"

namespace lamp::app {

bool is_cut(Session& session, const Lighting& lighting) { return is_cut(session.renderer(), lighting); }

std::optional<ShadowFindings> shadow_findings(Session& session, const Setup& setup) {
  Renderer& renderer = session.renderer();
  if (renderer.shadows() == nullptr) return std::nullopt;
  std::optional<Progress> progress;  // of one part
  std::string part;
  const auto show = [&](const std::string& what, double done) {
    if (part != what) progress.emplace();
    part = what;
    progress->show("verify shadows: " + what, done);
  };
  show_progress("verify shadows");
  const Occluders occluders = scene_occluders(setup.scene);
  ShadowFindings findings;
  for_each_picture(renderer, [&](std::span<const float>) {
    findings.add(check_shadows(renderer, session.shaders(), occluders, setup.lights, show));
  });
  return findings;
}

}  // namespace lamp::app
