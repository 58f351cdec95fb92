// The light that was picked: its properties, as sliders and as glTF.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <glm/glm.hpp>

#include <algorithm>
#include <limits>

#include "scene/gltf_light_text.h"
#include "view/panels.h"

namespace lamp::app {
namespace {

constexpr float NEW_RANGE_M = 10.0F;  // of a light that had none

/// True where something was changed.
bool change(Light& light, Widgets& widgets) {
  const float step = 0.01F * std::clamp(light.range, 0.1F, 100.0F);
  bool changed = widgets.move("position", light.position, step, "Where it is, metres. Drag a number.");
  bool ends = light.range < shared::INFINITE_RADIUS;
  if (widgets.check("has a range", ends, "Without one it reaches everything.")) {
    light.range = ends ? NEW_RANGE_M : std::numeric_limits<float>::infinity();
    changed = true;
  }
  if (ends)
    changed = widgets.slide("its range", light.range, {.min = 0.01, .max = 1000.0, .logarithmic = true},
                            "How far it reaches, metres.") ||
              changed;
  changed = widgets.color("color", light.color, "Its colour, linear.") || changed;
  changed = widgets.slide("intensity", light.intensity, {.min = 0.001, .max = 1e5, .logarithmic = true},
                          "How bright it is, candela.") ||
            changed;
  if (light.type != LightType::spot) return changed;
  changed = widgets.move("direction", light.direction, 0.01F, "Where it looks.") || changed;
  if (widgets.slide("outer angle", light.outer_angle, {.min = 0.01, .max = 1.57},
                    "Half of its cone's angle, radians.")) {
    light.inner_angle = std::min(light.inner_angle, light.outer_angle);
    changed = true;
  }
  return widgets.slide("inner angle", light.inner_angle, {.min = 0.0, .max = light.outer_angle},
                       "The same of the part that is fully bright.") ||
         changed;
}

void draw_gltf(const Light& light, std::uint32_t number, InspectorFrame& p) {
  constexpr int LINES = 12;
  const std::string name = fmt::format("light {}", number);
  const std::string refused = gltf_refusal(light, name);  // in every frame; the text only where it is shown
  if (p.widgets.button("copy as glTF",
                       "Puts it into the clipboard, as a glTF file that holds this light alone: a node, and a light of "
                       "KHR_lights_punctual.",
                       refused))
    p.wishes.copy_light = true;
  Widgets::beside();
  if (p.widgets.button("paste glTF", "Makes it the light of the glTF text in the clipboard."))
    p.wishes.paste_light = true;
  if (p.widgets.fold("the light as glTF"))
    Widgets::excerpt("gltf", refused.empty() ? gltf_text({&light, 1}, name) : refused, LINES);
}

}  // namespace

std::optional<Light> picked_light(const Shown& shown, const ViewState& state) {
  if (shown.number == 0 || !state.light || *state.light >= shown.lights->size()) return std::nullopt;
  const auto found = std::ranges::find(state.edits, *state.light, &LightEdit::light);
  return found != state.edits.end() ? found->value : unpacked(shown.lights->all()[*state.light]);
}

void light_editor(InspectorFrame& p) {
  std::optional<Light> light = picked_light(p.shown, p.state);
  if (!light) return;
  const std::uint32_t number = p.state.light.value_or(0);
  Widgets::text(fmt::format("light {}, a {} light", number, light->type == LightType::spot ? "spot" : "point"));
  const bool changed = change(*light, p.widgets);
  if (light->type == LightType::spot && light->direction == glm::vec3(0.0F)) return;  // while it is dragged through it
  const auto error = changed ? check_shown_lights({&*light, 1}) : std::nullopt;
  if (error)
    p.wishes.refused = fmt::format("light {}: {}", number, error->message);
  else if (changed)
    edit_light(p.state, number, *light);
  draw_gltf(*light, number, p);
}

}  // namespace lamp::app
