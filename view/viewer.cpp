// Input to state, state to jobs.
// SPDX-License-Identifier: Apache-2.0
#include "view/viewer.h"

#include <fmt/format.h>

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

/// What a drawing depends on: a state without what lies beside or over the picture.
std::string drawing_key(ViewState state) {
  state.panels = false;
  state.help = false;
  state.samples = 1;
  if (state.request.probes == 0) state.paused = false;  // where time stands still, all captures are renewed
  state.speed = 0.0F;
  state.resolution = 0.0F;
  state.light_marks = LightMarks::none;
  state.decal_boxes = false;
  state.probe_boxes = false;
  return to_json(state).dump();
}

/// What undo goes back over: a state without what moves by itself.
std::string change_key(ViewState state) {
  state.request.light_frame = -1;
  if (state.request.frame >= 0) state.request.frame = 0;
  state.help = false;
  return to_json(state).dump();
}

nlohmann::json report_of(const DepthBins& bins, const std::optional<Inspection>& picked) {
  std::uint32_t longest = 0;
  for (const BinRanks& ranks : bins.bins) longest = std::max(longest, ranks.length());
  nlohmann::json json{{"count", bins.bins.size()}, {"longest", longest}, {"lights", bins.lights}};
  const auto bin = picked ? bins.bin_at(picked->pixel) : std::nullopt;
  if (bin) json["picked"] = {{"bin", *bin}, {"length", bins.bins[*bin].length()}};
  return json;
}

nlohmann::json report_of(const ShownWorld& world) {
  nlohmann::json json{{"refused", world.refused},
                      {"method", world.method},
                      {"cells", world.cells.size()},
                      {"longest", world.longest},
                      {"points", nlohmann::json::array()}};
  for (const PointList& point : world.points)
    json["points"].push_back(
        {{"what", point.what}, {"walked", point.walked}, {"reaching", point.reaching}, {"missed", point.missed}});
  return json;
}

glm::uvec2 part_of(glm::uvec2 size, double part) {
  return glm::max(glm::uvec2(1), glm::uvec2(glm::dvec2(size) * part + 0.5));
}

bool is_state(const std::string& file) { return std::filesystem::path(file).extension() == ".json"; }
bool is_capture(const std::string& file) { return std::filesystem::path(file).filename() == "frame.json"; }

}  // namespace

Viewer::Viewer(ViewerInfo info)
    : state_(std::move(info.state)),
      settled_(state_),
      traits_(info.traits),
      pace_(info.target_ms),
      paced_(info.target_ms > 0.0),
      scale_(info.scale),
      bookmarks_(std::move(info.bookmarks)) {}

glm::uvec2 Viewer::paced_size() const {
  if (state_.resolution > 0.0F) return part_of(asked_, state_.resolution);
  return paced_ ? part_of(asked_, pace_.scale()) : asked_;
}

std::optional<Job> Viewer::next_job() {
  if (busy_ || lost_) return std::nullopt;
  if (!queued_.empty()) {
    Job job = std::move(queued_.front());
    queued_.erase(queued_.begin());
    busy_ = true;
    return job;
  }
  // What rests is drawn once more, as large as a second allows.
  std::string content = drawing_key(state_);
  if (content != drawn_content_) rests_s_ = 0.0;
  const glm::uvec2 size = rests_s_ > REST_S ? part_of(asked_, pace_.rest_scale()) : paced_size();
  std::string key = fmt::format("{}x{} {}", size.x, size.y, content);
  idle_ = key == drawn_key_;
  if (idle_) return std::nullopt;
  drawn_content_ = std::move(content);
  drawn_key_ = std::move(key);
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
    keep_scene(done.job.state);
    return;
  }
  if (done.job.kind == Job::Kind::draw && !error_stays_) error_.clear();
  if (done.job.kind == Job::Kind::picture || done.job.kind == Job::Kind::capture) say_saved(done.job.file);
  if (done.proof) {
    proof_ = done.proof;
    said_.clear();
    const Request& of = done.job.state.request;
    proof_of_ = fmt::format("{}x{}, frame {}", done.job.size.x, done.job.size.y, std::max(of.frame, of.light_frame));
  }
  if (done.others) others_ = std::move(*done.others);
  if (!done.shown) return;
  const bool rested = done.job.size != glm::uvec2(paced_size());
  if (!done.shown->made_anew && !rested) {
    if (paced_) pace_.took(done.ms);
    picture_ms_ = picture_ms_ == 0.0 ? done.ms : 0.9 * picture_ms_ + 0.1 * done.ms;
  }
  shown_ = std::move(*done.shown);
  times_.add(shown_.first.stats.rendered);
}

void Viewer::complain(const std::string& error) {
  error_ = error;
  error_stays_ = true;
  ++errors_;
}

void Viewer::say_saved(const std::string& file) {
  said_ = "saved " + file;
  error_.clear();
  error_stays_ = false;
}

void Viewer::keep_scene(const ViewState& failed) {
  Request& r = state_.request;
  if (shown_.number == 0 || failed.request.scene == shown_.state.request.scene || r.scene != failed.request.scene)
    return;
  const Request& was = shown_.state.request;
  r.scene = was.scene;
  r.camera = was.camera;
  r.free_camera = was.free_camera;
  r.frame = was.frame;
  settled_ = state_;
}

