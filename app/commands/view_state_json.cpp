// A viewer's state as a JSON object. One list of its members serves reading, writing and the check of keys.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "commands/view_state.h"
#include "files/json_values.h"
#include "files/read_file.h"
#include "files/read_json.h"
#include "image/image.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t VERSION = 1;
constexpr std::string_view POINT = "point";
constexpr std::string_view SPOT = "spot";

/// Every member by its key, with what it may be. What `Fields` does with it: read, write, or note the key.
template <class Fields, class State>
void for_each_field(Fields&& at, State& s) {
  auto& r = s.request;
  at.text("scene", r.scene);
  at.size("size", "window", r.size, r.size_given);
  at.lights("lights", "lights_given", r.lights, r.lights_given);
  at.real("spots", r.spots, 0.0F, 1.0F);
  at.text("range", r.range);
  at.whole("decals", r.decals, 0, MAX_BOXES);
  at.seed("seed", r.seed);
  at.text("method", r.method);
  at.settings("options", r.options);
  at.text("path", r.path);
  at.text("brdf", r.brdf);
  at.real("still", r.still, 0.0F, 1.0F);
  at.text("still_lists", r.still_lists);
  at.whole("still_occlusion", r.still_occlusion, 0, 1024);
  at.real("still_bytes", r.still_bytes, 0.0F, 1e9F);
  at.flag("moving", r.moving);
  at.real("mirror", r.mirror, 0.0F, 1.0F);
  at.text("mirror_lists", r.mirror_lists);
  at.whole("probes", r.probes, 0, MAX_BOXES);
  at.text("probes_show", r.probes_show);
  at.whole("probe_budget", r.probe_budget, 0, MAX_BOXES);
  for (const auto& [name, value] : SHADOW_WORDS) at.text(name, r.shadows.*value);
  at.whole("atlas", r.shadows.atlas, 1, 32768);
  at.text("camera", r.camera);
  at.moment("frame", r.frame);
  at.moment("light_frame", r.light_frame);
  at.camera("free_camera", r.free_camera);
  at.text("projection", r.projection);
  at.text("depth", r.depth);
  at.whole("depth_samples", r.depth_samples, 1, 8);
  at.flag("grow", r.grow);
  at.text("exposure", s.exposure);
  at.whole("samples", s.samples, 1, 1024);
  at.edits("edits", s.edits);
  at.real("resolution", s.resolution, 0.0F, 1.0F);
  at.flag("paused", s.paused);
  at.real("speed", s.speed, -100.0F, 100.0F);
  at.word("overlay", s.overlay, overlay_names());
  at.word("palette", s.palette, palette_names());
  at.word("light_marks", s.light_marks, light_mark_names());
  at.word("proxies", s.proxies, light_mark_names());
  at.word("shadow_shape", s.shadow_shape, shadow_shape_names());
  at.real("slice_m", s.slice_m, 0.01F, 1e6F);
  at.flag("depth_bins", s.depth_bins);
  at.flag("probe_boxes", s.probe_boxes);
  at.flag("world_cells", s.world_cells);
  at.flag("decal_boxes", s.decal_boxes);
  at.flag("list_lengths", s.list_lengths);
  at.pixel("drawn", s.drawn, 1);
  at.pixel("picked", s.picked, 0);
  at.maybe("light", s.light, MAX_LIGHTS - 1);
  at.text("other", s.other);
  at.against("against", s.against);
  at.flag("panels", s.panels);
  at.flag("help", s.help);
}

/// Notes all keys.
struct Keys {
  std::vector<std::string_view> keys{"version"};

  void text(std::string_view key, const auto&) { keys.push_back(key); }
  void size(std::string_view key, std::string_view window_key, const auto&, const auto&) {
    keys.insert(keys.end(), {key, window_key});
  }
  void whole(std::string_view key, const auto&, std::uint32_t, std::uint32_t) { keys.push_back(key); }
  void lights(std::string_view key, std::string_view given_key, const auto&, const auto&) {
    keys.insert(keys.end(), {key, given_key});
  }
  void real(std::string_view key, const auto&, float, float) { keys.push_back(key); }
  void word(std::string_view key, const auto&, const auto&) { keys.push_back(key); }
  void seed(std::string_view key, const auto& v) { text(key, v); }
  void settings(std::string_view key, const auto& v) { text(key, v); }
  void moment(std::string_view key, const auto& v) { text(key, v); }
  void camera(std::string_view key, const auto& v) { text(key, v); }
  void flag(std::string_view key, const auto& v) { text(key, v); }
  void edits(std::string_view key, const auto& v) { text(key, v); }
  void pixel(std::string_view key, const auto& v, std::uint32_t) { text(key, v); }
  void maybe(std::string_view key, const auto& v, std::uint32_t) { text(key, v); }
  void against(std::string_view key, const auto& v) { text(key, v); }
};

