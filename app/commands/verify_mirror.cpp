// Checks mirror rays, and prints what was found.
// SPDX-License-Identifier: Apache-2.0
#include "commands/verify_mirror.h"

#include <utility>

#include "commands/pictures.h"
#include "commands/verify_rows.h"
#include "system/print.h"
#include "system/progress.h"

namespace lamp::app {
namespace {

constexpr std::size_t MOST_RAYS = 50'000;  // of all pictures: a few seconds of rays in double precision

}  // namespace

std::optional<MirrorStats> verify_mirror(Session& session, const Setup& setup, Lighting& lighting) {
  Renderer& renderer = session.renderer();
  if (renderer.mirrored() == nullptr) return std::nullopt;
  const std::size_t pictures = renderer.all_pictures().size();
  const MirrorReference reference = mirror_reference(renderer, setup.scene);
  MirrorFindings findings;
  for_each_picture(renderer, [&](std::span<const float>) {
    show_progress("verify mirror rays");
    static_cast<void>(renderer.render(lighting));
    findings.add(check_mirror(renderer, session.shaders(), reference, setup.lights, MOST_RAYS / pictures));
  });
  std::optional<MirrorStats> stats = mirror_stats(renderer.mirrored());
  stats->findings = std::move(findings);
  return stats;
}

void print_mirror(const MirrorStats& stats) {
  print_out("mirror: {}\n", mirror_words(stats));
  for (const std::string& note : stats.notes) print_out("  note: {}\n", note);
  if (!stats.findings) return;
  print_out("mirror: {}  {}\n", mirror_words(*stats.findings), table_words(stats.findings->verdict()));
  if (const std::string reason = stats.findings->reason(); !reason.empty()) print_out("  {}\n", reason);
}

}  // namespace lamp::app
