// From library results and Vulkan results to the tools' one exception.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <fmt/format.h>

#include <utility>

#include "error.h"
#include "lamplight/vulkan.h"

namespace lamp::app {

/// The value, or its error thrown.
template <class T>
[[nodiscard]] T take(Result<T> result, Exit exit = Exit::bad_input) {
  if (!result) throw Error(result.error(), exit);
  return std::move(result.value());
}

inline void check(VkResult result, const char* what) {
  if (result != VK_SUCCESS) throw Error(fmt::format("{}: {}", what, vulkan::result_text(result)), Exit::no_device);
}

}  // namespace lamp::app
