// Rasterised culling: lights are drawn as meshes, and a fragment sets the light's bit in its tile, or in the clusters
// from the mesh's front to its back. Based on: Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH
// Advances (2017), "Rasterization based culling". Promise: meshes enclose their lights by what a sample may be off a
// pixel's centre, so no pixel is lost at any resolution; two indirect draws for all lights; bits do not depend on who
// comes first.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "lamplight/shared/light_mesh.h"
#include "lamplight/shared/proxy.h"
#include "lamplight/shared/tile.h"
#include "methods.h"
#include "parts.h"

namespace lamp {
namespace {

/// How tiles are sampled.
struct Raster {
  std::uint32_t pixel = 1;       ///< pixels the side of a raster pixel
  std::uint32_t samples = 1;     ///< of a raster pixel
  bool depth_at_centres = true;  ///< the depth image has one sample a pixel
  double reach_px = 0.0;         ///< the nearest sample of the raster pixel is at most that far from a pixel's centre
  bool conservative = false;     ///< the device finds every raster pixel that a triangle touches
  /// Every sample is the centre of a pixel, and the depth image knows no other place.
  [[nodiscard]] bool exact() const { return pixel == 1 && samples == 1 && depth_at_centres; }
};

/// How far a mesh's edges are off, in raster pixels. Devices snap corners to a grid, by up to a step along each side,
/// and may cut triangles at the picture's edge before that: cracks open between neighbours. SwiftShader does so with
/// steps of 1/16, and lost a tile's only sample with a margin of 1.5 steps, none with 8. At least 0.05, for what the
/// arithmetic before that rounds.
double snapped(const DeviceTraits& traits) {
  return std::max(0.05, 8.0 * std::ldexp(1.0, -static_cast<int>(traits.sub_pixel_bits)));
}

/// Whether the plane of a triangle that is thinner than a raster pixel is still that of the face.
bool knows_face_depths(const DeviceTraits& traits) { return traits.sub_pixel_bits >= 8; }

/// Vulkan's standard places of four samples: within 0.4 of a raster pixel's side from any point of it.
Raster raster_of(Plan& plan, const Problem& problem) {
  const double snap = snapped(problem.traits);
  std::string word = problem.options.word("raster");
  if (word == "conservative" && problem.traits.conservative_raster)
    return {.pixel = 8, .samples = 1, .reach_px = snap * 8, .conservative = true};
  if (word == "conservative") {
    word = "half-msaa";
    plan.notes.emplace_back("raster=half-msaa instead of conservative: the device has no conservative rasterization");
  }
  if (word == "half-msaa") return {.pixel = 2, .samples = 4, .reach_px = (0.4 + snap) * 2};
  if (word == "quarter-msaa") return {.pixel = 4, .samples = 4, .reach_px = (0.4 + snap) * 4};
  // Samples of a depth image that has several lie anywhere in their pixel: at most half a diagonal from its centre.
  const bool several = problem.depth_samples > 1;
  return {.pixel = 1, .samples = 1, .depth_at_centres = !several, .reach_px = several ? 0.71 + snap : snap};
}

struct Buffers {
  ResourceId proxies, drawn, draws, ranges, stencil, bits;
};

bool is_cut(const Options& options) { return options.word("proxy") == "cut"; }

/// The meshes, or another resource, which is not read.
Binding mesh_binding(const Problem& problem) { return {is_cut(problem.options) ? INPUT_MESHES : INPUT_LIGHTS}; }

Pass proxy_pass(const Problem& problem, const Raster& raster, const Buffers& b) {
  return {.name = "light proxies",
          .shader = "methods/light_proxies",
          .constants = {parts::capacity(problem), static_cast<std::uint32_t>(raster.reach_px * 1024.0),
                        is_cut(problem.options) ? 1U : 0U},
          .bindings = {{INPUT_FRAME},
                       {INPUT_LIGHTS},
                       {b.proxies, Access::write},
                       {b.drawn, Access::write},
                       {b.draws, Access::read_write},
                       mesh_binding(problem)},
          .extent = {.lights_per_group = 64}};
}

Pass depth_pass(std::uint32_t tile_px, ResourceId ranges) {
  return {.name = "tile depth",
          .shader = "methods/tile_depth_pass",
          .constants = {tile_px / 2, tile_px, shared::BOUNDS_MINMAX},
          .bindings = {{INPUT_FRAME}, {INPUT_DEPTH}, {ranges, Access::write}},
          .extent = {.cells = {.px = tile_px}}};
}

/// A draw of the lights outside or inside of which the eye is, those of cut lights apart. Constants: those of
/// raster_inputs.glsl.
struct Draw {
  std::string name;
  const char* shader;
  std::uint32_t which;
  RasterState::Cull cull;
};

Pass draw_pass(const Problem& problem, const Raster& raster, const Buffers& b, const Draw& draw) {
  return {.name = draw.name,
          .kind = PassKind::raster,
          .shader = draw.shader,
          .constants = {parts::capacity(problem), draw.which, raster.pixel, problem.options.integer("tile"),
                        parts::divide_up(parts::capacity(problem), 32), raster.exact() ? 1U : 0U,
                        knows_face_depths(problem.traits) ? 1U : 0U},
          .bindings = {{INPUT_FRAME}, {INPUT_LIGHTS}, {b.proxies}, {b.drawn}, mesh_binding(problem)},
          .extent = {.indirect = b.draws, .indirect_offset = draw.which * sizeof(shared::ProxyDraw)},
          .raster = {.vertex_shader = "methods/light_proxy",
                     .pixel = raster.pixel,
                     .samples = raster.samples,
                     .conservative = raster.conservative,
                     .cull = draw.cull}};
}

/// Whether atomics are merged: as asked, if the device can.
bool compacts(Plan& plan, const Problem& problem) {
  if (problem.options.word("compact") == "off") return false;
  const SubgroupOperations& has = problem.traits.fragment_subgroups;
  if (has.ballot && has.arithmetic) return true;
  plan.notes.emplace_back("compact=off instead of on: the device has no subgroup ballot and arithmetic in fragments");
  return false;
}

/// Proxies and their draws, which all rasterised culling begins with.
Buffers add_proxies(Plan& plan, const Problem& problem, const Raster& raster) {
  const std::uint64_t lights = parts::capacity(problem);
  Buffers b{};
  b.proxies = plan.add({.name = "light proxies", .bytes = lights * sizeof(shared::LightProxy)});
  const std::uint64_t draws = is_cut(problem.options) ? 4 : 2;
  b.drawn = plan.add({.name = "drawn lights", .bytes = draws * lights * 4});
  b.draws = plan.add({.name = "draws", .bytes = draws * sizeof(shared::ProxyDraw), .zeroed = true, .indirect = true});
  plan.passes.push_back(proxy_pass(problem, raster, b));
  return b;
}

/// A draw of tiles, and what its fragments do.
struct TileDraw {
  Draw draw;
  std::uint32_t step;
  ResourceId writes;
};

/// Draws with their like of cut lights behind them, if these are cut. `Drawn` has a Draw.
template <class Drawn>
std::vector<Drawn> with_cut(const Problem& problem, std::vector<Drawn> draws) {
  const std::size_t count = is_cut(problem.options) ? draws.size() : 0;
  for (std::size_t i = 0; i < count; ++i) {
    Drawn cut = draws[i];
    cut.draw.name += ", cut lights";
    cut.draw.which += shared::CUT_OUTSIDE - shared::PROXIES_OUTSIDE;
    draws.push_back(std::move(cut));
  }
  return draws;
}

/// Draws in their order. With depth=stencil the eye's outside takes two: front faces into bits that are the stencil,
/// kept by the tile so that one draw serves all lights, then back faces.
std::vector<TileDraw> tile_draws(Plan& plan, const Problem& problem, Buffers& b) {
  using Cull = RasterState::Cull;
  const char* shader = compacts(plan, problem) ? "methods/raster_tile_compact" : "methods/raster_tile";
  const TileDraw around{
      {"back faces around the eye", shader, shared::PROXIES_INSIDE, Cull::front}, shared::TILES_ONE_PASS, b.bits};
  const Draw front{"front faces", shader, shared::PROXIES_OUTSIDE, Cull::back};
  if (problem.options.word("depth") != "stencil") return {{front, shared::TILES_ONE_PASS, b.bits}, around};
  BufferDesc stencil = plan.buffers[b.bits - PLAN_BUFFER];
  stencil.name = "tile stencil";
  b.stencil = plan.add(std::move(stencil));
  return {{front, shared::TILES_STENCIL, b.stencil},
          {{"back faces", shader, shared::PROXIES_OUTSIDE, Cull::front}, shared::TILES_BEHIND, b.bits},
          around};
}

Plan plan_raster_tile(const Problem& problem) {
  const std::uint32_t tile_px = problem.options.integer("tile");
  const std::uint64_t tiles = parts::tile_count(problem, tile_px);
  const std::uint32_t words = parts::divide_up(parts::capacity(problem), 32);
  Plan plan;
  const Raster raster = raster_of(plan, problem);
  plan.cells = tiles;
  Buffers b = add_proxies(plan, problem, raster);
  b.bits = plan.add(parts::zeroed_cells("tile bits", problem, {.px = tile_px}, std::uint64_t{words} * 4));
  if (!raster.exact()) {
    b.ranges = plan.add({.name = "tile depth ranges", .bytes = tiles * sizeof(shared::TileRanges)});
    plan.passes.push_back(depth_pass(tile_px, b.ranges));
  }
  const std::uint32_t depth_bounds = problem.options.word("depth") == "test" ? 0 : 1;
  for (const auto& [draw, step, writes] : with_cut(problem, tile_draws(plan, problem, b))) {
    Pass pass = draw_pass(problem, raster, b, draw);
    pass.constants.insert(pass.constants.end(), {step, depth_bounds, parts::further_tests(problem.options)});
    pass.bindings.insert(pass.bindings.end(), {{INPUT_DEPTH},
                                               {raster.exact() ? INPUT_LIGHTS : b.ranges},
                                               {writes, Access::read_write},
                                               {step == shared::TILES_BEHIND ? b.stencil : INPUT_LIGHTS},
                                               parts::radial_binding(problem, INPUT_LIGHTS)});
    plan.passes.push_back(std::move(pass));
  }
  plan.lookup = {.name = parts::walk_lookup(plan, problem, "tile_bits"),
                 .constants = {tile_px, words, 1},
                 .bindings = {{INPUT_FRAME}, {b.bits}, {INPUT_FRAME}}};
  return plan;
}

struct ClusterDraw {
  Draw draw;
  std::uint32_t mode;
};

/// The depth pass's work groups take no larger squares.
constexpr std::uint32_t LARGEST_RANGE_PX = 32;

Plan plan_raster_cluster(const Problem& problem) {
  using Cull = RasterState::Cull;
  const Options& o = problem.options;
  const std::uint64_t clusters = parts::tile_count(problem, o.integer("tile")) * o.integer("slices");
  const std::uint32_t words = parts::divide_up(parts::capacity(problem), 32);
  const std::vector<std::uint32_t> slices{o.integer("slices"), parts::slice_scale(o.word("scale")),
                                          o.integer("near_mm"), o.integer("far_m")};
  Plan plan;
  const Raster raster = raster_of(plan, problem);
  plan.cells = clusters;
  Buffers b = add_proxies(plan, problem, raster);
  b.bits = plan.add(parts::zeroed_cells(
      "cluster bits", problem, {.px = o.integer("tile"), .layers = o.integer("slices")}, std::uint64_t{words} * 4));
  plan.any_depth = o.word("early") == "off";
  plan.approximate = o.word("mark") == "first";
  const std::uint32_t early_px = o.word("early") == "on" ? std::min(o.integer("tile"), LARGEST_RANGE_PX) : 0;
  if (early_px != 0) {
    const std::uint64_t squares = parts::tile_count(problem, early_px);
    b.ranges = plan.add({.name = "tile depth ranges", .bytes = squares * sizeof(shared::TileRanges)});
    plan.passes.push_back(depth_pass(early_px, b.ranges));
  }
  const char* shader = compacts(plan, problem) ? "methods/raster_cluster_compact" : "methods/raster_cluster";
  const std::vector<ClusterDraw> draws{
      {{"mark back faces", shader, shared::PROXIES_OUTSIDE, Cull::front}, shared::CLUSTERS_MARK},
      {{"walk from front faces", shader, shared::PROXIES_OUTSIDE, Cull::back}, shared::CLUSTERS_WALK},
      {{"walk from the eye", shader, shared::PROXIES_INSIDE, Cull::front}, shared::CLUSTERS_FROM_EYE}};
  for (const auto& [draw, mode] : with_cut(problem, draws)) {
    Pass pass = draw_pass(problem, raster, b, draw);
    pass.constants.push_back(mode);
    pass.constants.insert(pass.constants.end(), slices.begin(), slices.end());
    pass.constants.insert(pass.constants.end(),
                          {early_px, parts::further_tests(problem.options), plan.approximate ? 1U : 0U});
    pass.bindings.insert(pass.bindings.end(), {{b.bits, Access::read_write},
                                               {early_px != 0 ? b.ranges : INPUT_LIGHTS},
                                               parts::radial_binding(problem, INPUT_LIGHTS)});
    plan.passes.push_back(std::move(pass));
  }
  plan.lookup = {.name = parts::walk_lookup(plan, problem, "cluster_bits"),
                 .constants = {o.integer("tile")},
                 .bindings = {{INPUT_FRAME}, {b.bits}}};
  plan.lookup.constants.insert(plan.lookup.constants.end(), slices.begin(), slices.end());
  plan.lookup.constants.push_back(words);
  return plan;
}

std::optional<Error> check_raster_walk(const Problem& problem) {
  return parts::check_walk(problem.options, parts::Container::bits);
}

OptionSpec raster_option() {
  return {.key = "raster",
          .help = "full resolution; four samples a pixel at half or a quarter of it; by 8 pixels, found by the device",
          .fallback = "half-msaa",
          .choices = {"full", "half-msaa", "quarter-msaa", "conservative"}};
}

OptionSpec proxy_option() {
  return {.key = "proxy",
          .help = "lights are spheres and cones, or meshes cut to what their shadow maps let them light",
          .fallback = "full",
          .choices = {"full", "cut"}};
}

OptionSpec compact_option() {
  return {.key = "compact",
          .help = "one atomic for all fragments of a subgroup that set bits of one word",
          .fallback = "on",
          .choices = {"on", "off"}};
}

}  // namespace

Method drobot_raster_tile_method() {
  return {
      .name = "drobot-raster-tile",
      .title = "Drobot, rasterised tiles",
      .source =
          "Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017), rasterised culling",
      .summary = "Lights are drawn as meshes that enclose them; each fragment sets the light's bit in its tile.",
      .result = "tile_bits",
      .options = {{.key = "tile", .help = "tile size, pixels", .fallback = "8", .choices = {"8", "16", "32"}},
                  raster_option(),
                  {.key = "depth",
                   .help =
                       "faces against the surface's depth; and the light's depths against it; and front and back faces "
                       "both, in two passes with a stencil bit a tile",
                   .fallback = "bounds",
                   .choices = {"test", "bounds", "stencil"}},
                  compact_option(),
                  proxy_option(),
                  parts::occlusion_option(),
                  parts::boxes_option(),
                  parts::walk_option("scalar-entity")},
      .plan = plan_raster_tile,
      .check = check_raster_walk};
}

Method drobot_raster_cluster_method() {
  return {
      .name = "drobot-raster-cluster",
      .title = "Drobot, rasterised clusters",
      .source =
          "Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017), rasterised culling",
      .summary =
          "Back faces of light meshes mark clusters; front faces walk to the mark and set the light's bit on the way.",
      .result = "cluster_bits",
      .needs_depth = false,
      .any_depth = true,
      .options =
          {{.key = "tile", .help = "tile size, pixels", .fallback = "32", .choices = {"16", "32", "64"}},
           {.key = "slices", .help = "slices of depth", .fallback = "32", .min = 1, .max = 256},
           parts::slice_scale_option("scale", "log"),
           parts::slice_near_option(),
           parts::slice_far_option(),
           raster_option(),
           {.key = "early",
            .help = "walks end at the surfaces of a depth pre-pass; then only its depths are looked up right",
            .fallback = "off",
            .choices = {"on", "off"}},
           {.key = "mark",
            .help = "walks end at the farthest mark of the tile; or, as the source's, at the first one, and may miss "
                    "lights behind a gap",
            .fallback = "farthest",
            .choices = {"farthest", "first"}},
           compact_option(),
           proxy_option(),
           parts::occlusion_option(),
           parts::boxes_option(),
           parts::walk_option("scalar-entity")},
      .plan = plan_raster_cluster,
      .check = check_raster_walk};
}

}  // namespace lamp
