// Compute and graphics pipelines with one descriptor set, pushed or not, from SPIR-V and plain descriptions.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "lamplight/export.h"
#include "lamplight/vulkan/device.h"
#include "lamplight/vulkan/owned.h"
#include "lamplight/vulkan/pipeline_statistics.h"

namespace lamp::vulkan {

struct DescriptorBinding {
  std::uint32_t binding = 0;
  VkDescriptorType type = VK_DESCRIPTOR_TYPE_STORAGE_BUFFER;
};

struct Constant {
  std::uint32_t id = 0;
  std::uint32_t value = 0;
};

/// What every pipeline has.
struct PipelineInfo {
  std::string name;
  std::vector<Constant> constants;
  std::vector<DescriptorBinding> bindings;  ///< of set 0, all stages
  std::uint32_t push_constant_bytes = 0;    ///< all stages
  bool full_subgroups = false;              ///< compute: required; threads in x are a multiple of the largest subgroup
};

/// The fixed state that Lamplight's graphics passes differ in.
struct GraphicsState {
  std::vector<VkVertexInputAttributeDescription> attributes;  ///< of one interleaved vertex buffer, binding 0
  std::uint32_t vertex_bytes = 0;
  VkCullModeFlags cull = VK_CULL_MODE_NONE;  ///< front faces are counter-clockwise
  bool dynamic_cull = false;                 ///< cull mode set while recording
  std::uint32_t viewports = 1;               ///< and scissors, all set while recording
  VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
  VkSampleMask sample_mask = ~0U;  ///< of the first 32: which of them are written
  std::vector<VkFormat> colors;
  VkFormat depth = VK_FORMAT_UNDEFINED;
  bool depth_write = false;
  bool depth_clamp = false;
  bool conservative = false;  ///< every pixel that a triangle touches
  VkCompareOp depth_compare = VK_COMPARE_OP_ALWAYS;
  enum class Blend : std::uint8_t { none, add, over } blend = Blend::none;  ///< of every colour attachment
};

/// Copies share one pipeline, which lives as long as the last of them.
class LAMPLIGHT_API Pipeline {
 public:
  Pipeline() = default;
  [[nodiscard]] static Result<Pipeline> compute(const Device& device, const PipelineInfo& info,
                                                std::span<const std::uint32_t> spirv);
  /// `fragment` may be empty: depth only.
  [[nodiscard]] static Result<Pipeline> graphics(const Device& device, const PipelineInfo& info,
                                                 std::span<const std::uint32_t> vertex,
                                                 std::span<const std::uint32_t> fragment, const GraphicsState& state);

  /// Only of a pipeline that has been made.
  [[nodiscard]] VkPipeline handle() const { return objects_->pipeline.get(); }
  [[nodiscard]] VkPipelineLayout layout() const { return objects_->layout.get(); }
  [[nodiscard]] VkDescriptorSetLayout set_layout() const { return objects_->set_layout.get(); }
  [[nodiscard]] std::span<const DescriptorBinding> bindings() const { return objects_->bindings; }
  [[nodiscard]] VkPipelineBindPoint bind_point() const { return objects_->bind_point; }
  [[nodiscard]] const std::string& name() const { return objects_->name; }
  /// What the driver says of it; empty unless the device has `pipeline_statistics`, or of no pipeline.
  [[nodiscard]] std::span<const PipelineStatistic> statistics() const {
    return objects_ ? std::span(objects_->statistics) : std::span<const PipelineStatistic>();
  }

 private:
  struct Objects {
    std::string name;
    std::vector<DescriptorBinding> bindings;
    OwnedSetLayout set_layout;
    OwnedPipelineLayout layout;
    OwnedPipeline pipeline;
    VkPipelineBindPoint bind_point = VK_PIPELINE_BIND_POINT_COMPUTE;
    std::vector<PipelineStatistic> statistics;
  };
  explicit Pipeline(Objects objects) : objects_(std::make_shared<const Objects>(std::move(objects))) {}
  [[nodiscard]] static std::optional<Error> make_layout(const Device& device, const PipelineInfo& info, Objects& out);
  [[nodiscard]] static Result<Pipeline> make_compute(const Device& device, const PipelineInfo& info,
                                                     std::span<const std::uint32_t> spirv);
  [[nodiscard]] static Result<Pipeline> make_graphics(const Device& device, const PipelineInfo& info,
                                                      std::span<const std::uint32_t> vertex,
                                                      std::span<const std::uint32_t> fragment,
                                                      const GraphicsState& state);

  std::shared_ptr<const Objects> objects_;
};

/// Keeps the pipelines of a device (`Device::pipelines`), so that the same code with the same constants and state is
/// compiled once, whoever asks: other methods with the same passes, a plan that is made anew for more lights.
/// Destroy it before the device. Safe to use from several threads.
class LAMPLIGHT_API PipelineStore {
 public:
  /// The pipeline of that description, made if there is none. Who asks for one that is being made waits for it. An
  /// error is not kept.
  [[nodiscard]] Result<Pipeline> find_or_make(const std::string& description,
                                              const std::function<Result<Pipeline>()>& make);
  /// How many there are.
  [[nodiscard]] std::size_t size() const;

 private:
  mutable std::mutex mutex_;
  std::condition_variable done_;
  std::map<std::string, std::optional<Pipeline>, std::less<>> pipelines_;  ///< nothing: being made
};

}  // namespace lamp::vulkan
