// What a viewer gives away and takes: pictures, states, scenes, flights, captures, bookmarks, lights as glTF.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "commands/pictures.h"
#include "commands/render_frames.h"
#include "files/read_json.h"
#include "scene/gltf_light_text.h"
#include "view/viewer.h"

namespace lamp::app {
namespace {

bool is_state(const std::string& file) { return std::filesystem::path(file).extension() == ".json"; }
bool is_frame(const std::string& file) { return std::filesystem::path(file).filename() == "frame.json"; }

}  // namespace

bool is_captured(const std::string& scene) { return is_frame(scene) || std::filesystem::is_directory(scene); }

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

void Viewer::save_picture(const std::string& file) {
  queued_.push_back({.kind = Job::Kind::picture, .state = state_, .size = asked_, .file = file});
  idle_ = false;
}

void Viewer::save_json(const char* what, const std::string& file,
                       const std::function<void(const std::filesystem::path&)>& write) {
  try {
    constexpr std::string_view KINDS[] = {".json"};
    check_output(what, file, KINDS);
    write_output(file, write);
    say_saved(file);
  } catch (const Error& error) {
    complain(error.what());
  }
}

ViewState Viewer::saved_state() const {
  ViewState saved = state_;
  if (shown_.number == 0 || shown_.captured) return saved;
  const glm::uvec2 shown(shown_.view.width(), shown_.view.height());
  saved.drawn = shown == asked_ ? std::nullopt : std::optional(shown);
  return saved;
}

void Viewer::save_state(const std::string& file) {
  save_json("save state", file, [&](const std::filesystem::path& path) { app::save_state(path, saved_state()); });
}

void Viewer::save_numbers(const std::string& file) {
  save_json("save numbers", file, [&](const std::filesystem::path& path) {
    if (shown_.number == 0) throw Error("save numbers: nothing is shown yet, expected a picture");
    write_text(path, json_text(app::to_json(shown_.first.stats), 2) + "\n");
  });
}

void Viewer::open_state(ViewState state) {
  state_ = std::move(state);
  opened_place_.clear();
}

void Viewer::open(const std::string& file) {
  try {
    if (is_state(file) && !is_frame(file)) {
      if (holds_bookmarks(file)) {
        bookmarks_ = load_bookmarks(file);
        files_.bookmarks = file;
        said_ = fmt::format("opened {} bookmarks", bookmarks_.size());
      } else {
        open_state(load_state(file));
      }
      return;
    }
    ViewState opened = state_;
    opened.request.scene = file;
    opened.request.camera.clear();
    opened.request.free_camera.reset();
    opened.request.frame = -1;
    if (is_captured(file)) {  // has its own, and its decals in its surfaces
      const Request plain;
      opened.request.lights_given = false;
      opened.request.spots = plain.spots;  // of lights that are not generated then
      opened.request.range = plain.range;
      opened.request.still = plain.still;
      opened.request.decals = 0;
    }
    opened.edits.clear();
    opened.picked.reset();
    opened.light.reset();
    state_ = std::move(opened);
  } catch (const Error& error) {
    complain(error.what());
  }
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
  if (wishes.open_bookmark) open_state(bookmarks_.at(*wishes.open_bookmark).state);
}

}  // namespace lamp::app
