// Checks lists of still lights, and prints what was found.
// SPDX-License-Identifier: Apache-2.0
#include "commands/verify_still.h"

#include <fmt/format.h>

#include <algorithm>

#include "commands/pictures.h"
#include "commands/verify_rows.h"
#include "render/scene_occluders.h"
#include "system/print.h"
#include "system/progress.h"

namespace lamp::app {
namespace {

constexpr std::size_t RANDOM_POINTS = 10'000;  // unless another number is asked for
constexpr std::size_t MOST_SEEN = 20'000;      // pixels whose lights are held against rays
constexpr std::size_t AT_ONCE = 1U << 16;      // points whose truth is held

void add(StillFindings& sum, const StillFindings& more) {
  if (sum.missed == 0) sum.first_miss = more.first_miss;
  sum.points += more.points;
  sum.missed += more.missed;
  sum.walked += more.walked;
  sum.reaching += more.reaching;
  sum.lighting += more.lighting;
  sum.boundary_pairs += more.boundary_pairs;
  sum.unordered += more.unordered;
  sum.differing += more.differing;
  sum.longest = std::max(sum.longest, more.longest);
}

StillFindings check_all(const StillCheck& check, std::span<const gpu::StillPoint> points, std::string_view kind) {
  StillFindings sum;
  for (std::size_t first = 0; first < points.size(); first += AT_ONCE) {
    show_progress(fmt::format("verify still lights: {}, {} %", kind, 100 * first / points.size()));
    add(sum, check_still_points(check, points.subspan(first, std::min(AT_ONCE, points.size() - first))));
  }
  return sum;
}

/// Every so many, so that no more than `most` are left.
std::vector<gpu::StillPoint> thinned(const std::vector<gpu::StillPoint>& points, std::size_t most) {
  const std::size_t step = (points.size() + most - 1) / most;
  std::vector<gpu::StillPoint> kept;
  for (std::size_t i = 0; i < points.size(); i += step) kept.push_back(points[i]);
  return kept;
}

}  // namespace

std::optional<StillStats> check_still_lists(const Request& request, Session& session, const Setup& setup,
                                            std::uint32_t points) {
  if (session.still() == nullptr) return std::nullopt;
  const StillSetup& still = *session.still();
  StillStats stats = still_stats(still);
  std::optional<Occluders> occluders;
  if (request.still_occlusion != 0) occluders = scene_occluders(setup.scene);
  const StillCheck check{.context = session.context(),
                         .shaders = session.shaders(),
                         .triangles = still.tree ? std::span<const StillTriangle>() : still.triangles,
                         .lights = setup.standing(),
                         .list = [&](const gpu::StillPoint& point) { return still.lights_at(point); },
                         .on_gpu = *session.renderer().still(),
                         .occluders = occluders ? &*occluders : nullptr};
  std::vector<gpu::StillPoint> pixels;
  for_each_picture(session.renderer(), [&](std::span<const float>) {
    const std::vector<gpu::StillPoint> more = points_of_pixels(session.renderer());
    pixels.insert(pixels.end(), more.begin(), more.end());
  });
  if (occluders && pixels.size() > MOST_SEEN) pixels = thinned(pixels, MOST_SEEN);
  stats.findings.emplace_back("pixels", check_all(check, pixels, "pixels"));
  const std::size_t count = points == 0 ? RANDOM_POINTS : points;
  stats.findings.emplace_back(
      "surfaces", check_all(check, random_points_on(still.triangles, count, request.seed), "points on surfaces"));
  return stats;
}

void print_still(const StillStats& stats) {
  print_out("still lights: {}\n", still_words(stats));
  for (const std::string& note : stats.notes) print_out("  note: {}\n", note);
  print_out("{:<24} {:>8} {:>8} {:>12} {:>12} {:>12} {:>8} {:>8} {:>8}\n", "  at", "points", "missed", "walked",
            "reaching", "lighting", "waste", "of lit", "longest");
  for (const auto& [kind, f] : stats.findings) {
    print_out("  {:<22} {:>8} {:>8} {:>12} {:>12} {:>12} {:>8.2f} {:>8.2f} {:>8}  {}\n", kind, f.points, f.missed,
              f.walked, f.reaching, f.lighting, waste_of(f.walked, f.reaching), waste_of(f.walked, f.lighting),
              f.longest, table_words(f.verdict()));
    if (f.missed != 0) print_out("  first miss: {}\n", f.first_miss);
    if (f.unordered != 0) print_out("  the lists of {} points do not ascend\n", f.unordered);
    if (f.differing != 0) print_out("  the device walks other lists than the host at {} points\n", f.differing);
  }
  print_out("  lighting: reaching, not behind the surface, and, where walls hide lights, seen by a ray\n");
}

Verdict verdict_of(const StillStats& stats) {
  Verdict worst = Verdict::ok;
  for (const auto& found : stats.findings) worst = std::max(worst, found.second.verdict());
  return worst;
}

}  // namespace lamp::app
