// `--method auto`: the method and options for a frame, by the device's calibration; and the words of `--explain`.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "commands/calibration.h"
#include "commands/request.h"

namespace lamp::app {

/// A method of the table with its options.
struct MethodChoice {
  const Method* method = nullptr;
  std::vector<std::string> options;  ///< KEY=VALUE
  bool by_auto = false;
};

/// "tiled", "lamplight cells=gather": the method, and its options.
[[nodiscard]] std::string method_words(const MethodChoice& chosen);

/// A frame that a method is to be chosen for.
struct AutoFrame {
  const Scene& scene;
  const View& view;
  std::span<const shared::Light> lights;
  std::uint32_t light_capacity = 0;
  std::uint32_t boxes = 0;  ///< decals and probes, besides
};

/// Chooses for frame after frame; finds the calibration when it is first needed.
class AutoMethod {
 public:
  /// `calibration`: a file, or empty.
  AutoMethod(Context& context, const ShaderLibrary& shaders, std::string calibration)
      : context_(context), shaders_(shaders), file_(std::move(calibration)) {}

  /// The renderer's frame must be set; draws its surfaces, unless they were captured, to know their depth.
  [[nodiscard]] MethodChoice choose(Renderer& renderer, const AutoFrame& frame);

  /// What it goes by.
  [[nodiscard]] const Calibration& calibration() { return known().calibration; }

  /// What was predicted for the last choice: workload, candidates, which and why, and by what calibration.
  [[nodiscard]] const std::string& explanation() const { return explanation_; }

 private:
  const KnownCalibration& known();

  Context& context_;
  const ShaderLibrary& shaders_;
  std::string file_;
  std::optional<KnownCalibration> known_;
  std::string explanation_;
};

/// What a command lights its frame with: the named method with the request's options, or what `auto` chooses. With
/// `--explain`, says what is predicted: on stdout, or on stderr where that holds JSON.
[[nodiscard]] std::vector<MethodChoice> chosen_methods(Session& session, const Setup& setup, const Request& request,
                                                       std::span<const std::string> names, bool json);

}  // namespace lamp::app
