// Adds the options that commands share, in the groups in which the help shows them.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <array>
#include <limits>

#include "commands/calibration.h"
#include "commands/command_line.h"
#include "commands/request.h"
#include "system/print.h"

namespace lamp::app {
namespace {

void add_light_options(CLI::App& command, Request& r) {
  const auto note = [&r](const char* option) {
    return [&r, option](const std::string&) {
      if (r.about_generated.empty()) r.about_generated = option;
    };
  };
  command.add_option("--lights", r.lights, "number of lights to generate, besides the scene's own; for a capture 0")
      ->check(whole_number(0, MAX_LIGHTS))
      ->each([&r](const std::string&) { r.lights_given = true; })
      ->type_name("N")
      ->group("Lights")
      ->capture_default_str();
  command.add_option("--spots", r.spots, "part of the generated lights that are spots, 0 to 1")
      ->check(number_between(0.0, 1.0))
      ->each(note("--spots"))
      ->type_name("PART")
      ->group("Lights")
      ->capture_default_str();
  command
      .add_option("--still", r.still,
                  "part of the generated lights that stand still in a flight, 0 to 1; lights of the scene do anyway")
      ->check(number_between(0.0, 1.0))
      ->each(note("--still"))
      ->type_name("PART")
      ->group("Lights")
      ->capture_default_str();
  command
      .add_option("--range", r.range,
                  "range of the generated lights in metres, MIN:MAX or one number; inf: they have none and reach "
                  "everything; default: such that about 24 of them reach a point")
      ->each(note("--range"))
      ->type_name("MIN:MAX")
      ->group("Lights");
  command
      .add_option("--seed", r.seed,
                  "seed of the generated lights, decals and probes; the same seed gives the same picture")
      ->check(whole_number(0, std::numeric_limits<std::uint64_t>::max()))
      ->each(note("--seed"))
      ->type_name("N")
      ->group("Lights")
      ->capture_default_str();
}

void add_picture_shape_options(CLI::App& command, Request& r) {
  command.add_option("--size", r.size, "size of the picture in pixels; a capture has its own")
      ->each([&r](const std::string&) { r.size_given = true; })
      ->type_name("WIDTHxHEIGHT")
      ->group("View")
      ->capture_default_str();
  command
      .add_option("--projection", r.projection,
                  "camera (as the scene's camera has it), perspective, infinite, orthographic or off-centre")
      ->type_name("NAME")
      ->group("View")
      ->capture_default_str();
}

void add_camera_options(CLI::App& command, Request& r) {
  command.add_option("--camera", r.camera, "camera of the scene (lamp info SCENE names them); default: its first")
      ->type_name("NAME")
      ->group("View");
  command
      .add_option("--frame", r.frame,
                  "frame of the scene's camera flight, from 0, instead of a camera; the generated lights move with it")
      ->check(whole_number(0, std::numeric_limits<int>::max()))
      ->type_name("N")
      ->group("View");
}

void add_device_options(CLI::App& command, Request& r) {
  command.add_option("--device", r.device, "Vulkan device: its number, or a part of its name (lamp list devices)")
      ->type_name("NAME")
      ->group("Device");
  command
      .add_option("--shader-dir", r.shader_dir,
                  "checkout of Lamplight: its shaders are compiled with glslc and used instead of the built-in ones")
      ->type_name("FOLDER")
      ->group("Device");
}

}  // namespace

void check_one_method(std::size_t methods, std::span<const std::string> options) {
  if (methods != 1 && !options.empty())
    throw Error("--option: belongs to one method; name that one, and no other, with --method");
}

void add_common_options(CLI::App& command, Request& r) {
  add_scene_options(command, r);
  add_picture_shape_options(command, r);
}

void add_scene_options(CLI::App& command, Request& r) {
  command
      .add_option("scene,--scene", r.scene,
                  "a built-in scene (lamp list scenes), a .gltf or .glb file, or the folder of a capture")
      ->type_name("SCENE")
      ->capture_default_str();
  command.add_flag_callback("-q,--quiet", hide_progress, "show no progress on the terminal");
  add_camera_options(command, r);
  add_light_options(command, r);
  add_device_options(command, r);
}

void add_method_option(CLI::App& command, std::vector<std::string>& methods, const std::string& help) {
  command
      .add_option("--method", methods, help + " (lamp list methods), or auto; may be repeated; default: all methods")
      ->allow_extra_args(false)
      ->type_name("NAME")
      ->group("Method");
}

void add_picture_options(CLI::App& command, Request& r) {
  command
      .add_option("--method", r.method, "culling method (lamp list methods), or auto: the one expected to be fastest")
      ->type_name("NAME")
      ->group("Method")
      ->capture_default_str();
  add_option_option(command, r);
  add_path_option(command, r);
  add_grow_option(command, r);
  add_auto_options(command, r);
  add_decal_option(command, r);
  add_probe_options(command, r);
  add_still_options(command, r);
  add_still_bytes_option(command, r);
  add_shadow_options(command, r);
  add_mirror_options(command, r);
  add_moving_flag(command, r);
}

void add_option_option(CLI::App& command, Request& r) {
  command
      .add_option("--option", r.options,
                  "an option of the method (lamp list methods NAME shows them); may be repeated, once for each key")
      ->allow_extra_args(false)
      ->type_name("KEY=VALUE")
      ->group("Method");
}

void add_depth_options(CLI::App& command, Request& r) {
  command
      .add_option(
          "--depth", r.depth,
          "which way depth runs: reversed (near 1, sky 0), or standard (near 0, sky 1); a capture's is reversed")
      ->type_name("NAME")
      ->group("View")
      ->capture_default_str();
  command
      .add_option("--depth-samples", r.depth_samples,
                  "samples a pixel of the depth that lights are culled with, 1, 2, 4 or 8; each is shaded")
      ->check(whole_number(1, 8))
      ->type_name("N")
      ->group("View")
      ->capture_default_str();
}

void add_stereo_option(CLI::App& command, Request& r) {
  command
      .add_option(
          "--stereo", r.stereo_m,
          "two eyes, so many metres apart (people's: 0.064), each in its half of the picture; lights are culled "
          "for both at once; 0: one eye")
      ->check(number_between(0.0, 1000.0))
      ->type_name("METRES")
      ->group("View");
}

void add_brdf_option(CLI::App& command, Request& r) {
  command.add_option("--brdf", r.brdf, "how surfaces reflect: ggx or blinn-phong")
      ->type_name("NAME")
      ->group("View")
      ->capture_default_str();
}

void add_path_option(CLI::App& command, Request& r) {
  add_brdf_option(command, r);
  command.add_option("--path", r.path, "how pixels are shaded: forward, tiled-deferred, deferred or standard-deferred")
      ->type_name("NAME")
      ->group("Method")
      ->capture_default_str();
}

void add_grow_option(CLI::App& command, Request& r) {
  command.add_flag("--grow", r.grow, "enlarge lists until every light fits, and say which options that took")
      ->group("Method");
}

void add_auto_options(CLI::App& command, Request& r) {
  command.add_flag("--explain", r.explain, "print how long auto expects each method to take, and why it chose one")
      ->group("Method");
  command
      .add_option("--calibration", r.calibration,
                  "file of measured costs for auto, or measure: measure them now; default: measured once for each GPU "
                  "and kept in the user's cache folder")
      ->envname(CALIBRATION_VARIABLE)
      ->type_name("FILE")
      ->group("Method");
}

void add_decal_option(CLI::App& command, Request& r) {
  command
      .add_option("--decals", r.decals,
                  "number of box decals: the scene's own first, then generated ones; a capture shows those that it was "
                  "taken with")
      ->check(whole_number(0, MAX_BOXES))
      ->type_name("N")
      ->group("Lights")
      ->capture_default_str();
}

CLI::Option& add_out_option(CLI::App& command, std::string& out, const std::string& help) {
  return *command.add_option("-o,--out", out, help)->type_name("FILE")->group("Output")->capture_default_str();
}

void add_statistics_flag(CLI::App& command, Request& r) {
  command
      .add_flag("--pipeline-statistics", r.pipeline_statistics,
                "add what the driver says of each pass, such as its registers, to the numbers; few drivers say it")
      ->group("Device");
}

void add_json_flag(CLI::App& command, bool& json, const std::string& help) {
  command.add_flag("--json", json, help)->group("Output");
}

void add_verifier_option(CLI::App& command, std::string& verifier) {
  command
      .add_option("--verifier", verifier,
                  fmt::format("what finds the lights that reach each pixel: oracle (on the CPU), gpu, or auto: the "
                              "oracle up to {} billion pairs of pixel and light",
                              ORACLE_PAIRS / 1'000'000'000))
      ->check([](const std::string& text) { return one_of(text, verifier_names()); })
      ->type_name("NAME")
      ->group("Method")
      ->capture_default_str();
}

}  // namespace lamp::app
