// The viewer between a user and a stage: takes input, lays out the screen, says what is to be drawn next.
// Promise: never waits; whoever owns it performs its jobs, at once or in a thread.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "view/job.h"
#include "view/keys.h"
#include "view/pace.h"
#include "view/panels.h"

namespace lamp::app {

struct ViewerInfo {
  ViewState state;
  DeviceTraits traits;
  std::vector<std::uint32_t> depth_samples;  ///< of a pixel, that the device's depth images may have
  double target_ms = 0.0;                    ///< how long a picture may take; 0: resolution is never lowered by itself
  double rest_ms = Pace::MOST_REST_MS;       ///< the same of a picture that is drawn once and stays
  float scale = 1.0F;                        ///< of letters and panels
  std::vector<Bookmark> bookmarks;
};

class Viewer {
 public:
  explicit Viewer(ViewerInfo info);

  /// The interface of a frame, between Gui::begin and Gui::end; `progress` of the proof that is being made.
  void frame(const Input& input, glm::uvec2 screen, float seconds, float progress);

  /// What is to be done next, if there is anything. Its Done comes back to `finish`, before the next is asked for.
  [[nodiscard]] std::optional<Job> next_job();
  void finish(Done done);
  /// How long the device took to draw an interface.
  void took_interface(std::optional<double> ms) {
    if (ms) times_.add_interface(*ms);
  }
  /// Everything that was asked for is done, and what is shown is the state.
  [[nodiscard]] bool idle() const { return idle_ && queued_.empty() && !busy_; }
  /// Something is being drawn, which may know nothing yet of what was set since it was asked for.
  [[nodiscard]] bool busy() const { return busy_; }
  /// No picture in a file and no proof waits to be made.
  [[nodiscard]] bool asks_for_nothing() const { return queued_.empty() && !proving_ && !asking_; }

  [[nodiscard]] ViewState& state() { return state_; }
  [[nodiscard]] const Shown& shown() const { return shown_; }
  /// Where on the screen the picture is.
  [[nodiscard]] const ScreenRect& picture() const { return picture_; }
  [[nodiscard]] Places& places() { return places_; }
  [[nodiscard]] const std::string& error() const { return error_; }
  /// How often there was one.
  [[nodiscard]] std::uint64_t errors() const { return errors_; }
  [[nodiscard]] bool device_lost() const { return lost_; }
  /// What is set and what is seen, for scripts to expect.
  [[nodiscard]] nlohmann::json report() const;

  /// Asks for a picture in a file.
  void save_picture(const std::string& file);
  /// Writes the state in the size that is shown. What cannot be written is an error on the screen.
  void save_state(const std::string& file);
  /// Writes what `lamp render --json` prints of the picture that is shown.
  void save_numbers(const std::string& file);
  /// Asks for numbered pictures of frames of the flight, "A..B".
  void save_flight(const std::string& file, const std::string& frames);
  /// Asks for a capture in a folder.
  void save_capture(const std::string& folder);
  /// Writes the bookmarks.
  void save_bookmarks(const std::string& file);
  /// Opens a scene, a capture, a state or bookmarks; what else it is is an error on the screen.
  void open(const std::string& file);
  /// Says something on the screen.
  void say(const std::string& words) { said_ = words; }

