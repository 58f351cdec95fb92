// Input to state, state to jobs.
// SPDX-License-Identifier: Apache-2.0
#include "view/viewer.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "commands/pictures.h"
#include "files/read_json.h"

namespace lamp::app {
namespace {

constexpr double FRAMES_A_SECOND = 30.0;  // of a flight
constexpr double REST_S = 0.5;            // without a change, before what is shown is drawn larger
constexpr std::size_t MOST_UNDONE = 100;

/// Without what is the window's, not the user's.
void forget_window(ViewState& state) {
  state.drawn.reset();
  if (!state.request.size_given) state.request.size.clear();
}

/// What a drawing depends on, beside its size: a state without what lies beside or over the picture.
std::string drawing_key(ViewState state) {
  forget_window(state);
  state.panels = false;
  state.help = false;
  state.samples = 1;
  if (state.request.probes == 0) state.paused = false;  // where time stands still, all captures are renewed
  state.speed = 0.0F;
  state.resolution = 0.0F;
  state.light_marks = LightMarks::none;
  state.decal_boxes = false;
  state.probe_boxes = false;
  state.other.clear();
  return to_json(state).dump();
}

std::string members(const ViewState& state, std::initializer_list<const char*> keys) {
  const nlohmann::json all = to_json(state);
  nlohmann::json some;
  for (const char* key : keys)
    if (all.contains(key)) some[key] = all[key];
  return some.dump();
}

/// From where the eye sees what: while it is the same, a pixel shows the same place.
std::string place_of(const ViewState& state) {
  return state.request.size +
         members(state, {"scene", "camera", "free_camera", "frame", "projection", "resolution", "moving"});
}

/// What methods' lists depend on besides that.
std::string lights_of(const ViewState& state) {
  return members(state, {"lights", "spots", "range", "decals", "seed", "still", "still_lists", "still_occlusion",
                         "still_bytes", "probes", "light_frame", "edits", "depth", "depth_samples", "options"}) +
         fmt::format("{}", fmt::join(state.against.value_or(Against()).options, " "));
}

int light_frame_of(const ViewState& state) { return std::max(0, state.request.light_frame); }

/// Without what moves by itself.
void forget_time(ViewState& state) {
  state.request.light_frame = -1;
  if (state.request.frame >= 0) state.request.frame = 0;
}

/// What undo goes back over.
std::string change_key(ViewState state) {
  forget_window(state);
  forget_time(state);
  state.help = false;
  return to_json(state).dump();
}

/// Which picture is asked for, whenever.
std::string picture_key(ViewState state) {
  forget_time(state);
  return drawing_key(std::move(state));
}

/// A key that flies or repeats; others do nothing while they are held.
bool holds_a_key(const Input& input) {
  return std::ranges::any_of(input.held,
                             [](const std::string& key) { return key != "shift" && key != "ctrl" && key != "alt"; });
}

glm::uvec2 part_of(glm::uvec2 size, double part) {
  return glm::max(glm::uvec2(1), glm::uvec2(glm::dvec2(size) * part + 0.5));
}

}  // namespace

Viewer::Viewer(ViewerInfo info)
    : state_(std::move(info.state)),
      settled_(state_),
      traits_(info.traits),
      depth_samples_(std::move(info.depth_samples)),
      pace_(info.target_ms, info.rest_ms),
      paced_(info.target_ms > 0.0),
      scale_(info.scale),
      bookmarks_(std::move(info.bookmarks)) {}

glm::uvec2 Viewer::paced_size() const {
  if (state_.resolution > 0.0F) return part_of(asked_, state_.resolution);
  return paced_ ? part_of(asked_, pace_.scale()) : asked_;
}

bool Viewer::holds_size() const {
  const bool stands = state_.paused || state_.speed == 0.0F;
  return state_.picked && stands && shown_.number != 0 && !shown_.captured && place_of(state_) == drawn_place_;
}

glm::uvec2 Viewer::next_size() const {
  if (state_.drawn) return *state_.drawn;
  if (holds_size()) return {shown_.view.width(), shown_.view.height()};
  // What rests is drawn once more, as large as its time allows, unless somebody has said how large.
  const bool rests = rests_s_ > REST_S && state_.resolution == 0.0F;
  return rests ? part_of(asked_, pace_.rest_scale()) : paced_size();
}

std::optional<Job> Viewer::next_job() {
  if (busy_ || lost_) return std::nullopt;
  if (!queued_.empty()) {
    Job job = std::move(queued_.front());
    queued_.erase(queued_.begin());
    busy_ = true;
    return job;
  }
  std::string content = drawing_key(state_);
  if (content != drawn_content_) rests_s_ = 0.0;
  const glm::uvec2 size = next_size();
  std::string key = fmt::format("{}x{} {}", size.x, size.y, content);
  idle_ = key == drawn_key_;
  if (idle_) return std::nullopt;
  drawn_content_ = std::move(content);
  drawn_key_ = std::move(key);
  drawn_place_ = place_of(state_);
  busy_ = true;
  return Job{.kind = Job::Kind::draw, .state = state_, .size = size, .file = {}};
}

void Viewer::finish(Done done) {
  busy_ = false;
  if (done.job.kind == Job::Kind::prove) proving_ = false;
  if (done.job.kind == Job::Kind::ask) asking_ = false;
  lost_ = done.lost;
  if (!done.error.empty()) {
    if (done.job.kind == Job::Kind::picture) stop_saving();
    complain(done.error);
    if (done.job.kind == Job::Kind::draw) take_back(done.job.state);
    return;
  }
  if (done.job.kind == Job::Kind::draw) drawable_ = done.job.state;
  if (done.job.kind == Job::Kind::draw && !error_stays_) error_.clear();
  if (done.job.kind == Job::Kind::picture || done.job.kind == Job::Kind::capture) say_saved(done.job.file);
  if (!done.proof.empty()) {
    proof_ = done.proof;
    said_.clear();
    const Request& of = done.job.state.request;
    proof_of_ = fmt::format("{}x{}, frame {}", done.job.size.x, done.job.size.y, std::max(of.frame, of.light_frame));
  }
  if (done.others) {
    others_ = std::move(*done.others);
    const ViewState& state = done.job.state;
    asked_for_ = {.place = place_of(state),
                  .lights = lights_of(state),
                  .picked = state.picked,
                  .light_frame = light_frame_of(state),
                  .size = done.job.size};
  }
  if (done.shown) take_picture(done);
  if (!done.shown && !done.others) return;
  outdated_ = others_.empty() ? "" : why_outdated();
  if (shown_.inspection)
    for (OtherList& other : others_) compare(other, shown_.inspection->lights);
}

void Viewer::take_picture(Done& done) {
  const bool rested = done.job.size != glm::uvec2(paced_size());
  if (!done.shown->made_anew && !rested) {
    if (paced_) pace_.took(done.ms);
    picture_ms_ = picture_ms_ == 0.0 ? done.ms : 0.9 * picture_ms_ + 0.1 * done.ms;
  }
  shown_ = std::move(*done.shown);
  times_.add(shown_.first.stats.rendered);
}

void Viewer::complain(const std::string& error) {
  error_ = named_by_widgets(error);
  error_stays_ = true;
  ++errors_;
}

void Viewer::say_saved(const std::string& file) {
  said_ = "saved " + file;
  error_.clear();
  error_stays_ = false;
}

void Viewer::take_back(const ViewState& failed) {
  if (shown_.number == 0 || picture_key(state_) != picture_key(failed)) return;
  const ViewState was = std::exchange(state_, drawable_);
  opened_place_.clear();
  state_.panels = was.panels;
  state_.help = was.help;
  if (!undone_.empty() && picture_key(undone_.back()) == picture_key(state_)) undone_.pop_back();
  settled_ = state_;
}

void Viewer::frame(const Input& input, glm::uvec2 screen, float seconds, float progress) {
  lay_out(screen);
  places_.next_frame();
  const ViewState before = state_;
  if (input.holds("ctrl")) chords_.insert(input.pressed.begin(), input.pressed.end());
  std::erase_if(chords_, [&](const std::string& key) { return !input.holds(key); });
  for (const std::string& file : input.dropped) open(file);
  draw_panels(screen, progress);
  const bool focus = interface_has_focus();
  if (!interface_takes_text()) {
    apply_keys(input, state_, shown_, wishes_, focus);
    use_mouse(input, seconds, focus);
  }
  take_wishes();
  pass_time(seconds);
  if (paced_ && state_.resolution == 0.0F && !busy_) rests_s_ += seconds;
  try_state(before);
  keep_drawn_size();
  note_change(input);
  if (!others_.empty() && (state_.picked != asked_for_.picked || place_of(state_) != asked_for_.place)) {
    others_.clear();
    outdated_.clear();
  }
  draw_status(screen);
}

/// What cannot be said of any scene is taken back at once; what the scene or the device refuses is found by drawing.
void Viewer::try_state(const ViewState& before) {
  try {
    check_state(state_);
  } catch (const Error& error) {
    complain(error.what());
    state_ = before;
  }
}

void Viewer::note_change(const Input& input) {
  const bool typed = interface_takes_text();
  if (interface_is_used() || dragging_ || (!typed && holds_a_key(input))) return;
  keep_change();
}

void Viewer::keep_change() {
  if (change_key(state_) == change_key(settled_)) return;
  error_.clear();
  error_stays_ = false;
  undone_.push_back(settled_);
  if (undone_.size() > MOST_UNDONE) undone_.erase(undone_.begin());
  redone_.clear();
  settled_ = state_;
  proof_.clear();
}

void Viewer::undo(std::vector<ViewState>& from, std::vector<ViewState>& to) {
  if (from.empty()) return;
  to.push_back(state_);
  open_state(std::move(from.back()));
  from.pop_back();
  settled_ = state_;
  proof_.clear();
}

void Viewer::pass_time(float seconds) {
  Request& r = state_.request;
  if (r.frame < 0 && r.light_frame < 0) r.light_frame = 0;
  if (state_.paused || shown_.number == 0) return;
  clock_ += seconds * FRAMES_A_SECOND * state_.speed;
  const double whole = std::floor(clock_);
  clock_ -= whole;
  const int frames = shown_.flight_frames != 0 ? static_cast<int>(shown_.flight_frames) : 300;
  int& frame = r.frame >= 0 ? r.frame : r.light_frame;
  frame = ((frame + static_cast<int>(whole)) % frames + frames) % frames;
}

void Viewer::take_wishes() {
  const Wishes wishes = std::exchange(wishes_, {});
  if (wishes.save_picture) save_picture(files_.picture);
  if (wishes.save_state) save_state(files_.state);
  if (wishes.save_flight) save_flight(files_.picture, files_.frames);
  if (wishes.stop_saving) stop_saving();
  if (wishes.save_capture) save_capture(files_.capture);
  take_bookmark_wishes(wishes);
  if (wishes.undo || wishes.redo) keep_change();
  if (wishes.undo) undo(undone_, redone_);
  if (wishes.redo) undo(redone_, undone_);
  if (!wishes.refused.empty()) complain(wishes.refused);
  if (!wishes.say.empty()) said_ = wishes.say;
  if (wishes.step) apply_keys({.pressed = {"period"}}, state_, shown_, wishes_, false);
  if (wishes.save_numbers) save_numbers(files_.numbers);
  if (wishes.copy_light) copy_light();
  if (wishes.paste_light) paste_light();
  if (wishes.prove && !proving_ && shown_.number != 0) {
    proving_ = true;
    proof_.clear();
    queue(Job::Kind::prove);
  }
  if (wishes.ask && !asking_ && shown_.inspection) {
    asking_ = true;
    queue(Job::Kind::ask);
  }
}

void Viewer::queue(Job::Kind kind) {
  const glm::uvec2 size(shown_.view.width(), shown_.view.height());
  queued_.push_back({.kind = kind, .state = state_, .size = size, .file = {}});
}

std::string Viewer::why_outdated() const {
  const int then = asked_for_.light_frame;
  const int now = light_frame_of(shown_.state);
  if (then != now) return fmt::format("Outdated: of frame {}, the picture is of frame {}. Ask again.", then, now);
  const bool same = asked_for_.lights == lights_of(shown_.state) &&
                    asked_for_.size == glm::uvec2(shown_.view.width(), shown_.view.height());
  return same ? "" : "Outdated: lights, options or the picture's size changed since. Ask again.";
}

void Viewer::keep_drawn_size() {
  if (!state_.drawn) return;
  if (opened_place_.empty()) opened_place_ = place_of(state_);
  if (opened_place_ != place_of(state_)) state_.drawn.reset();
}

}  // namespace lamp::app
