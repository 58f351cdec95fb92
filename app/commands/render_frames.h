// `lamp render --frames`: how many frames are timed, or which frames of the flight become pictures.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "commands/view_state.h"

namespace lamp::app {

/// Frames of a flight, both ends among them.
struct FrameRange {
  std::uint32_t first = 0;
  std::uint32_t last = 0;
};

struct FramesOption {
  std::uint32_t timed = 0;           ///< 0: as many as the device is worth
  std::optional<FrameRange> flight;  ///< pictures of these
};
/// "20" or "0..299". Throws Error for anything else but an empty text.
[[nodiscard]] FramesOption parse_frames(const std::string& text);

/// "flight.png" to "flight-0040.png"; an empty name stays empty.
[[nodiscard]] std::string numbered(const std::string& file, std::uint32_t frame);

/// Goes through frames of one scene: moves view and lights of a setup that was made for the first.
class FlightFrames {
 public:
  /// Both must outlive it.
  FlightFrames(const ViewState& state, Setup& setup);
  void go_to(std::uint32_t frame);

 private:
  ViewState state_;
  Setup& setup_;
  std::optional<OpenAir> air_;
};

}  // namespace lamp::app