nlohmann::json settings_json(const std::vector<std::string>& settings) {
  nlohmann::json json = nlohmann::json::object();
  for (const std::string& setting : settings) {
    const std::size_t equals = setting.find('=');
    json[setting.substr(0, equals)] = equals == std::string::npos ? "" : setting.substr(equals + 1);
  }
  return json;
}

nlohmann::json vector_json(const auto& v) { return {v.x, v.y, v.z}; }

nlohmann::json light_json(const LightEdit& edit) {
  const Light& l = edit.value;
  nlohmann::json json{{"light", edit.light},
                      {"type", l.type == LightType::spot ? SPOT : POINT},
                      {"position", vector_json(l.position)},
                      {"color", vector_json(l.color)},
                      {"intensity", l.intensity}};
  if (l.range < shared::INFINITE_RADIUS) json["range"] = l.range;
  if (l.type == LightType::spot)
    json.update(
        {{"direction", vector_json(l.direction)}, {"inner_angle", l.inner_angle}, {"outer_angle", l.outer_angle}});
  return json;
}

struct Writer {
  nlohmann::json json{{"version", VERSION}};

  void text(std::string_view key, const auto& value) { json[key] = value; }
  /// Which nobody gave is the window's: another window gives another.
  void size(std::string_view key, std::string_view window_key, const auto& value, bool given) {
    json[given ? key : window_key] = value;
  }
  void whole(std::string_view key, const auto& value, std::uint32_t, std::uint32_t) { json[key] = value; }
  /// A number that nobody gave is kept for the scene after a capture, which has its own lights alone.
  void lights(std::string_view key, std::string_view given_key, std::uint32_t value, bool given) {
    if (!given && value == Request().lights) return;
    json[key] = value;
    if (!given) json[given_key] = false;
  }
  void real(std::string_view key, float value, float, float) { json[key] = value; }
  void word(std::string_view key, const auto& value, std::span<const std::string_view> names) {
    json[key] = names[static_cast<std::size_t>(value)];
  }
  void seed(std::string_view key, std::uint64_t value) { json[key] = value; }
  void flag(std::string_view key, bool value) { json[key] = value; }
  void settings(std::string_view key, const std::vector<std::string>& value) { json[key] = settings_json(value); }
  void moment(std::string_view key, int value) { json[key] = value < 0 ? nlohmann::json() : nlohmann::json(value); }
  void camera(std::string_view key, const std::optional<FreeCamera>& c) {
    json[key] = nullptr;
    if (!c) return;
    json[key] = {
        {"eye", vector_json(c->eye)}, {"yaw", c->yaw}, {"pitch", c->pitch}, {"near", c->near_m}, {"far", c->far_m}};
    if (c->orthographic)
      json[key]["half_height"] = c->half_height;
    else
      json[key]["fov_y"] = c->fov_y;
  }
  void edits(std::string_view key, const std::vector<LightEdit>& value) {
    json[key] = nlohmann::json::array();
    for (const LightEdit& edit : value) json[key].push_back(light_json(edit));
  }
  void pixel(std::string_view key, const std::optional<glm::uvec2>& value, std::uint32_t) {
    json[key] = value ? nlohmann::json{value->x, value->y} : nlohmann::json();
  }
  void maybe(std::string_view key, const std::optional<std::uint32_t>& value, std::uint32_t) {
    json[key] = value ? nlohmann::json(*value) : nlohmann::json();
  }
  void against(std::string_view key, const std::optional<Against>& value) {
    json[key] = nullptr;
    if (value)
      json[key] = {{"method", value->method}, {"options", settings_json(value->options)}, {"divider", value->divider}};
  }
};

/// Reads the members that are there.
class Reader {
 public:
  explicit Reader(const JsonObject& object) : o_(object) {}

