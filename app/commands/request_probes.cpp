// Reflection probes: the options, the probes, and their captures.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>

#include "commands/command_line.h"
#include "commands/request.h"
#include "gpu/check.h"
#include "render/place_probes.h"
#include "system/progress.h"

namespace lamp::app {
namespace {

constexpr std::array<std::string_view, 2> SHOWN{"captures", "flat"};

}  // namespace

std::span<const std::string_view> probes_show_names() { return SHOWN; }

void check_probes_show(const Request& request) {
  static_cast<void>(parse_name("--probes-show", request.probes_show, SHOWN));
}

CLI::Option* add_probe_option(CLI::App& command, Request& r) {
  return command
      .add_option("--probes", r.probes,
                  "number of reflection probes: the scene's own first, then generated ones in its open air")
      ->check(whole_number(0, MAX_BOXES))
      ->type_name("N")
      ->group("Lights")
      ->capture_default_str();
}

void add_probe_options(CLI::App& command, Request& r) {
  CLI::Option* probes = add_probe_option(command, r);
  command
      .add_option("--probes-show", r.probes_show,
                  "captures: what each probe sees from its place, drawn before the first frame; flat: a colour each")
      ->needs(probes)
      ->type_name("WHAT")
      ->group("Lights")
      ->capture_default_str();
  command
      .add_option("--probe-budget", r.probe_budget,
                  "captures that are renewed in each further frame, whose lights have moved")
      ->needs(probes)
      ->check(whole_number(0, MAX_BOXES))
      ->type_name("N")
      ->group("Lights")
      ->capture_default_str();
}

std::vector<Probe> requested_probes(const Request& request, const Scene& scene) {
  if (request.probes == 0) return {};
  std::vector<Probe> probes = place_probes(scene, request.probes, request.seed);
  if (const auto error = check_probes(probes)) throw Error(scene.name + ": " + error->text());
  return probes;
}

void Session::make_probes(const Request& request) {
  if (request.probes_show == "flat") {
    flat_probes_ = std::make_unique<FlatProbes>(*context_, shaders_, setup_.probes);
    renderer_->light_probes(&flat_probes_->set);
    return;
  }
  captures_ = std::make_unique<ProbeCaptures>(
      *context_, shaders_, *gpu_scene_,
      ProbeCaptureInfo{.light_capacity = static_cast<std::uint32_t>(setup_.lights.size()),
                       .decal_capacity = static_cast<std::uint32_t>(setup_.decals.size()),
                       .brdf = brdf_,
                       .shadows = shadows_},
      setup_.probes);
  Progress line;
  captures_->renew({.views = setup_.views, .lights = setup_.lights, .decals = setup_.decals}, ~0U,
                   [&](double done) { line.show("capture reflection probes", done); });
  line.clear();
  renderer_->light_probes(&captures_->set());
}

void Session::renew_probes() {
  if (captures_)
    captures_->renew({.views = setup_.views, .lights = setup_.lights, .decals = setup_.decals}, probe_budget_);
}

}  // namespace lamp::app
