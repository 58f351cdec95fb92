// The tools' own Vulkan: instance, the best device, one queue, one-time command buffers, validation messages.
// Promise: headless; a GPU if there is one, else a software device; the same object works for both.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lamplight/vulkan.h"

namespace lamp::app {

struct DeviceRow {
  std::string name;
  std::string kind;     ///< "discrete GPU", "integrated GPU", "virtual GPU", "CPU", "other"
  std::string driver;   ///< name and version
  std::string problem;  ///< why it cannot be used, or empty
};

[[nodiscard]] bool has_extension(VkPhysicalDevice physical, std::string_view name);

/// What `--device` may name: a row's number, or a part of its name.
[[nodiscard]] std::vector<DeviceRow> list_devices();

struct ContextInfo {
  std::string device;                                              ///< empty: the best
  enum class Validation { off, on } validation = Validation::off;  ///< core and synchronization validation
  bool push_descriptors = true;                      ///< where the device has them; else descriptors lie in sets
  std::span<const char* const> instance_extensions;  ///< besides what is always enabled: a window's
  std::span<const char* const> device_extensions;    ///< likewise
  bool pipeline_statistics = false;  ///< pipelines that the driver can describe, if it can; they may compile slowly
};

class Context {
 public:
  /// Throws Error with Exit::no_device and one line that says what is missing.
  explicit Context(const ContextInfo& info = {});
  ~Context();
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

  [[nodiscard]] const vulkan::Instance& instance() const { return instance_; }
  [[nodiscard]] const vulkan::Device& device() const { return device_; }
  [[nodiscard]] const DeviceRow& row() const { return row_; }
  /// Whether shaders may compute in double precision.
  [[nodiscard]] bool has_doubles() const { return doubles_; }
  [[nodiscard]] bool has_buffer_addresses() const { return addresses_; }
  /// A device that is the processor under another name, as Mesa's llvmpipe.
  [[nodiscard]] bool software() const { return row_.kind == "CPU"; }

  /// For whoever submits by itself, as several frames ahead are.
  [[nodiscard]] VkQueue queue() const { return queue_; }
  [[nodiscard]] std::uint32_t queue_family() const { return queue_family_; }
  /// Held by whoever uses the queue while another thread may; `submit` holds it.
  [[nodiscard]] std::mutex& queue_mutex() { return queue_mutex_; }

  /// Records, submits and waits. Throws Error when there is no memory for what it binds.
  void submit(const std::function<void(VkCommandBuffer)>& record);

  /// Milliseconds since the last submission was done, or since the device was made.
  [[nodiscard]] double idle_ms() const;

  /// Validation messages since the last call (warnings and errors).
  [[nodiscard]] std::vector<std::string> take_messages();

 private:
  struct Messages;
  void create_messenger();
  void create_device(const ContextInfo& info);
  /// What `submit` needs: a driver that only compiles has no fences.
  void create_submission();

  std::unique_ptr<Messages> messages_;
  vulkan::Instance instance_;
  VkDebugUtilsMessengerEXT messenger_ = VK_NULL_HANDLE;
  VkPhysicalDevice physical_ = VK_NULL_HANDLE;
  VkDevice handle_ = VK_NULL_HANDLE;
  VkQueue queue_ = VK_NULL_HANDLE;
  std::mutex queue_mutex_;
  std::uint32_t queue_family_ = 0;
  VkCommandPool pool_ = VK_NULL_HANDLE;
  VkFence fence_ = VK_NULL_HANDLE;
  std::unique_ptr<vulkan::PipelineStore> pipelines_;
  std::unique_ptr<vulkan::DescriptorSets> sets_;  ///< of the submission that is being recorded
  vulkan::Device device_;
  DeviceRow row_;
  bool doubles_ = false;
  bool addresses_ = false;
  std::chrono::steady_clock::time_point last_done_ = std::chrono::steady_clock::now();
};

}  // namespace lamp::app
