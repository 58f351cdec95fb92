// What a viewer gives away and takes besides pictures and states: flights, captures, bookmarks, lights as glTF.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "commands/pictures.h"
#include "commands/render_frames.h"
#include "scene/gltf_light_text.h"
#include "view/viewer.h"

namespace lamp::app {

std::size_t Viewer::waiting() const {
  return static_cast<std::size_t>(std::ranges::count(queued_, Job::Kind::picture, &Job::kind));
}

void Viewer::stop_saving() {
  std::erase_if(queued_, [](const Job& job) { return job.kind == Job::Kind::picture; });
}

void Viewer::save_flight(const std::string& file, const std::string& frames) {
  try {
    constexpr std::string_view KINDS[] = {".png", ".exr"};
    check_output("save flight", file, KINDS);
    const std::optional<FrameRange> range = parse_frames(frames).flight;
    if (!range || range->last >= shown_.flight_frames)
      throw Error(fmt::format("save flight: frames '{}': expected A..B, of the frames 0 to {}", frames,
                              std::max(1U, shown_.flight_frames) - 1));
    for (std::uint32_t frame = range->first; frame <= range->last; ++frame) {
      Job job{.kind = Job::Kind::picture, .state = state_, .size = asked_, .file = numbered(file, frame)};
      job.state.request.free_camera.reset();
      job.state.request.frame = static_cast<int>(frame);
      job.state.request.light_frame = -1;
      job.follows = frame != range->first;
      queued_.push_back(std::move(job));
    }
    idle_ = false;
  } catch (const Error& error) {
    complain(error.what());
  }
}

void Viewer::save_capture(const std::string& folder) {
  queued_.push_back({.kind = Job::Kind::capture, .state = state_, .size = asked_, .file = folder});
  idle_ = false;
}

void Viewer::copy_light() {
  const std::optional<Light> light = picked_light(shown_, state_);
  if (!light || !state_.light) return;
  const std::string name = fmt::format("light {}", *state_.light);
  try {
    set_clipboard(gltf_text({&*light, 1}, name));
    said_ = fmt::format("{} is in the clipboard, as glTF", name);
  } catch (const Error& error) {
    complain(error.what());
  }
}

void Viewer::paste_light() {
  if (!state_.light) return;
  try {
    const std::vector<Light> lights = lights_of_gltf(clipboard(), "clipboard");
    if (lights.size() != 1) throw Error(fmt::format("clipboard: has {} lights, expected one", lights.size()));
    edit_light(state_, *state_.light, lights.front());
    said_ = fmt::format("light {} is the clipboard's", *state_.light);
  } catch (const Error& error) {
    complain(error.what());
  }
}

void Viewer::save_bookmarks(const std::string& file) {
  save_json("save bookmarks", file, [&](const std::filesystem::path& path) { app::save_bookmarks(path, bookmarks_); });
}

void Viewer::add_bookmark() {
  const auto found = std::ranges::find(bookmarks_, bookmark_, &Bookmark::name);
  if (found != bookmarks_.end())
    found->state = saved_state();
  else
    bookmarks_.push_back({.name = bookmark_, .state = saved_state()});
}

void Viewer::take_bookmark_wishes(const Wishes& wishes) {
  if (wishes.add_bookmark) add_bookmark();
  if (wishes.remove_bookmark) std::erase_if(bookmarks_, [&](const Bookmark& one) { return one.name == bookmark_; });
  if (wishes.save_bookmarks) save_bookmarks(files_.bookmarks);
  if (wishes.open_bookmark) state_ = bookmarks_.at(*wishes.open_bookmark).state;
}

}  // namespace lamp::app
