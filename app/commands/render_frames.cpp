// Parses `--frames`, names pictures, moves cameras and lights.
// SPDX-License-Identifier: Apache-2.0
#include "commands/render_frames.h"
#include "files/utf8_path.h"

#include <fmt/format.h>

#include <charconv>
#include <filesystem>
#include <limits>

namespace lamp::app {
namespace {

constexpr std::uint32_t MOST_TIMED = 100'000;

std::optional<std::uint32_t> whole(std::string_view text) {
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size()) return std::nullopt;
  return number;
}

}  // namespace

FramesOption parse_frames(const std::string& text) {
  if (text.empty()) return {};
  const std::string_view words = text;
  if (const std::size_t dots = words.find(".."); dots != std::string_view::npos) {
    const std::optional<std::uint32_t> first = whole(words.substr(0, dots));
    const std::optional<std::uint32_t> last = whole(words.substr(dots + 2));
    if (first && last && *first <= *last && *last <= std::numeric_limits<int>::max())
      return {.flight = FrameRange{*first, *last}};
  } else if (const std::optional<std::uint32_t> timed = whole(words); timed && *timed >= 1 && *timed <= MOST_TIMED) {
    return {.timed = *timed};
  }
  throw Error(
      fmt::format("--frames: expected a whole number from 1 to {}, or A..B, frames of the flight with A <= B, got '{}'",
                  MOST_TIMED, text));
}

std::string numbered(const std::string& file, std::uint32_t frame) {
  if (file.empty()) return file;
  const std::filesystem::path path = utf8_path(file);
  return (path.parent_path() /
          utf8_path(fmt::format("{}-{:04}{}", path.stem().string(), frame, path.extension().string())))
      .string();
}

FlightFrames::FlightFrames(const ViewState& state, Setup& setup) : state_(state), setup_(setup) {}

void FlightFrames::go_to(std::uint32_t frame) {
  if (!setup_.at_rest.empty()) setup_.scene.instances = setup_.at_rest;
  if (!air_) air_ = find_open_air(setup_.scene);
  state_.request.frame = static_cast<int>(frame);
  state_.request.light_frame = -1;
  setup_.views = requested_views(state_.request, setup_.scene);
  setup_.view = setup_.views.front();
  setup_.generated = requested_lights(state_.request, setup_.scene, *air_);
  setup_.lights = packed_lights(state_.request, setup_.scene, setup_.generated);
  apply_edits(state_, setup_.lights);
  move_instances(state_.request, setup_);
}

}  // namespace lamp::app
