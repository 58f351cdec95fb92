// Lists by the look-up that shading walks, truth by the oracle.
// SPDX-License-Identifier: Apache-2.0
#include "view/inspection.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <set>

#include "gpu/check.h"
#include "image/image.h"
#include "render/cell_masks.h"
#include "render/pixel_lights.h"
#include "render/verification.h"

namespace lamp::app {
namespace {

/// A number with spaces between its thousands, at which no line breaks.
std::string grouped(std::uint64_t number) {
  std::string text = fmt::format("{}", number);
  for (std::size_t i = text.size(); i > 3; i -= 3) text.insert(i - 3, "\u00A0");
  return text;
}

/// The pixels of one cell, and what encloses their surfaces.
struct CellPixels {
  std::vector<std::size_t> pixels;
  glm::uvec2 min_px{~0U};
  glm::uvec2 end_px{0};
  Box bounds{.min = glm::vec3(std::numeric_limits<float>::max()), .max = glm::vec3(-std::numeric_limits<float>::max())};
  double near_m = std::numeric_limits<double>::max();
  double far_m = 0.0;
};

glm::dvec3 position_of(const Inspected& of, std::size_t pixel) {
  const View& view = of.renderer.view();
  const auto number = static_cast<std::uint32_t>(pixel);
  return view.world_position(number % view.width(), number / view.width(), of.depth[pixel]);
}

CellPixels cell_pixels(const Inspected& of, std::uint32_t cell) {
  CellPixels found;
  for (std::size_t i = 0; i < of.visits.size(); ++i) {
    if (of.visits[i].cell != cell) continue;
    found.pixels.push_back(i);
    const std::uint32_t width = of.renderer.view().width();
    const glm::uvec2 pixel(i % width, i / width);
    found.min_px = glm::min(found.min_px, pixel);
    found.end_px = glm::max(found.end_px, pixel + 1U);
    const glm::vec3 position(position_of(of, i));
    found.bounds = {.min = glm::min(found.bounds.min, position), .max = glm::max(found.bounds.max, position)};
    const double z = of.renderer.view().z_view(of.depth[i]);
    found.near_m = std::min(found.near_m, z);
    found.far_m = std::max(found.far_m, z);
  }
  return found;
}

/// Lights that may reach what lies in the box: all others are farther away than their range, by more than rounding.
std::vector<std::uint32_t> near_lights(std::span<const shared::Light> lights, const Box& box) {
  constexpr float WIDER = 1.001F;
  std::vector<std::uint32_t> near;
  for (std::uint32_t i = 0; i < lights.size(); ++i) {
    const glm::vec3 position = lights[i].position;
    const glm::vec3 to_box = position - glm::clamp(position, box.min, box.max);
    if (glm::length(to_box) <= WIDER * lights[i].range) near.push_back(i);
  }
  return near;
}

/// The oracle's lights of a cell's pixels; those of other pixels of their rows are left empty.
Truth truth_of(const Inspected& of, const CellPixels& cell) {
  const std::uint32_t width = of.renderer.view().width();
  const std::vector<std::uint32_t> near = near_lights(of.listed(), cell.bounds);
  Truth truth{.first_row = static_cast<std::uint32_t>(cell.pixels.front() / width)};
  truth.rows = static_cast<std::uint32_t>(cell.pixels.back() / width) + 1 - truth.first_row;
  const std::size_t first = std::size_t{truth.first_row} * width;
  auto next = cell.pixels.begin();
  for (std::size_t i = 0; i < std::size_t{truth.rows} * width; ++i) {
    truth.offsets.push_back(static_cast<std::uint32_t>(truth.lights.size()));
    if (next == cell.pixels.end() || *next != first + i) continue;
    const glm::dvec3 position = position_of(of, *next++);
    for (const std::uint32_t light : near) {
      const Reach reached = reach(of.lights[light], position);
      if (reached == Reach::inside) truth.lights.push_back(light);
      if (reached == Reach::boundary) ++truth.boundary_pairs;
    }
  }
  truth.offsets.push_back(static_cast<std::uint32_t>(truth.lights.size()));
  return truth;
}

/// What visits of a truth's rows say, of those pixels alone that it has lights for.
void add(Proof& proof, const Truth& truth, std::span<const Visit> visits, std::uint32_t width) {
  for (std::size_t i = 0; i < visits.size(); ++i) {
    const std::uint32_t pairs = truth.offsets[i + 1] - truth.offsets[i];
    if (visits[i].ended) {
      ++proof.unfollowed;
      continue;
    }
    proof.pairs += pairs;
    proof.missed += visits[i].missed;
    if (visits[i].missed == 0 || !proof.first_miss.empty()) continue;
    const auto number = static_cast<std::uint32_t>(i);
    proof.first_miss = fmt::format("pixel ({}, {}): light {}", number % width, truth.first_row + number / width,
                                   visits[i].first_missed);
  }
}

gpu::CellMask mask_of(const Inspected& of, const CellPixels& cell) {
  std::vector<std::uint32_t> cell_of(of.visits.size(), gpu::NO_CELL);
  for (const std::size_t pixel : cell.pixels) cell_of[pixel] = 0;
  return cell_masks(of.renderer, cell_of, 1).front();
}

/// The smallest tile and depths that hold the cell's pixels.
gpu::ExplainedCell volume_of(const CellPixels& cell, const gpu::CellMask& mask) {
  return {.min_px = glm::vec2(cell.min_px),
          .max_px = glm::vec2(cell.end_px),
          .z_near = mask.z_near,
          .z_far = mask.z_far,
          .mask = mask.mask,
          .count = 0};
}

bool reaches_any(const Inspected& of, const CellPixels& cell, std::uint32_t light) {
  return std::ranges::any_of(
      cell.pixels, [&](std::size_t pixel) { return reach(of.lights[light], position_of(of, pixel)) == Reach::inside; });
}

/// Lists of still lights at these pixels.
void add_still(Proof& proof, const Inspected& of, std::span<const std::size_t> pixels) {
  if (of.still == nullptr) return;
  const StillFindings found = of.still->check(pixels);
  proof.pairs += found.lighting;
  proof.missed += found.missed;
  if (proof.first_miss.empty()) proof.first_miss = found.first_miss;
}

/// Which lights reach a pixel of the cell, and which tests they pass.
/// Of the lights that are listed, and of the one that is looked at.
void add_reasons(const Inspected& of, const CellPixels& cell, const Truth& truth, Inspection& found) {
  std::vector<ListedLight>& lights = found.lights;
  const std::set<std::uint32_t> reaching(truth.lights.begin(), truth.lights.end());
  std::vector<std::uint32_t> ids;
  for (const ListedLight& light : lights) ids.push_back(of.renderer.record_of(light.light));
  const bool looks = of.light && *of.light < of.lights.size();
  if (looks) ids.push_back(of.renderer.record_of(*of.light));
  const std::vector<gpu::Explained> explained = explain(of.renderer, of.shaders, volume_of(cell, found.mask), ids);
  for (std::size_t i = 0; i < lights.size(); ++i) {
    lights[i].reaches_cell =
        lights[i].still ? reaches_any(of, cell, lights[i].light) : reaching.contains(lights[i].light);
    lights[i].passes = explained[i].passes;
  }
  if (!looks) return;
  const bool is_listed = std::ranges::find(lights, *of.light, &ListedLight::light) != lights.end();
  found.looked_at = {
      .light = *of.light, .listed = is_listed, .passes = explained.back().passes, .parts = explained.back().parts};
}

/// Lights, and what the mirrored ray has of the reflection.
void add_listed(const Inspected& of, std::uint32_t pixel, std::span<const std::uint32_t> probes, Inspection& found) {
  const glm::dvec3 position = position_of(of, pixel);
  std::vector<std::uint32_t> ids = lights_at(of.renderer, of.lighting, pixel);
  const std::size_t of_picture = ids.size();
  if (of.still != nullptr) std::ranges::copy(of.still->lights_at(pixel), std::back_inserter(ids));
  std::vector<std::uint32_t> records;
  for (const std::uint32_t id : ids) records.push_back(of.renderer.record_of(id));
  const PixelTerms terms =
      terms_at(of.renderer, of.shaders, of.scene, of.lighting.info(), pixel, {.lights = records, .probes = probes});
  found.mirrored = 1.0F - terms.left_by_mirror;
  double sum = luminance(terms.surroundings);
  for (const glm::vec3& term : terms.lights) sum += luminance(term);
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const shared::Light& light = of.lights[ids[i]];
    found.lights.push_back({.light = ids[i],
                            .spot = light.type == shared::LIGHT_SPOT,
                            .distance_m = static_cast<float>(glm::length(glm::dvec3(light.position) - position)),
                            .range_m = light.range,
                            .reach = reach(light, position),
                            .share = sum > 0.0 ? luminance(terms.lights[i]) / sum : 0.0,
                            .still = i >= of_picture});
  }
}

/// As shading takes them: smallest first, until their weights sum to 1.
std::vector<std::uint32_t> walked_probes(const Inspected& of, std::uint32_t pixel) {
  if (of.renderer.probes().probes().empty()) return {};
  return probes_at(of.renderer, of.lighting, pixel);
}

std::vector<ListedProbe> listed_probes(const Inspected& of, std::uint32_t pixel, std::span<const std::uint32_t> found,
                                       float mirrored) {
  if (found.empty()) return {};
  const std::span<const gpu::ProbeData> all = of.renderer.probes().probes();
  const std::vector<ProbeWeight> weights =
      probe_weights(of.renderer, of.shaders, glm::vec3(position_of(of, pixel)), found);
  std::vector<ListedProbe> probes;
  float left = 1.0F;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const float share = std::min(left, weights[i].weight);
    left -= share;
    probes.push_back({.probe = found[i],
                      .slot = all[found[i]].slot,
                      .volume = weights[i].volume,
                      .weight = weights[i].weight,
                      .share = share * (1.0F - mirrored)});
  }
  return probes;
}

}  // namespace