void Viewer::frame(const Input& input, glm::uvec2 screen, float seconds, float progress) {
  lay_out(screen);
  places_.next_frame();
  const ViewState before = state_;
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
  note_change();
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

void Viewer::note_change() {
  if (interface_is_used() || dragging_ || change_key(state_) == change_key(settled_)) return;
  error_stays_ = false;
  undone_.push_back(settled_);
  if (undone_.size() > MOST_UNDONE) undone_.erase(undone_.begin());
  redone_.clear();
  settled_ = state_;
  forget_findings();
}

void Viewer::undo(std::vector<ViewState>& from, std::vector<ViewState>& to) {
  if (from.empty()) return;
  to.push_back(state_);
  state_ = std::move(from.back());
  from.pop_back();
  settled_ = state_;
  forget_findings();
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
  if (wishes.undo) undo(undone_, redone_);
  if (wishes.redo) undo(redone_, undone_);
  if (wishes.step) apply_keys({.pressed = {"period"}}, state_, shown_, wishes_, false);
  if (wishes.save_numbers) save_numbers(files_.numbers);
  if (wishes.prove && !proving_ && shown_.number != 0) {
    proving_ = true;
    proof_.reset();
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

void Viewer::forget_findings() {
  proof_.reset();
  others_.clear();
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
  saved.request.size = shown_.state.request.size;
  saved.request.size_given = true;
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

void Viewer::open(const std::string& file) {
  try {
    if (is_state(file) && !is_capture(file)) {
      if (holds_bookmarks(file)) {
        bookmarks_ = load_bookmarks(file);
        files_.bookmarks = file;
        said_ = fmt::format("opened {} bookmarks", bookmarks_.size());
      } else {
        state_ = load_state(file);
      }
      return;
    }
    ViewState opened = state_;
    opened.request.scene = file;
    opened.request.camera.clear();
    opened.request.free_camera.reset();
    opened.request.frame = -1;
    if (is_capture(file) || std::filesystem::is_directory(file)) {  // has its own, and its decals in its surfaces
      opened.request.lights_given = false;
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

nlohmann::json Viewer::report() const {
  nlohmann::json json = to_json(state_);
  json["error"] = error_;
  json["said"] = said_;
  json["pictures"] = shown_.number;
  json["picture_ms"] = picture_ms_;
  if (!times_.interface_row().ms.empty()) json["interface_ms"] = times_.interface_row().at(0.5);
  json["bookmarks"] = bookmarks_.size();
  if (shown_.number != 0) json["shown"] = to_json(shown_.first.stats);
  if (shown_.second) json["shown_b"] = to_json(shown_.second->stats);
  if (proof_) json["proof"] = words_of(*proof_);
  if (shown_.picture_difference) json["picture_difference"] = *shown_.picture_difference;
  if (shown_.first.legend.overlay == Overlay::difference) json["differing_pixels"] = shown_.first.legend.cells;
  if (shown_.first.legend.overlay == Overlay::shadow_atlas) json["atlas_side_shown"] = shown_.first.legend.max;
  if (!shown_.first.lengths.empty()) json["longest_lists"] = shown_.first.lengths.back().high;
  json["decals_shown"] = shown_.decals.size();
  if (shown_.first.legend.overlay == Overlay::missed) json["missing_pixels"] = shown_.first.legend.cells;
  for (const OtherList& list : others_)
    json["others"][list.method] = {{"lights", list.lights}, {"reaching", list.reaching}, {"refused", list.refused}};
  if (shown_.first.legend.overlay != Overlay::none)
    json["legend"] = {{"mean", shown_.first.legend.mean},
                      {"max", shown_.first.legend.max},
                      {"cells", shown_.first.legend.cells},
                      {"numbers", numbers_},
                      {"refused", shown_.first.legend.refused}};
  if (shown_.proxies)
    json["proxies_shown"] = {{"drawn", shown_.proxies->drawn},
                             {"cut", shown_.proxies->cut},
                             {"inside", shown_.proxies->inside},
                             {"shapes", shown_.proxies->shapes.size()},
                             {"refused", shown_.proxies->refused}};
  if (shown_.shadow)
    json["shadow_of_light"] = {{"squares", shown_.shadow->squares.size()},
                               {"side", shown_.shadow->map.side},
                               {"age", shown_.shadow->age},
                               {"corners", shown_.shadow->shape.corners.size()}};
  json["probes_shown"] = shown_.probe_volumes.size();
  if (shown_.world) json["world"] = report_of(*shown_.world);
  if (shown_.bins) json["bins"] = report_of(*shown_.bins, shown_.inspection);
  if (!shown_.inspection) return json;
  const Inspection& found = *shown_.inspection;
  // A test that drops a light which reaches the cell would lose it.
  const auto lost = std::ranges::count_if(found.lights, [](const ListedLight& light) {
    return (light.reaches_cell || light.reach == Reach::inside) && light.passes != gpu::PASSES_ALL;
  });
  nlohmann::json own = nlohmann::json::array();
  for (std::size_t i = 0; i < test_names().size(); ++i)
    if ((found.own.passes >> i & 1U) != 0) own.push_back(test_names()[i]);
  const auto larger = std::ranges::count_if(found.lights, [&](const ListedLight& light) {
    return why_listed(light, found.tests_of(light)).starts_with("larger cell");
  });
  json["inspection"] = {{"pixel", {found.pixel.x, found.pixel.y}},
                        {"sky", found.sky},
                        {"cell", found.cell},
                        {"lights", found.lights.size()},
                        {"lost_by_tests", lost},
                        {"own_tests", own},
                        {"of_larger_cells", larger},
                        {"still_lights", std::ranges::count(found.lights, true, &ListedLight::still)},
                        {"missed", found.proof.missed},
                        {"pairs", found.proof.pairs}};
  for (const ListedProbe& probe : found.probes)
    json["inspection"]["probes"].push_back({{"slot", probe.slot}, {"weight", probe.weight}, {"share", probe.share}});
  return json;
}

}  // namespace lamp::app
