// The panels: each draws one part of a state, and changes it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>

#include "view/bookmarks.h"
#include "view/shown.h"
#include "view/times.h"
#include "view/widgets.h"

namespace lamp::app {

/// Where things are saved.
struct SaveFiles {
  std::string picture = "lamp-view.png";
  std::string frames = "0..29";  ///< of the flight
  std::string state = "lamp-view.json";
  std::string numbers = "lamp-view-numbers.json";
  std::string capture = "lamp-view-capture";
  std::string bookmarks = "lamp-view-bookmarks.json";
};

/// What the panels ask the viewer to do.
struct Wishes {
  bool save_picture = false;
  bool save_flight = false;
  bool stop_saving = false;
  bool save_capture = false;
  bool add_bookmark = false;
  bool remove_bookmark = false;
  bool save_bookmarks = false;
  std::optional<std::size_t> open_bookmark;
  bool save_state = false;
  bool save_numbers = false;
  bool prove = false;
  bool ask = false;         ///< the other methods
  bool copy_light = false;  ///< into the clipboard, as glTF
  bool paste_light = false;
  bool undo = false;
  bool redo = false;
  bool step = false;    ///< one frame of time
  std::string say;      ///< in the line below the picture; or empty
  std::string refused;  ///< why what was entered cannot be; or empty
};

/// What panels see.
struct PanelFrame {
  ViewState& state;
  const Shown& shown;
  Widgets& widgets;
  const Times& times;
  const DeviceTraits& traits;
  std::span<const std::uint32_t> depth_samples;  ///< that the device's depth images may have
  Wishes& wishes;
  SaveFiles& files;
  std::size_t waiting = 0;  ///< pictures that are still to be saved
  const std::vector<Bookmark>& bookmarks;
  std::string& bookmark;     ///< the name that is chosen or typed
  const std::string& proof;  ///< of all pixels, in words; or empty
  bool proving = false;
  float progress = 0.0F;  ///< of that
};

void scene_panel(PanelFrame& p);
void camera_panel(PanelFrame& p);
void lights_panel(PanelFrame& p);
void method_panel(PanelFrame& p);
void shadow_panel(PanelFrame& p);
void world_panel(PanelFrame& p);
void against_panel(PanelFrame& p);
void look_panel(PanelFrame& p);
void times_panel(PanelFrame& p);
void save_panel(PanelFrame& p);
void bookmark_panel(PanelFrame& p);
void proof_panel(PanelFrame& p);
/// Where the inspector and its list of lights were: the list moves only to show a light that was picked elsewhere, the
/// window only where what panels leave free is another area.
struct ListScroll {
  std::optional<std::uint32_t> light;  ///< picked
  std::optional<std::size_t> row;      ///< its, if it is listed
  bool pending = false;                ///< it was picked elsewhere, and not shown yet
  bool in_sight = false;
  glm::uvec2 pixel{0};
  std::size_t rows = 0;  ///< the most of the pixel's lists: they stay as high
  ScreenRect area;
};
/// What the inspector's window sees.
struct InspectorFrame {
  const Shown& shown;
  Widgets& widgets;
  ViewState& state;
  Wishes& wishes;
  ListScroll& scroll;
  const std::vector<OtherList>& others;  ///< of the pixel, if they were asked
  std::string outdated;                  ///< since when they say something else than the picture; or empty
  bool asking = false;
};
/// The pixel that was picked.
void inspector_window(InspectorFrame& p, const ScreenRect& area, float scale);
/// Of its cell, with what tells whether another method lists them too.
void list_of_lights(InspectorFrame& p);
/// What the other methods list, and how that differs.
void lists_of_others(InspectorFrame& p);
/// The light that was picked: what is changed becomes an edit of the state.
void light_editor(InspectorFrame& p);
/// The light that was picked, as it was changed; nothing where there is none.
[[nodiscard]] std::optional<Light> picked_light(const Shown& shown, const ViewState& state);
void help_window(const ScreenRect& picture, float scale);
/// The colours of an overlay in a corner of the picture.
/// `lift`: pixels above the bottom. `numbers`: of cells, that are drawn.
void legend_window(const Shown& shown, const ScreenRect& picture, float lift, std::size_t numbers);

/// An error with the labels of widgets in place of options of the command line: "still lists", not "--still-lists".
[[nodiscard]] std::string named_by_widgets(std::string_view error);
/// Why an overlay cannot be laid over what is shown; empty: it can.
[[nodiscard]] std::string why_no_overlay(Overlay overlay, const ViewState& state, const Shown& shown);
/// Why the request, were it so, is refused whatever the scene; empty: it is not.
[[nodiscard]] std::string why_refused(const Request& request);
/// Why a method with these options cannot light this frame; empty: it can.
[[nodiscard]] std::string why_not(const std::string& method, const std::vector<std::string>& options,
                                  const Shown& shown, const DeviceTraits& traits);
/// The options with one set, also to the method's own value: with decals and probes it is not what is drawn.
[[nodiscard]] std::vector<std::string> with_option(const std::vector<std::string>& options, const OptionSpec& spec,
                                                   const std::string& value);
/// Those of the options that another method has too.
[[nodiscard]] std::vector<std::string> kept_options(const std::vector<std::string>& options, const Method& method);
/// The method and those of its options that are not its own.
[[nodiscard]] std::string words_of_method(const Stats& stats);
/// Before what is said of the first method alone while there is a second: "A: ", or nothing.
[[nodiscard]] const char* only_of_first(const Shown& shown);
/// All methods' names, with "auto" before them.
[[nodiscard]] std::vector<std::string_view> method_choices();

}  // namespace lamp::app