  void text(std::string_view key, std::string& value) {
    if (o_.has(key)) value = o_.text(key, "a text");
  }
  void size(std::string_view key, std::string_view window_key, std::string& value, bool& given) {
    if (!o_.has(key) && !o_.has(window_key)) return;
    given = o_.has(key);
    text(given ? key : window_key, value);
  }
  void whole(std::string_view key, std::uint32_t& value, std::uint32_t min, std::uint32_t max) {
    if (o_.has(key)) value = o_.whole(key, min, max);
  }
  void lights(std::string_view key, std::string_view given_key, std::uint32_t& value, bool& given) {
    whole(key, value, 0, MAX_LIGHTS);
    given = given || o_.has(key);
    flag(given_key, given);
  }
  void real(std::string_view key, float& value, float min, float max) {
    if (!o_.has(key)) return;
    const double number = o_.number(key);
    if (number < min || number > max) o_.fail(fmt::format("{} is {}, expected {} .. {}", key, number, min, max));
    value = static_cast<float>(number);
  }
  template <class Word>
  void word(std::string_view key, Word& value, std::span<const std::string_view> names) {
    if (!o_.has(key)) return;
    const std::string name = o_.text(key, fmt::format("one of {}", fmt::join(names, ", ")));
    const auto found = std::ranges::find(names, name);
    if (found == names.end())
      o_.fail(fmt::format("{} is {}, expected one of {}", key, shown(o_.json[key]), fmt::join(names, ", ")));
    value = static_cast<Word>(found - names.begin());
  }
  void seed(std::string_view key, std::uint64_t& value) {
    if (!o_.has(key)) return;
    const nlohmann::json& json = o_.json[key];
    if (!json.is_number_unsigned()) o_.fail(fmt::format("{} is {}, expected a whole number >= 0", key, shown(json)));
    value = json.get<std::uint64_t>();
  }
  void flag(std::string_view key, bool& value) {
    if (!o_.has(key)) return;
    const nlohmann::json& json = o_.json[key];
    if (!json.is_boolean()) o_.fail(fmt::format("{} is {}, expected true or false", key, shown(json)));
    value = json.get<bool>();
  }
  void moment(std::string_view key, int& value) {
    if (!o_.has(key)) return;
    constexpr std::uint32_t MOST = std::numeric_limits<int>::max();
    value = o_.json[key].is_null() ? -1 : static_cast<int>(o_.whole(key, 0, MOST));
  }
  void settings(std::string_view key, std::vector<std::string>& value) {
    if (!o_.has(key)) return;
    const nlohmann::json& json = o_.json[key];
    if (!json.is_object()) o_.fail(fmt::format("{} is {}, expected an object of texts", key, shown(json)));
    value.clear();
    for (const auto& [name, setting] : json.items()) {
      if (!setting.is_string()) o_.fail(fmt::format("{}: {} is {}, expected a text", key, name, shown(setting)));
      value.push_back(name + "=" + setting.get<std::string>());
    }
  }
  void camera(std::string_view key, std::optional<FreeCamera>& value) {
    if (!present(key, value)) return;
    const JsonObject c = object(key);
    c.check_keys(std::to_array<std::string_view>({"eye", "yaw", "pitch", "near", "far", "half_height", "fov_y"}));
    FreeCamera camera;
    const std::vector<double> eye = c.numbers("eye", 3);
    camera.eye = {eye[0], eye[1], eye[2]};
    camera.yaw = c.number("yaw");
    camera.pitch = c.number("pitch");
    if (std::abs(camera.pitch) > std::numbers::pi / 2.0) c.fail("pitch must lie within a right angle, in radians");
    camera.near_m = c.real("near");
    camera.far_m = c.real("far");
    camera.orthographic = c.has("half_height");
    const bool ahead = camera.near_m > 0.0F && camera.far_m >= 0.0F;
    if (!camera.orthographic && !ahead)
      c.fail(fmt::format("near is {} and far {}, expected near > 0 m, and far beyond it or 0, without end",
                         camera.near_m, camera.far_m));
    if (camera.orthographic)
      camera.half_height = c.real("half_height");
    else
      camera.fov_y = c.real("fov_y");
    value = camera;
  }
  void pixel(std::string_view key, std::optional<glm::uvec2>& value, std::uint32_t min) {
    if (!present(key, value)) return;
    const std::vector<double> xy = o_.numbers(key, 2);
    for (const double number : xy)
      if (number < min || number >= MAX_IMAGE_SIZE + min || number != std::floor(number))
        o_.fail(fmt::format("{} is {}, expected two whole numbers {} .. {}", key, shown(o_.json[key]), min,
                            MAX_IMAGE_SIZE - 1 + min));
    value = glm::uvec2(xy[0], xy[1]);
  }
  void maybe(std::string_view key, std::optional<std::uint32_t>& value, std::uint32_t max) {
    if (present(key, value)) value = o_.whole(key, 0, max);
  }
  void against(std::string_view key, std::optional<Against>& value) {
    if (!present(key, value)) return;
    const JsonObject a = object(key);
    a.check_keys(std::to_array<std::string_view>({"method", "options", "divider"}));
    Against against = value.value_or(Against());
    Reader reader(a);
    reader.text("method", against.method);
    reader.settings("options", against.options);
    reader.real("divider", against.divider, 0.0F, 1.0F);
    value = std::move(against);
  }
  void edits(std::string_view key, std::vector<LightEdit>& value) {
    if (!o_.has(key)) return;
    const nlohmann::json& json = o_.json[key];
    if (!json.is_array()) o_.fail(fmt::format("{} is {}, expected an array of lights", key, shown(json)));
    value.clear();
    for (std::size_t i = 0; i < json.size(); ++i)
      value.push_back(edit({.json = json[i], .file = o_.file, .element = fmt::format("{} {}", key, i)}));
  }

