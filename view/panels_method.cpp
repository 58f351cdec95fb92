// Methods and their options, from the table alone: a new one appears here by itself.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "gpu/check.h"
#include "render/box_shapes.h"
#include "view/panels.h"

namespace lamp::app {
namespace {

constexpr std::string_view AUTO = "auto";
constexpr double MANY_TIMES = 64.0;  // a range of which the top is so much more than the bottom slides logarithmically

const Method* method_of(const std::string& name) {
  const auto found = find_method(name);
  return found.ok() ? found.value() : nullptr;
}

/// As the stage draws with them: decals and probes choose an option where nobody does.
std::vector<std::string> effective_options(const Method& method, const std::vector<std::string>& options,
                                           const Shown& shown) {
  return with_box_shapes(method, options, !shown.decals.empty() || !shown.probe_volumes.empty());
}

/// What an option is set to.
std::string value_of(const std::vector<std::string>& options, const OptionSpec& spec) {
  const std::string begin = std::string(spec.key) + "=";
  for (const std::string& option : options)
    if (option.starts_with(begin)) return option.substr(begin.size());
  return std::string(spec.fallback);
}

std::uint32_t number_of(const std::string& text) {
  std::uint32_t number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

/// Method and options of one side. `prefix` tells its labels from the other's.
void choose_method(PanelFrame& p, const std::string& prefix, std::string& name, std::vector<std::string>& options) {
  const std::vector<std::string_view> names = method_choices();
  const auto reason = [&](std::string_view method) { return why_not(std::string(method), {}, p.shown, p.traits); };
  if (p.widgets.choose(prefix + "method", name, names,
                       "How lights are culled. Auto takes the one expected to be fastest.", reason)) {
    const Method* chosen = method_of(name);
    options = chosen == nullptr ? std::vector<std::string>() : kept_options(options, *chosen);
  }
  const Method* method = method_of(name);
  if (method == nullptr) return;
  Widgets::note(method->summary);
  const std::vector<std::string> effective = effective_options(*method, options, p.shown);
  for (const OptionSpec& spec : method->options) {
    const std::string label = prefix + std::string(spec.key);
    std::string value = value_of(effective, spec);
    bool changed = false;
    if (!spec.choices.empty()) {
      changed = p.widgets.choose(label, value, spec.choices, std::string(spec.help), [&](std::string_view choice) {
        return why_not(name, with_option(options, spec, std::string(choice)), p.shown, p.traits);
      });
    } else {
      std::uint32_t number = number_of(value);
      const auto min = static_cast<double>(spec.min);
      const auto max = static_cast<double>(spec.max);
      changed =
          p.widgets.slide(label, number, {.min = min, .max = max, .logarithmic = max > MANY_TIMES * std::max(1.0, min)},
                          std::string(spec.help));
      value = fmt::format("{}", number);
    }
    if (changed) options = with_option(options, spec, value);
  }
}

/// Whether a side's lists fit, after its name.
void say_overflow(const char* side, const Stats& stats) {
  Widgets::steady(3, [&] {
    const std::vector<std::string> words = all_overflow_words(stats);
    if (!words.empty()) return Widgets::text(fmt::format("{}{}", side, fmt::join(words, "; ")));
    Widgets::note(fmt::format("{}Every list fits.", side));
  });
}

void choose_atlas(PanelFrame& p) {
  constexpr std::array<std::string_view, 6> SIDES{"512", "1024", "2048", "4096", "8192", "16384"};
  std::string side = fmt::format("{}", p.state.request.shadows.atlas);
  if (p.widgets.choose("atlas", side, SIDES, "Texels a side of the image that holds all shadow maps.",
                       [&](std::string_view name) {
                         return number_of(std::string(name)) <= p.traits.max_image_size
                                    ? std::string()
                                    : fmt::format("the device has images of at most {}", p.traits.max_image_size);
                       }))
    p.state.request.shadows.atlas = number_of(side);
}

}  // namespace

const char* only_of_first(const Shown& shown) { return shown.second ? "A: " : ""; }

std::vector<std::string_view> method_choices() {
  std::vector<std::string_view> names{AUTO};
  for (const Method& method : methods()) names.push_back(method.name);
  return names;
}

std::string why_not(const std::string& method, const std::vector<std::string>& options, const Shown& shown,
                    const DeviceTraits& traits) {
  const Method* found = method_of(method);
  if (found == nullptr || shown.number == 0) return "";
  auto resolved = resolve_options(*found, effective_options(*found, options, shown));
  if (!resolved.ok()) return resolved.error().text();
  const auto plan = make_plan(*found, {.width = shown.view.width(),
                                       .height = shown.view.height(),
                                       .light_capacity = static_cast<std::uint32_t>(shown.lights->size()),
                                       .options = std::move(resolved.value()),
                                       .traits = traits});
  return plan.ok() ? "" : plan.error().text();
}

std::vector<std::string> with_option(const std::vector<std::string>& options, const OptionSpec& spec,
                                     const std::string& value) {
  const std::string begin = std::string(spec.key) + "=";
  std::vector<std::string> changed = options;
  std::erase_if(changed, [&](const std::string& option) { return option.starts_with(begin); });
  changed.push_back(begin + value);
  return changed;
}

std::vector<std::string> kept_options(const std::vector<std::string>& options, const Method& method) {
  std::vector<std::string> kept;
  for (const std::string& option : options)
    if (resolve_options(method, {option}).ok()) kept.push_back(option);
  return kept;
}

std::string words_of_method(const Stats& stats) {
  std::string words = stats.method;
  const auto method = find_method(stats.method);
  if (!method.ok()) return words;
  for (const OptionSpec& spec : method.value()->options)
    if (stats.options.word(spec.key) != spec.fallback)
      words += fmt::format(" {}={}", spec.key, stats.options.word(spec.key));
  return words;
}

void method_panel(PanelFrame& p) {
  if (!p.widgets.header("Method", true)) return;
  choose_method(p, "", p.state.request.method, p.state.request.options);
  const Stats& stats = p.shown.first.stats;
  if (p.shown.first.by_auto) {
    Widgets::text(fmt::format("{}auto took {}", only_of_first(p.shown), stats.method));
    if (p.widgets.button("keep that", "Names the method that auto took, so that its options can be changed.")) {
      p.state.request.method = stats.method;
      p.state.request.options.clear();
      const Method& method = *method_of(stats.method);
      const std::vector<std::string> own = effective_options(method, {}, p.shown);
      for (const OptionSpec& spec : method.options)
        if (const std::string value(stats.options.word(spec.key)); value != value_of(own, spec))
          p.state.request.options = with_option(p.state.request.options, spec, value);
    }
  }
  p.widgets.choose("path", p.state.request.path, path_names(), "How pixels are shaded.", [&](std::string_view path) {
    Request changed = p.state.request;
    changed.path = path;
    return why_refused(changed);
  });
  p.widgets.choose("brdf", p.state.request.brdf, brdf_names(), "How surfaces reflect.");
  p.widgets.check("make room", p.state.request.grow, "Enlarges lists until every light fits.");
  const char* const side = only_of_first(p.shown);
  for (const std::string& note : stats.notes) Widgets::note(side + note);
  say_overflow(side, stats);
}

void shadow_panel(PanelFrame& p) {
  if (!p.widgets.header("Shadows and depth", false)) return;
  Request& r = p.state.request;
  p.widgets.choose(
      "shadows", r.shadows.filter, shadow_names(), "How shadows are filtered.", [&](std::string_view filter) {
        return p.shown.captured && filter != shadow_names().front() ? "a capture has no triangles that could cast one"
                                                                    : std::string();
      });
  if (r.shadows.filter != shadow_names().front()) {
    p.widgets.choose("point shadows", r.shadows.points, point_shadow_names(), "A point light's map.");
    p.widgets.choose("shadow raster", r.shadows.raster, shadow_raster_names(),
                     "What draws shadow maps: the GPU's rasterizer or compute shaders.");
    p.widgets.choose("shadow blur", r.shadows.blur, shadow_blur_names(),
                     "How vsm and evsm are blurred: in one pass, in two, or in two as the article's listing does.");
    choose_atlas(p);
    p.widgets.write("shadow lights", r.shadows.lights, "How many of the first lights cast shadows, or all.");
    p.widgets.write("shadow budget", r.shadows.budget, "Texels of shadow maps that are drawn in a frame, or all.");
    Widgets::steady(3, [&] {
      const std::optional<ShadowStats>& drawn = p.shown.first.stats.shadows;
      Widgets::note(drawn ? shadow_words(*drawn) : "");
    });
  }
  p.widgets.choose("depth", r.depth, depth_names(), "Which way device depth runs.",
                   [&](std::string_view) { return p.shown.captured ? "a capture has its own" : std::string(); });
  constexpr std::array<std::string_view, 4> SAMPLES{"1", "2", "4", "8"};
  std::string samples = fmt::format("{}", r.depth_samples);
  if (p.widgets.choose("depth samples", samples, SAMPLES, "Samples of a pixel that lights are culled with.",
                       [&](std::string_view name) -> std::string {
                         if (p.shown.captured && name != "1") return "a capture has one";
                         if (std::ranges::find(p.depth_samples, number_of(std::string(name))) != p.depth_samples.end())
                           return "";
                         return fmt::format("the device has depth images of {}", fmt::join(p.depth_samples, ", "));
                       }))
    r.depth_samples = number_of(samples);
}

void against_panel(PanelFrame& p) {
  if (!p.widgets.header("A against B", false)) return;
  bool compares = p.state.against.has_value();
  if (p.widgets.check("compare", compares, "Draws the picture right of a line with a second method. Drag the line."))
    p.state.against = compares ? std::optional(Against()) : std::nullopt;
  if (!p.state.against) return;
  p.widgets.slide("divider", p.state.against->divider, {}, "Where the line is.");
  choose_method(p, "B: ", p.state.against->method, p.state.against->options);
  const auto words = [](const Rendered& side) {
    return fmt::format("cull {:.2f} ms, shade {:.2f} ms", side.cull_ms, side.shade_ms);
  };
  Widgets::row("A", words(p.shown.first.stats.rendered));
  Widgets::row("B", p.shown.second ? words(p.shown.second->stats.rendered) : "not drawn yet");
  if (p.shown.second) say_overflow("B: ", p.shown.second->stats);
}

}  // namespace lamp::app
