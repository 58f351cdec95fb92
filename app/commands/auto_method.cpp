// Chooses and explains.
// SPDX-License-Identifier: Apache-2.0
#include "commands/auto_method.h"

#include <fmt/format.h>

#include <algorithm>

#include "system/print.h"

namespace lamp::app {
namespace {

std::string words_of(const Workload& w) {
  return fmt::format(
      "auto: {}x{}, {} lights; about {:.1f} reach a pixel; a tile of 16 px meets {:.1f} by its column, {:.1f} by its "
      "depth interval, {:.1f} exactly\n",
      w.width, w.height, w.lights, w.reached, w.tile16.column, w.tile16.interval, w.tile16.exact);
}

std::string words_of(const Choice& choice, const std::string& origin) {
  std::string words = fmt::format("{:<24} {:>10} {:>10} {:>10}\n", "candidate", "cull ms", "shade ms", "together");
  for (const Prediction& p : choice.predictions) {
    if (p.refused.empty())
      words += fmt::format("{:<24} {:>10.3f} {:>10.3f} {:>10.3f}\n", p.label, p.cull_ms, p.shade_ms, p.ms());
    else
      words += fmt::format("{:<24} cannot run: {}\n", p.label, p.refused);
  }
  words += fmt::format("takes {}{}{}: {}\n", choice.method, choice.options.empty() ? "" : " ",
                       fmt::join(choice.options, " "), choice.reason);
  return words + fmt::format("calibration: {}\n", origin);
}

}  // namespace

std::string method_words(const MethodChoice& chosen) {
  return fmt::format("{}{}{}", chosen.method->name, chosen.options.empty() ? "" : " ", fmt::join(chosen.options, " "));
}

const KnownCalibration& AutoMethod::known() {
  if (!known_) known_ = find_calibration(context_, shaders_, file_);
  return *known_;
}

MethodChoice AutoMethod::choose(Renderer& renderer, const AutoFrame& frame) {
  const std::vector<float> depth = frame.scene.captured ? frame.scene.captured->depth : renderer.draw_depth();
  Workload workload = estimate_workload(frame.view, depth, frame.lights);
  workload.capacity = frame.light_capacity;
  workload.boxes = frame.boxes;
  const Choice choice = lamp::choose(known().calibration, workload, context_.device().traits);
  explanation_ = words_of(workload) + words_of(choice, known().origin);
  return {.method = &parse_method(choice.method), .options = choice.options, .by_auto = true};
}

std::vector<MethodChoice> chosen_methods(Session& session, const Setup& setup, const Request& request,
                                         std::span<const std::string> names, bool json) {
  MethodChoice automatic;
  const bool asks =
      request.explain || std::ranges::any_of(names, [](const std::string& name) { return is_auto(name); });
  check_calibration(request.calibration, asks);
  if (asks) {
    AutoMethod chooser(session.context(), session.shaders(), request.calibration);
    automatic = chooser.choose(session.renderer(), {.scene = setup.scene,
                                                    .view = setup.view,
                                                    .lights = setup.lights,
                                                    .light_capacity = static_cast<std::uint32_t>(setup.lights.size()),
                                                    .boxes = static_cast<std::uint32_t>(setup.boxes())});
    if (request.explain) (json ? write_error : write_out)(chooser.explanation());
  }
  std::vector<MethodChoice> chosen;
  for (const std::string& name : names)
    chosen.push_back(is_auto(name) ? automatic
                                   : MethodChoice{.method = &parse_method(name), .options = request.options});
  return chosen;
}

}  // namespace lamp::app
