// One thread: input, interface, the viewer's job, the screen.
// SPDX-License-Identifier: Apache-2.0
#include "view/headless.h"

#include <fmt/format.h>

#include <algorithm>
#include <glm/glm.hpp>
#include <memory>

#include "view/depth_samples.h"
#include "view/offscreen.h"

namespace lamp::app {
namespace {

constexpr float STEP_S = 1.0F / 30.0F;

class HeadlessScreen {
 public:
  HeadlessScreen(Context& context, Stage& stage, Viewer& viewer, glm::uvec2 size)
      : context_(context), stage_(stage), viewer_(viewer), gui_(context, Offscreen::FORMAT, Offscreen::END, 1.0F) {
    resize(size);
  }

  void resize(glm::uvec2 size) {
    size_ = size;
    minimised_ = size == glm::uvec2(0);
    const std::uint32_t limit = context_.device().traits.max_image_size;
    if (std::max(size.x, size.y) > limit)
      throw Error(
          fmt::format("screen of {}x{}: expected at most {} pixels a side on this device", size.x, size.y, limit));
    if (!minimised_) screen_ = std::make_unique<Offscreen>(context_, gui_, size);
  }

  void frame() {
    if (!minimised_) {
      gui_.begin(input_, size_, STEP_S);
      viewer_.frame(input_, size_, STEP_S, stage_.progress());
      gui_.end();
    }
    input_.next_frame();
    if (std::optional<Job> job = viewer_.next_job()) viewer_.finish(perform(stage_, std::move(*job)));
    if (minimised_) return;
    screen_->draw(gui_, viewer_.shown().image.get(), viewer_.picture());
    viewer_.took_interface(gui_.interface_ms());
  }

  [[nodiscard]] LdrImage read() { return screen_->read(); }
  [[nodiscard]] Input& input() { return input_; }

 private:
  Context& context_;
  Stage& stage_;
  Viewer& viewer_;
  Gui gui_;
  Input input_;
  glm::uvec2 size_{0};
  bool minimised_ = false;
  std::unique_ptr<Offscreen> screen_;
};

}  // namespace

void run_headless(Context& context, const HeadlessInfo& info, const std::function<void(Player&)>& use) {
  const Request& request = info.state.request;
  const ShaderLibrary shaders(request.shader_dir);
  {
    Stage stage(context, shaders, request.calibration);
    Viewer viewer({.state = info.state,
                   .traits = context.device().traits,
                   .depth_samples = depth_sample_counts(context),
                   .target_ms = info.target_ms,
                   .rest_ms = info.rest_ms,
                   .bookmarks = info.bookmarks});
    HeadlessScreen screen(context, stage, viewer, info.screen);
    Player player{.viewer = viewer,
                  .input = screen.input(),
                  .frame = [&] { screen.frame(); },
                  .resize = {},
                  .screen = [&] { return screen.read(); },
                  .size = info.screen};
    player.resize = [&](glm::uvec2 size) {
      screen.resize(size);
      player.size = size;
    };
    screen.frame();
    use(player);
  }
  for (const std::string& message : context.take_messages()) throw Error("validation: " + message, Exit::check_failed);
}

}  // namespace lamp::app
