// Runs small hand-made plans of test shaders, and reads their buffers.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <vector>

#include "gpu/dispatch.h"
#include "lamplight/view.h"

namespace lamp::app {

/// SPIR-V of the tests' own shaders. (`plan_check` would refuse them: plans name shaders of the library.)
[[nodiscard]] vulkan::ShaderSource test_shader_source();

/// A compute pass over every word of buffers of `words` words, for shaders with 64 threads a group.
[[nodiscard]] Pass words_pass(const char* shader, std::vector<std::uint32_t> constants, std::vector<Binding> bindings,
                              std::uint32_t words);

/// A plan and what it runs with. Frames share a tracker, as an application's do.
class PlanHarness {
 public:
  explicit PlanHarness(Plan plan, const std::vector<Light>& lights = {},
                       const vulkan::ShaderSource& shaders = test_shader_source());

  /// Records and submits a frame, waits, and returns each buffer's words.
  [[nodiscard]] std::vector<std::vector<std::uint32_t>> run();

  /// Before `run`, and with a light buffer large enough for all that follow.
  void set_lights(const std::vector<Light>& lights);
  void set_view(const View& view) { view_ = view; }
  /// From now on, passes of one part share a time.
  void time_parts(vulkan::Timestamps::PartOf part_of) { part_of_ = std::move(part_of); }
  [[nodiscard]] const std::vector<vulkan::Timestamps::Time>& times() const { return times_; }
  [[nodiscard]] const vulkan::PlanRunner& runner() const { return runner_; }
  /// The device that records; tests may take features from it.
  vulkan::Device device;

 private:
  void read_back(vulkan::Recorder& recorder, const std::vector<vulkan::Buffer>& copies) const;

  vulkan::PlanRunner runner_;
  vulkan::AccessTracker tracker_;
  vulkan::Timestamps timestamps_;
  vulkan::Buffer frame_;
  vulkan::Buffer light_buffer_;
  vulkan::Buffer sphere_buffer_;
  std::optional<View> view_;
  std::vector<shared::Light> lights_;
  vulkan::Timestamps::PartOf part_of_;
  std::vector<vulkan::Timestamps::Time> times_;
};

}  // namespace lamp::app
