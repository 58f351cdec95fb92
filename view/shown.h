// What is on the screen, and what is known of it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands/stats.h"
#include "commands/view_state.h"
#include "gpu/image.h"
#include "lamplight/view.h"
#include "view/cell_numbers.h"
#include "view/frame_lights.h"
#include "view/inspection.h"
#include "view/overlay.h"
#include "view/shapes.h"
#include "view/world_lists.h"

namespace lamp::app {

/// What one method did.
struct ShownSide {
  Stats stats;  ///< as `lamp render --json` has them
  bool by_auto = false;
  Legend legend;
  std::vector<ListLengths> lengths;  ///< where lists were walked
  bool keeps_masks = false;          ///< of the occupied parts of each cell's depths
  CellPlaces cells;                  ///< with Overlay::cells
  bool any_depth = false;            ///< its lists are right at any depth
  bool rasterises = false;           ///< meshes in place of lights
  bool full = false;                 ///< lists overflow although room was made for them
};

/// The least and the greatest rank of the lights that reach into a bin, in the order of their depth.
struct BinRanks {
  std::uint32_t least = 1;
  std::uint32_t greatest = 0;  ///< below the least: no light

  [[nodiscard]] std::uint32_t length() const { return least > greatest ? 0 : greatest - least + 1; }
  friend bool operator==(const BinRanks&, const BinRanks&) = default;
};

/// Bins of depth of the first method, if it has such.
struct DepthBins {
  std::vector<BinRanks> bins;            ///< near to far
  std::uint32_t lights = 0;              ///< of the frame, decals and probes included
  std::uint32_t width = 0;               ///< of the picture
  std::vector<std::uint32_t> of_pixels;  ///< the bin of each; of sky beyond all bins

  [[nodiscard]] std::optional<std::uint32_t> bin_at(glm::uvec2 pixel) const;
};

struct Shown {
  std::uint64_t number = 0;  ///< of the frame, from 1; 0: there is none yet
  bool made_anew = false;    ///< a scene was loaded or a pipeline compiled for it: its time says nothing of others
  ViewState state;           ///< that it shows; the size is the one that was rendered
  std::shared_ptr<const GpuImage> image;
  float exposure = 1.0F;
  View view;
  std::shared_ptr<const FrameLights> lights;
  std::vector<shared::OrientedBox> decals;
  std::uint32_t flight_frames = 0;  ///< 0: the scene has no flight
  bool captured = false;
  std::vector<std::string> cameras;  ///< of the scene
  Camera scene_camera;               ///< where the view is, unless the scene is captured
  std::vector<std::string> notes;    ///< of the scene's loader
  ShownSide first;
  std::optional<ShownSide> second;          ///< right of the divider
  std::optional<float> picture_difference;  ///< of the two's pictures, the largest; with Overlay::difference
  std::optional<Inspection> inspection;
  std::optional<DepthBins> bins;
  std::optional<ShownProxies> proxies;
  std::optional<ShownShadow> shadow;
  std::optional<ShownWorld> world;
  std::vector<shared::OrientedBox> probe_volumes;  ///< in the frame's order

  /// The side on which the pixel is that was picked.
  [[nodiscard]] const ShownSide& inspected_side() const { return inspection && inspection->second ? *second : first; }
};

}  // namespace lamp::app
