// Command buffers that are recorded now and submitted later, or never.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <functional>

#include "gpu/gpu_test.h"

namespace lamp::app {

class Commands {
 public:
  explicit Commands(const std::function<void(VkCommandBuffer)>& record);

  /// Behind what was submitted before.
  void submit();
  /// Until they are done.
  void wait() const;

 private:
  vulkan::OwnedCommandPool pool_;
  vulkan::OwnedFence fence_;
  VkCommandBuffer commands_ = VK_NULL_HANDLE;
};

}  // namespace lamp::app
