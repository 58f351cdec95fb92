// How many lights there are, said by a buffer that only the GPU reads: the same as if the host had said so.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "gpu/engine_frame.h"

namespace lamp::app {
namespace {

/// Half the lights of the frame: those beyond are the second word of a mask.
constexpr std::uint32_t CAPACITY = 32;

class GpuCount : public GpuTest {
 protected:
  /// The count lies behind another word.
  Masks masks_of_gpu_count(vulkan::Culler& culler, std::uint32_t count) const {
    const vulkan::Buffer counts = host_buffer_of<std::uint32_t>("counts", {7, count});
    vulkan::CullerFrame told = culler_frame(frame_);
    told.light_count = 0;
    told.light_count_buffer = counts.handle();
    told.light_count_offset = 4;
    return cull_and_walk(culler, frame_, told);
  }

  Masks masks_of_host_count(vulkan::Culler& culler, std::uint32_t count) const {
    vulkan::CullerFrame told = culler_frame(frame_);
    told.light_count = count;
    return cull_and_walk(culler, frame_, told);
  }

  static vulkan::Culler make_culler(std::string_view method, std::vector<std::string> options = {}) {
    return take(vulkan::Culler::create(test_context().device(), {.width = ENGINE_WIDTH,
                                                                 .height = ENGINE_HEIGHT,
                                                                 .light_capacity = CAPACITY,
                                                                 .method = std::string(method),
                                                                 .options = std::move(options)}));
  }

  void expect_same_as_host_count(vulkan::Culler& culler) const {
    for (const std::uint32_t count : {0U, 1U, CAPACITY, CAPACITY + 1, ~0U}) {
      SCOPED_TRACE(count);
      const std::uint32_t taken = std::min(count, CAPACITY);
      const Masks masks = masks_of_gpu_count(culler, count);
      EXPECT_EQ(culler.counters().excess_lights, count - taken);
      EXPECT_EQ(masks, masks_of_host_count(culler, taken));
      EXPECT_EQ(culler.counters().excess_lights, 0);
      EXPECT_EQ(walked(masks) > 0, count > 0);
    }
  }

  EngineFrame frame_ = engine_frame();
};

TEST_F(GpuCount, IsTheHostsCountForEveryMethod) {
  for (const Method& method : methods()) {
    SCOPED_TRACE(method.name);
    vulkan::Culler culler = make_culler(method.name);
    expect_same_as_host_count(culler);
  }
  for (const std::vector<std::string>& options : {std::vector<std::string>{"cells=list"},
                                                  {"cells=bits"},
                                                  {"depth=none", "cells=list"},
                                                  {"depth=none", "cells=bits", "container=bits"}}) {
    SCOPED_TRACE(fmt::format("lamplight {}", fmt::join(options, " ")));
    vulkan::Culler culler = make_culler("lamplight", options);
    expect_same_as_host_count(culler);
  }
}

}  // namespace
}  // namespace lamp::app
