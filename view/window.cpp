// The window's thread reads input, updates the state, draws the interface over the newest picture.
// SPDX-License-Identifier: Apache-2.0
#include "view/window.h"

#include <fmt/format.h>
#include <glm/glm.hpp>

#include <array>
#include <chrono>
#include <functional>
#include <memory>

#include "view/depth_samples.h"
#include "view/glfw_window.h"
#include "view/settings.h"
#include "view/swapchain.h"
#include "view/worker.h"

namespace lamp::app {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double TICK_S = 1.0 / 60.0;  // input is taken at least as often
constexpr float SCRIPT_STEP_S = 1.0F / 30.0F;
constexpr double SOFTWARE_PICTURE_MS = 90.0;  // for ten a second, with what lies between them
constexpr double DEVICE_PICTURE_MS = 14.0;
// On a software device the interface waits behind the picture that is being drawn, and so would input: it is drawn
// between two pictures, and during long ones as often as this.
constexpr double LEAST_OFTEN_S = 0.25;

/// Where the state goes when the device does.
constexpr const char* KEPT_STATE = "lamp-view-lost.json";

double seconds_between(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

class ViewWindow {
 public:
  ViewWindow(Context& context, GlfwWindow& window, const WindowInfo& info)
      : context_(context),
        window_(window),
        swapchain_(context, window.make_surface(context.instance().handle)),
        gui_(context, swapchain_.format(), VK_IMAGE_LAYOUT_PRESENT_SRC_KHR, window.scale()),
        shaders_(info.state.request.shader_dir),
        stage_(context, shaders_, info.state.request.calibration),
        viewer_({.state = info.state,
                 .traits = context.device().traits,
                 .depth_samples = depth_sample_counts(context),
                 .target_ms = context.software() ? SOFTWARE_PICTURE_MS : DEVICE_PICTURE_MS,
                 .scale = window.scale(),
                 .bookmarks = info.bookmarks}),
        worker_(stage_, wake_window) {
    window.share_clipboard();
  }

  ~ViewWindow() { swapchain_.wait(); }
  ViewWindow(const ViewWindow&) = delete;
  ViewWindow& operator=(const ViewWindow&) = delete;

  /// Takes events and draws. With a fixed step, time is a script's.
  void tick(Input& input, std::optional<float> step_s) {
    const Clock::time_point now = Clock::now();
    const auto seconds = step_s.value_or(static_cast<float>(std::min(seconds_between(last_tick_, now), 0.25)));
    last_tick_ = now;
    if (std::optional<Done> done = worker_.take()) viewer_.finish(std::move(*done));
    const glm::uvec2 size = window_.size();
    const bool visible = size.x != 0 && size.y != 0;
    if (visible) {
      gui_.begin(input, size, seconds);
      viewer_.frame(input, size, seconds, stage_.progress());
      gui_.end();
    }
    input.next_frame();
    if (visible) draw(size, now);
    if (!worker_.busy())
      if (std::optional<Job> job = viewer_.next_job()) worker_.begin(std::move(*job));
  }

  [[nodiscard]] Viewer& viewer() { return viewer_; }

 private:
  void draw(glm::uvec2 size, Clock::time_point now) {
    if (context_.software() && worker_.busy() && seconds_between(last_draw_, now) < LEAST_OFTEN_S) return;
    if (!swapchain_.ready()) return;
    if (size != swapchain_.size() || outdated_) swapchain_.resize(gui_, size);
    held_ = viewer_.shown().image;  // until this is drawn
    outdated_ = !swapchain_.draw([&](VkCommandBuffer commands, const Canvas& canvas) {
      gui_.record(commands, canvas, held_.get(), viewer_.picture());
    });
    viewer_.took_interface(gui_.interface_ms());
    last_draw_ = now;
  }

  Context& context_;
  GlfwWindow& window_;
  Swapchain swapchain_;
  Gui gui_;
  ShaderLibrary shaders_;
  Stage stage_;
  Viewer viewer_;
  std::shared_ptr<const GpuImage> held_;
  bool outdated_ = true;
  Clock::time_point last_tick_ = Clock::now();
  Clock::time_point last_draw_;
  Worker worker_;  ///< the last member: it uses the others
};

/// Does it; when the device is gone, saves the state first.
void with_state_kept(ViewWindow& view, const std::function<void()>& use) {
  try {
    use();
  } catch (const Error& error) {
    if (std::string_view(error.what()).find("VK_ERROR_DEVICE_LOST") == std::string_view::npos) throw;
    view.viewer().save_state(KEPT_STATE);
    throw Error(fmt::format("the device was lost; what was set is in {}, for --state", KEPT_STATE), Exit::no_device);
  }
}

void play_in(ViewWindow& view, GlfwWindow& window, const WindowInfo& info) {
  Input input;
  Player player{
      .viewer = view.viewer(),
      .input = input,
      .frame =
          [&] {
            window.take_events(TICK_S);
            if (window.wants_to_close())
              throw Error("the window was closed before the script's end", Exit::check_failed);
            window.input() = {};  // of a user who may be there
            view.tick(input, SCRIPT_STEP_S);
          },
      .resize = {},
      .screen = []() -> LdrImage { throw Error("save_screen: a window cannot be read back, expected --headless"); },
      .size = info.size};
  player.resize = [&](glm::uvec2 size) {
    const bool minimised = size == glm::uvec2(0);
    window.set_minimised(minimised);
    if (minimised) return;
    window.resize(size);
    player.size = size;
  };
  play(player, info.script);
}

}  // namespace

void run_window(const WindowInfo& info) {
  constexpr std::array<const char*, 1> DEVICE_EXTENSIONS{VK_KHR_SWAPCHAIN_EXTENSION_NAME};
  const Desktop desktop;
  GlfwWindow window("lamp-view", info.size);
  Context context({.device = info.state.request.device,
                   .validation = info.validation,
                   .instance_extensions = desktop.instance_extensions(),
                   .device_extensions = DEVICE_EXTENSIONS});
  {
    ViewWindow view(context, window, info);
    with_state_kept(view, [&] {
      if (info.plays) {
        play_in(view, window, info);
      } else {
        view.viewer().say(info.said);
        while (!window.wants_to_close()) {
          window.take_events(TICK_S);
          view.tick(window.input(), std::nullopt);
        }
        if (info.closed) info.closed(view.viewer().state(), unscaled(window.size(), window.content_scale()));
      }
    });
  }
  for (const std::string& message : context.take_messages()) throw Error("validation: " + message, Exit::check_failed);
}

}  // namespace lamp::app
