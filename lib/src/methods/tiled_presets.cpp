// Presets of tiled culling: rows that name a source's exact configuration. Only the list's capacity is larger than the
// 256 of the sources, whose scenes had at most 4096 lights: a list that overflows costs more than all else.
// SPDX-License-Identifier: Apache-2.0
#include "methods.h"
#include "tiled_axes.h"

namespace lamp {
namespace {

using Fallbacks = std::initializer_list<std::pair<std::string_view, std::string_view>>;

/// A row; ordered, approximate and result follow from the options as in the plan.
struct Preset {
  std::string_view name, title, source, summary;
};

Method row(const Preset& preset, Fallbacks fallbacks) {
  const auto value = [&](std::string_view key, std::string_view otherwise) {
    for (const auto& [k, v] : fallbacks)
      if (k == key) return v;
    return otherwise;
  };
  const std::string_view order = value("order", "index");
  return {.name = preset.name,
          .title = preset.title,
          .source = preset.source,
          .summary = preset.summary,
          .result = value("container", "list") == "bits" ? "tile_bits"
                    : order == "type"                    ? "tile_typed"
                                                         : "tile_lists",
          .ordered = order == "index",
          .approximate = value("test", "planes") == "cone-approximate",
          .options = tiled_options(fallbacks),
          .plan = plan_tiled,
          .check = check_tiled};
}

}  // namespace

std::vector<Method> tiled_methods() {
  return {
      row({"tiled", "Tiled culling", "Stewart, Compute-Based Tiled Culling, GPU Pro 7 (2016), 1.3",
           "Each tile tests every light's sphere against its side planes and its depth bounds; lists ascend."},
          {}),
      row({"tiled-bits", "Tiled culling, flat bit arrays",
           "Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017)",
           "The tiled cull, but a tile keeps one bit a light instead of a list."},
          {{"container", "bits"}}),
      row({"drobot-tiled", "Drobot, tiles",
           "Drobot, Improved Culling for Tiled and Clustered Rendering, SIGGRAPH Advances (2017)",
           "Tiles of 8 pixels with depth bounds keep bits; a subgroup walks one light at a time."},
          {{"container", "bits"}, {"tile", "8"}, {"walk", "scalar-entity"}}),
      row({"stewart-baseline", "Stewart, baseline", "Stewart, Compute-Based Tiled Culling, GPU Pro 7 (2016), 1.3",
           "Depth bounds by atomics, six planes, appended lists of a buffer of spheres, 16 px."},
          {{"order", "append"}, {"capacity", "1024"}}),
      row({"stewart-unoptimized", "Stewart, both pitfalls",
           "Stewart, Compute-Based Tiled Culling, GPU Pro 7 (2016), 1.4.1",
           "The baseline with culling data inside the light records and 8 px tiles."},
          {{"order", "append"}, {"capacity", "1024"}, {"lights", "aos"}, {"tile", "8"}}),
      row({"stewart-half-z", "Stewart, Half Z", "Stewart, Compute-Based Tiled Culling, GPU Pro 7 (2016), 1.4.2",
           "Two lists a tile: for the near and the far half of its depth range."},
          {{"order", "append"}, {"capacity", "1024"}, {"bounds", "half"}}),
      row({"stewart-modified-half-z", "Stewart, Modified Half Z",
           "Stewart, Compute-Based Tiled Culling, GPU Pro 7 (2016), 1.4.2",
           "Half Z with each half tightened to its own pixels."},
          {{"order", "append"}, {"capacity", "1024"}, {"bounds", "modified-half"}}),
      row({"stewart-aabb", "Stewart, Modified Half Z and boxes",
           "Stewart, Compute-Based Tiled Culling, GPU Pro 7 (2016), 1.4.3",
           "Modified Half Z with a view-space box around each half instead of planes."},
          {{"order", "append"}, {"capacity", "1024"}, {"bounds", "modified-half"}, {"test", "aabb"}}),
      row({"stewart", "Stewart, all optimisations", "Stewart, Compute-Based Tiled Culling, GPU Pro 7 (2016), 1.4.4",
           "Modified Half Z, boxes, depth bounds by parallel reduction in a pass of their own."},
          {{"order", "append"},
           {"capacity", "1024"},
           {"bounds", "modified-half"},
           {"test", "aabb"},
           {"reduce", "parallel"}}),
      row({"article-deferred", "Tiled deferred of the compute article",
           "Adventures in Deferred Rendering: Tiled Deferred Shading and Compute Shaders",
           "Four planes straight from the projection matrix, no depth bounds, appended lists; 2560x1440, 4096 lights, "
           "Blinn-Phong there."},
          {{"order", "append"}, {"capacity", "1024"}, {"bounds", "none"}, {"frusta", "cached"}}),
      row({"primal-base", "Primal, base",
           "Primal engine, Light Culling with Approximate Sphere-Cone Intersection, base implementation",
           "Cached planes, light records, spots as cones against planes, appended lists, 32 px."},
          {{"order", "append"},
           {"capacity", "1024"},
           {"tile", "32"},
           {"frusta", "cached"},
           {"lights", "aos"},
           {"spot", "cone-planes"}}),
      row({"primal", "Primal", "Primal engine, Light Culling with Approximate Sphere-Cone Intersection",
           "Cached cones, approximate sphere-cone test, subgroup reduction, pruning by pixel, points before spots, 32 "
           "px."},
          {{"order", "type"},
           {"capacity", "1024"},
           {"tile", "32"},
           {"frusta", "cached"},
           {"test", "cone-approximate"},
           {"reduce", "subgroup"},
           {"prune", "pixel"}}),
      row({"harada-2.5d", "2.5D culling", "Harada, A 2.5D Culling for Forward+, SIGGRAPH Asia (2012)",
           "A 32-bit mask of each tile's occupied depths against the light's depth interval."},
          {{"bounds", "mask"}}),
      row({"tight", "Every test at once", "mask: Harada (2012); pruning: Primal engine; exact tests: this project",
           "Depth mask, exact sphere test, cone against each occupied part, pruning by pixel."},
          {{"bounds", "mask"}, {"test", "exact"}, {"spot", "cone-segments"}, {"prune", "pixel"}}),
  };
}

}  // namespace lamp
