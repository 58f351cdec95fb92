// The words that options take: paths, BRDFs, depths, verifiers, methods.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "commands/command_line.h"
#include "commands/request.h"
#include "gpu/check.h"

namespace lamp::app {

ShadingPath parse_path(const std::string& text) {
  return static_cast<ShadingPath>(parse_name("--path", text, path_names()));
}

std::span<const std::string_view> brdf_names() {
  static constexpr std::array<std::string_view, 2> NAMES{"ggx", "blinn-phong"};
  return NAMES;
}

Brdf parse_brdf(const std::string& text) {
  return parse_name("--brdf", text, brdf_names()) == 0 ? Brdf::ggx : Brdf::blinn_phong;
}

std::span<const std::string_view> verifier_names() {
  static constexpr std::array<std::string_view, 3> NAMES{"oracle", "gpu", "auto"};
  return NAMES;
}

std::span<const std::string_view> depth_names() {
  static constexpr std::array<std::string_view, 2> NAMES{"reversed", "standard"};
  return NAMES;
}

HostDepth parse_depth(const std::string& text, std::uint32_t samples) {
  const bool reversed = parse_name("--depth", text, depth_names()) == 0;
  constexpr std::array<std::uint32_t, 4> COUNTS{1, 2, 4, 8};
  if (std::ranges::find(COUNTS, samples) == COUNTS.end())
    throw Error(fmt::format("--depth-samples {}: expected 1, 2, 4 or 8", samples));
  return {.samples = samples, .reversed = reversed};
}

VerifierChoice parse_verifier(const std::string& text, const Context& context) {
  if (text == "oracle") return VerifierChoice::oracle;
  if (text == "auto") return context.has_doubles() ? VerifierChoice::by_pairs : VerifierChoice::oracle;
  if (!context.has_doubles())
    throw Error(
        fmt::format("--verifier gpu: device {} lacks the feature shaderFloat64; expected oracle", context.row().name),
        Exit::no_device);
  return VerifierChoice::gpu;
}

std::uint64_t brute_force_pairs(const Context& context) {
  return context.row().kind == "CPU" ? 3'000'000'000 : 200'000'000'000;
}

std::uint64_t brute_force_lights(const Context& context) {
  const Problem problem{.width = 1, .height = 1, .traits = context.device().traits};
  return take(make_plan(parse_method("all"), problem)).lookup.most_walked;
}

const Method& parse_method(const std::string& text) { return *take(find_method(text)); }

MethodWord parse_method_word(const std::string& text) {
  const std::size_t colon = text.find(':');
  MethodWord word{.method = text.substr(0, colon), .options = {}};
  if (colon == std::string::npos) return word;
  if (is_auto(word.method))
    throw Error(fmt::format("method '{}': auto chooses its own options, expected auto alone", text));
  for (std::size_t begin = colon + 1; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    word.options.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return word;
}

bool is_auto(std::string_view method) { return method == "auto"; }

std::string with_options_named(std::string_view error, const std::function<std::string(std::string_view)>& name) {
  constexpr std::string_view OF_NAMES = "-abcdefghijklmnopqrstuvwxyz";
  std::string words;
  for (std::size_t i = 0; i < error.size();) {
    const bool begins = i == 0 || error[i - 1] == ' ';
    const std::string_view rest = error.substr(i);
    if (begins && rest.starts_with("--") && rest.find_first_of(OF_NAMES.substr(1)) == 2) {
      const std::size_t end = std::min(error.find_first_not_of(OF_NAMES, i), error.size());
      words += name(error.substr(i + 2, end - i - 2));
      i = end;
    } else {
      words += error[i++];
    }
  }
  return words;
}

void check_once(std::string_view option, std::vector<std::string> values) {
  std::ranges::sort(values);
  if (const auto twice = std::ranges::adjacent_find(values); twice != values.end())
    throw Error(fmt::format("{} {}: is given twice, expected once", option, *twice));
}

}  // namespace lamp::app