 private:
  [[nodiscard]] glm::uvec2 paced_size() const;
  /// While a pixel is looked into and time stands, its cell and its list do so too, and so the picture keeps its size.
  [[nodiscard]] bool holds_size() const;
  [[nodiscard]] glm::uvec2 next_size() const;
  void take_picture(Done& done);
  void lay_out(glm::uvec2 screen);
  /// Where nobody gave a size, it is that of the area which panels leave free.
  void fit_to_area(ViewState& state) const;
  void use_mouse(const Input& input, float seconds, bool focus);
  void draw_panels(glm::uvec2 screen, float progress);
  [[nodiscard]] std::string status() const;
  /// Where its lines begin.
  [[nodiscard]] float status_top(glm::uvec2 screen) const;
  void draw_status(glm::uvec2 screen) const;
  void take_wishes();
  void pass_time(float seconds);
  /// What has changed is a step of undo, once nobody is at it any more: a drag, a flight, a key that repeats.
  void note_change(const Input& input);
  void keep_change();
  void queue(Job::Kind kind);
  /// The lights of the clipboard's text, which must be one, in place of the picked one; and the other way round.
  void paste_light();
  void copy_light();
  /// Why what others list is not of the picture that is shown; or empty.
  [[nodiscard]] std::string why_outdated() const;
  /// What is set, with the size that is shown.
  [[nodiscard]] ViewState saved_state() const;
  /// One that was saved: its picture keeps the size in which it was shown, until it is one from another place.
  void open_state(ViewState state);
  void keep_drawn_size();
  void add_bookmark();
  void take_bookmark_wishes(const Wishes& wishes);
  /// Pictures that are still to be saved.
  [[nodiscard]] std::size_t waiting() const;
  void stop_saving();
  void undo(std::vector<ViewState>& from, std::vector<ViewState>& to);
  void try_state(const ViewState& before);
  /// Shows an error until something is changed.
  void save_json(const char* what, const std::string& file,
                 const std::function<void(const std::filesystem::path&)>& write);
  void complain(const std::string& error);
  /// In place of an error that was shown.
  void say_saved(const std::string& file);
  /// What could not be drawn: the last state that could comes back, unless something else was set since.
  void take_back(const ViewState& failed);

  ViewState state_;
  ViewState settled_;   ///< the state when nobody was changing it
  ViewState drawable_;  ///< the last that was drawn
  std::vector<ViewState> undone_, redone_;
  DeviceTraits traits_;
  std::vector<std::uint32_t> depth_samples_;
  Pace pace_;
  bool paced_;
  float scale_;
  double clock_ = 0.0;  ///< fractions of a frame of the flight
  Shown shown_;
  std::string drawn_content_, drawn_key_;  ///< of the last drawing that was asked for; with its size
  std::string drawn_place_;                ///< from where
  std::string opened_place_;               ///< from where a state is seen whose size is kept
  std::vector<Job> queued_;                ///< pictures and proofs
  bool busy_ = false;
  bool idle_ = false;
  bool proving_ = false;
  bool asking_ = false;
  bool lost_ = false;
  std::vector<OtherList> others_;  ///< of the picked pixel
  /// The picture for which they were asked.
  struct AskedFor {
    std::string place, lights;
    std::optional<glm::uvec2> picked;
    int light_frame = 0;
    glm::uvec2 size{0};
  };
  AskedFor asked_for_;
  std::string outdated_;  ///< why they are not of the picture that is shown; or empty
  ListScroll list_scroll_;
  Times times_;
  double picture_ms_ = 0.0;  ///< of a picture, all in all, smoothed
  double rests_s_ = 0.0;     ///< that nothing has changed
  std::string error_, said_;
  std::string proof_;     ///< of all pixels, in words; or empty
  std::string proof_of_;  ///< which picture `proof_` is of
  std::uint64_t errors_ = 0;
  bool error_stays_ = false;  ///< though what is drawn after it succeeds
  Places places_;
  Wishes wishes_;
  SaveFiles files_;
  std::vector<Bookmark> bookmarks_;
  std::string bookmark_;     ///< the name that is chosen or typed
  std::size_t numbers_ = 0;  ///< of cells, that are drawn
  ScreenRect area_;          ///< of the screen, that panels leave free
  ScreenRect picture_;       ///< within that
  glm::uvec2 asked_{1};
  std::optional<glm::vec2> last_mouse_, pressed_at_;
  bool dragging_ = false;
  bool drags_divider_ = false;
  std::set<std::string, std::less<>> chords_;  ///< keys that went down with Ctrl and are held: they do not fly
};

/// Whether a scene is a capture's folder or its frame.json: it has its own size.
[[nodiscard]] bool is_captured(const std::string& scene);

}  // namespace lamp::app
