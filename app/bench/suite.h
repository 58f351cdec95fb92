// A suite: what to measure, as data. Series of sweeps that expand to groups; a group's entries see the same frames.
// The format is described in docs/bench.md.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "bench/shadow_choice.h"
#include "render/lighting_pipelines.h"
#include "render/verification.h"

namespace lamp::app {

/// A method as a series measures it.
struct SuiteMethod {
  std::string name;
  std::vector<std::string> options;  ///< KEY=VALUE
  std::string label;                 ///< in charts and tables
  std::string path;                  ///< empty: each of the series'
  Host host = Host::plan;
  std::string still_lists = "off";    ///< what lights that stand still are looked up in, as `--still-lists`
  std::uint32_t still_occlusion = 0;  ///< as `--still-occlusion`
  double still_bytes = 16.0;          ///< as `--still-bytes`
};

/// How many lights a frame of a flight has: from + (to - from) t², with t going 0 → 1 → 0 `waves` times over the
/// flight. The square gives few lights, where methods cross, more frames.
struct LightWave {
  std::uint32_t from = 0;
  std::uint32_t to = 0;
  std::uint32_t waves = 1;
};

/// What of a picture is checked against the oracle and brute force, once for every group.
struct Verify {
  enum class What : std::uint8_t { picture, rows, nothing } what = What::picture;
  std::uint32_t rows = 0;         ///< What::rows: so many in the middle of the picture
  bool compares_pictures = true;  ///< false: lists alone; brute force would take too long
  bool every_list = false;        ///< the lists of every row, whatever `rows` says
  Verifier verifier = Verifier::oracle;
};

/// How a series wants to be drawn.
struct Chart {
  std::string x = "lights";      ///< a parameter, `method` or `option:KEY`
  std::string y = "cull+shade";  ///< a value of chart_values()
  bool log_x = true;
  bool log_y = false;
};
[[nodiscard]] std::span<const std::string_view> chart_values();

struct Series {
  std::string name, title, about;
  Chart chart;
  std::vector<SuiteMethod> methods;
  std::vector<std::pair<std::string, std::vector<std::string>>> options;  ///< swept for every method
  std::vector<std::string> scenes{"atrium"};
  std::vector<std::string> sizes{"1280x720"};
  std::vector<std::uint32_t> lights{4096};
  std::vector<double> spots{0.5};
  std::vector<std::uint32_t> decals{0};
  std::vector<std::uint32_t> probes{0};  ///< reflection probes, a colour each
  double still = 0.0;                    ///< part of the generated lights that stand still; the scene's own do then too
  std::vector<std::string> ranges{""};
  std::vector<std::string> cameras{""};
  std::vector<std::string> projections{"camera"};
  std::vector<std::string> paths{"deferred"};
  std::string brdf = "ggx";
  std::string depth = "reversed";   ///< or "standard"
  std::uint32_t depth_samples = 1;  ///< a pixel, of the depth that lights are culled with
  double stereo_m = 0.0;            ///< between two eyes, each with half of the size's width; 0: one eye
  ShadowChoice shadows;
  double mirror = 0.0;                       ///< as `--mirror`
  std::string mirror_lists = "world-cells";  ///< as `--mirror-lists`
  std::uint64_t seed = 1;
  int frame = -1;                  ///< of the scene's flight, for the camera and for when the lights begin; -1: camera
  std::uint32_t frames = 60;       ///< timed ones
  std::uint32_t warm_up = 8;       ///< frames before
  bool timed = true;               ///< false: nothing is rendered; what the plans say by themselves, above all memory
  std::optional<LightWave> flight; /**< the camera flies its whole path, with so many lights */
  Verify verify;
  bool pictures = false;  ///< picture and heat maps of the first group of each scene that has the most lights
};

/// The method's own, or each of the series'.
[[nodiscard]] std::vector<std::string> paths_of(const Series& series, const SuiteMethod& method);

/// More configurations than a device measures in a day.
inline constexpr std::size_t MOST_CONFIGURATIONS = 65536;

struct Suite {
  std::string name, title, about, source;
  std::vector<Series> series;
};

/// The names of the built-in suites.
[[nodiscard]] std::vector<std::string> suite_names();

/// Parses a suite. `source` names it in errors. Throws Error for what is no suite: the file, the series, the key,
/// what was expected.
[[nodiscard]] Suite parse_suite(std::string_view text, const std::string& source);

/// A built-in suite, or that of a .json file. Throws Error with the nearest names.
[[nodiscard]] Suite load_suite(const std::string& name);
/// Whether a name is meant as a suite: a built-in one's, or a .json file.
[[nodiscard]] bool is_suite(const std::string& name);

/// The suite of a command line that names a scene.
[[nodiscard]] Suite scene_suite(Series series);

}  // namespace lamp::app
