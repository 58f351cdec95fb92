// What a bench keeps over its groups: the device with its compiled pipelines, and the scene that was used last.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench/groups.h"
#include "commands/auto_method.h"
#include "commands/request.h"
#include "scene/open_air.h"

namespace lamp::app {

/// A scene with what is made from it once.
struct BenchScene {
  Scene scene;
  std::optional<OpenAir> air;
  std::unique_ptr<GpuScene> gpu;
  std::vector<gpu::DecalData> decals;  ///< of the group that it was asked for last
  std::vector<gpu::ProbeData> probes;  ///< likewise

  /// How many of both there are.
  [[nodiscard]] std::size_t boxes() const { return decals.size() + probes.size(); }
};

class BenchDevice {
 public:
  explicit BenchDevice(const Request& request);

  /// Loads a scene unless it is the last one's, with the group's decals and probes.
  [[nodiscard]] BenchScene& scene(const Group& group);
  [[nodiscard]] Context& context() { return *context_; }
  [[nodiscard]] const ShaderLibrary& shaders() const { return shaders_; }
  [[nodiscard]] AutoMethod& chooser() { return chooser_; }
  [[nodiscard]] bool software() const { return context_->software(); }

 private:
  void place_boxes(const Group& group);

  ShaderLibrary shaders_;
  std::unique_ptr<Context> context_;
  AutoMethod chooser_;
  std::string scene_name_;
  std::string boxes_name_;
  BenchScene scene_;
};

/// Cameras and lights of one timed frame.
struct BenchFrame {
  std::uint32_t number = 0;  ///< from 0
  std::vector<View> views;

  [[nodiscard]] const View& view() const { return views.front(); }
  std::vector<shared::Light> lights;
  std::uint32_t still = 0;  ///< how many of them stand still, the last ones
  std::span<const gpu::DecalData> decals;
};
/// Looks at scenes before any work, one group after the other.
class SceneCheck {
 public:
  /// Throws Error for a scene, camera, flight or projection that is not there, and for what a captured frame cannot
  /// have. Fills in the hash of the scene's files.
  void check(Group& group);

 private:
  std::optional<std::string> name_;  ///< of the scene that was loaded last
  Scene scene_;
  std::string hash_;
};

[[nodiscard]] BenchFrame bench_frame(BenchScene& scene, const Group& group, std::uint32_t number);

/// The most lights that a frame of the group has, the scene's own included.
[[nodiscard]] std::uint32_t light_capacity(const BenchScene& scene, const Group& group);

/// How many of them stand still.
[[nodiscard]] std::uint32_t standing_lights(const BenchScene& scene, const Group& group);

/// Depth and views as the group has them.
[[nodiscard]] HostDepth host_depth_of(const Group& group);
/// Nothing: lights cast none.
[[nodiscard]] std::optional<ShadowSettings> shadows_of(const Group& group, const Scene& scene);
/// Mirrored light, whose look-ups have a time of their own.
[[nodiscard]] std::optional<MirrorSettings> mirror_of(const Group& group, const Scene& scene);

/// The request of one group's entry, for the checks that every command makes.
[[nodiscard]] Request request_of(const Group& group, const GroupEntry& entry);

}  // namespace lamp::app