std::string words_of(const Proof& proof) {
  std::string words = fmt::format("{} missed of {} pairs of pixel and light in {} pixels", grouped(proof.missed),
                                  grouped(proof.pairs), grouped(proof.pixels));
  if (!proof.first_miss.empty()) words += ", the first: " + proof.first_miss;
  if (proof.unfollowed != 0)
    words +=
        fmt::format("; the device ended the walks of {} pixels, which could not be checked", grouped(proof.unfollowed));
  return words;
}

std::string words_of(std::span<const Proof> proofs) {
  if (proofs.size() == 1) return words_of(proofs.front());
  return fmt::format("A: {}; B: {}", words_of(proofs[0]), words_of(proofs[1]));
}

std::span<const std::string_view> test_names() {
  static constexpr std::array<std::string_view, 6> NAMES{"sides", "depths", "mask", "box", "exact", "cone"};
  return NAMES;
}

std::string names_of(std::uint32_t tests) {
  std::string names;
  for (std::size_t i = 0; i < test_names().size(); ++i)
    if ((tests >> i & 1U) != 0) names += fmt::format("{}{}", names.empty() ? "" : ", ", test_names()[i]);
  return names;
}

std::string why_listed(const ListedLight& light, const OwnTests& own) {
  if (light.reach != Reach::outside) return "reaches the pixel";
  if (light.reaches_cell) return "reaches the cell";
  const std::uint32_t made = light.spot ? own.passes : own.passes & ~gpu::PASSES_CONE;
  const std::uint32_t dropping = gpu::PASSES_ALL & ~light.passes;
  if ((made & dropping) != 0) return "larger cell: " + names_of(made & dropping) + " would drop it";
  const std::string kept = made != 0 ? "kept by " + names_of(made) : std::string(own.otherwise);
  return kept + (dropping == 0 ? "; no test drops it" : "; not by " + names_of(dropping));
}