 private:
  /// Whether there is a value; null takes the state's away.
  template <class Value>
  bool present(std::string_view key, std::optional<Value>& value) const {
    if (!o_.has(key)) return false;
    if (o_.json[key].is_null()) value.reset();
    return !o_.json[key].is_null();
  }
  [[nodiscard]] JsonObject object(std::string_view key) const {
    return {.json = o_.json[key], .file = o_.file, .element = std::string(key)};
  }
  static LightEdit edit(const JsonObject& l) {
    l.check_keys(std::to_array<std::string_view>(
        {"light", "type", "position", "range", "color", "intensity", "direction", "inner_angle", "outer_angle"}));
    LightEdit edit{.light = l.whole("light", 0, MAX_LIGHTS - 1)};
    const std::string type = l.text("type", "point or spot");
    if (type != POINT && type != SPOT) l.fail(fmt::format("type is {}, expected point or spot", shown(l.json["type"])));
    edit.value.type = type == SPOT ? LightType::spot : LightType::point;
    edit.value.position = l.vector("position");
    if (l.has("range")) edit.value.range = l.real("range");
    edit.value.color = l.vector("color");
    edit.value.intensity = l.real("intensity");
    if (type == POINT) return edit;
    edit.value.direction = l.vector("direction");
    edit.value.inner_angle = l.real("inner_angle");
    edit.value.outer_angle = l.real("outer_angle");
    return edit;
  }

  const JsonObject& o_;
};

}  // namespace

nlohmann::json to_json(const ViewState& state) {
  Writer writer;
  for_each_field(writer, state);
  return std::move(writer.json);
}

void read_state(ViewState& state, const nlohmann::json& json, const std::string& name) {
  const JsonObject object{.json = json, .file = name, .element = ""};
  ViewState read = state;
  Keys known;
  for_each_field(known, read);
  object.check_keys(known.keys);
  if (object.has("version")) static_cast<void>(object.whole("version", VERSION, VERSION));
  for_each_field(Reader(object), read);
  // Who names another camera leaves the free one.
  const bool elsewhere = object.has("camera") || (object.has("frame") && read.request.frame >= 0);
  if (elsewhere && !object.has("free_camera")) read.request.free_camera.reset();
  try {
    check_state(read);
  } catch (const Error& error) {
    throw Error(fmt::format("{}: {}", name, error.what()), error.exit());
  }
  state = std::move(read);
}

ViewState load_state(const std::filesystem::path& file, ViewState state) {
  const std::string name = file.string();
  const std::vector<std::byte> bytes =
      read_file(file, {.expected = "a state that lamp-view saved", .most_bytes = std::uint64_t{1} << 26});
  const nlohmann::json json = parse_json(text_of(bytes), name);
  const JsonObject object{.json = json, .file = name, .element = ""};
  if (!json.is_object()) object.fail(fmt::format("is {}, expected an object", shown(json)));
  static_cast<void>(object.whole("version", VERSION, VERSION));
  read_state(state, json, name);
  return state;
}

void save_state(const std::filesystem::path& file, const ViewState& state) {
  write_text(file, json_text(to_json(state), 2) + "\n");
}

}  // namespace lamp::app