std::string explained(const ListedLight& light, const OwnTests& own) {
  if (light.reach != Reach::outside) return "It reaches the surface in this pixel, so the list must have it.";
  if (light.reaches_cell)
    return "It does not reach this pixel, but another of the same cell, and a cell has one list for all its pixels.";
  return fmt::format(
      "It reaches no pixel of the cell: {}. Tests ask whether a light touches the cell: its four side planes (sides), "
      "its nearest to its farthest surface (depths), the occupied ones of 32 parts of these depths (mask), the box "
      "around it (box), the frustum's part itself (exact), and whether a spot's cone does (cone).",
      why_listed(light, own));
}

Inspection inspect(const Inspected& of, glm::uvec2 pixel) {
  const View& view = of.renderer.view();
  Inspection found{.pixel = glm::min(pixel, glm::uvec2(view.width(), view.height()) - 1U)};
  const std::size_t number = found.pixel.x + std::size_t{view.width()} * found.pixel.y;
  if (of.visits[number].cell == gpu::SKY_CELL) return found;
  found.sky = false;
  found.cell = of.visits[number].cell;
  found.position = position_of(of, number);
  found.z_view = static_cast<float>(view.z_view(of.depth[number]));
  const CellPixels cell = cell_pixels(of, found.cell);
  found.cell_pixels = static_cast<std::uint32_t>(cell.pixels.size());
  found.cell_min_px = cell.min_px;
  found.cell_end_px = cell.end_px;
  found.cell_near_m = static_cast<float>(cell.near_m);
  found.cell_far_m = static_cast<float>(cell.far_m);
  found.own = own_tests(of.lighting.runner().plan(), of.lighting.info().options);
  if (of.still != nullptr) found.still_own = of.still->tests();
  const std::vector<std::uint32_t> probes = walked_probes(of, static_cast<std::uint32_t>(number));
  add_listed(of, static_cast<std::uint32_t>(number), probes, found);
  found.probes = listed_probes(of, static_cast<std::uint32_t>(number), probes, found.mirrored);
  const Truth truth = truth_of(of, cell);
  found.proof.pixels = cell.pixels.size();
  found.mask = mask_of(of, cell);
  add_reasons(of, cell, truth, found);
  add(found.proof, truth, of.renderer.visit(of.lighting, truth), view.width());
  add_still(found.proof, of, cell.pixels);
  return found;
}

void compare(OtherList& other, std::span<const ListedLight> lights) {
  std::vector<std::uint32_t> own;
  for (const ListedLight& light : lights) own.push_back(light.light);
  std::ranges::sort(own);
  other.beyond.clear();
  other.without.clear();
  if (!other.refused.empty()) return;
  std::ranges::set_difference(other.lights, own, std::back_inserter(other.beyond));
  std::ranges::set_difference(own, other.lights, std::back_inserter(other.without));
}

Proof prove(const Inspected& of, const std::function<void(float)>& progress) {
  const View& view = of.renderer.view();
  Proof proof;
  for (const float depth : of.depth) proof.pixels += depth != view.sky_depth() ? 1 : 0;
  constexpr std::uint32_t BAND = 16;  // rows: often enough for a progress bar to move
  for (std::uint32_t row = 0; row < view.height(); row += BAND) {
    progress(static_cast<float>(row) / static_cast<float>(view.height()));
    for_each_truth({.view = view,
                    .depth = of.depth,
                    .lights = of.listed(),
                    .first_row = row,
                    .rows = std::min(BAND, view.height() - row)},
                   [&](const Truth& truth) { add(proof, truth, of.renderer.visit(of.lighting, truth), view.width()); });
    std::vector<std::size_t> pixels;
    for (std::size_t i = std::size_t{row} * view.width();
         i < std::min<std::size_t>(row + BAND, view.height()) * view.width(); ++i)
      if (of.depth[i] != view.sky_depth()) pixels.push_back(i);
    add_still(proof, of, pixels);
  }
  return proof;
}

}  // namespace lamp::app
