// What the host says of a frame, held against the plan before anything is recorded.
// Promise: in every build; what passes cannot make a shader or a copy go beyond a buffer of the plan.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>

#include "lamplight/vulkan/plan_runner.h"

namespace lamp::vulkan {
namespace {

std::string size_text(std::uint32_t width, std::uint32_t height) {
  return std::to_string(width) + "x" + std::to_string(height);
}

std::optional<Error> check_count(const char* element, std::uint32_t count, std::uint32_t most, const char* which) {
  if (count <= most) return std::nullopt;
  return Error{element, "expected at most " + std::to_string(most) + ", " + which + ", got " + std::to_string(count)};
}

std::optional<Error> check_record(const Plan& plan, const shared::Frame& frame) {
  if (frame.size_px != glm::uvec2(plan.width, plan.height))
    return Error{"size " + size_text(frame.size_px.x, frame.size_px.y),
                 "expected " + size_text(plan.width, plan.height) + " pixels, which the plan was made for"};
  const char* capacity = "the capacity that the plan was made for";
  if (auto error = check_count("light count", frame.light_count, plan.light_capacity, capacity)) return error;
  if (auto error = check_count("light capacity of the frame", frame.light_capacity, plan.light_capacity, capacity))
    return error;
  if (auto error = check_count("light count", frame.light_count, frame.light_capacity, "the capacity of the frame"))
    return error;
  return check_count("box count", frame.box_count, frame.light_count, "the light count");
}

std::optional<Error> check_buffer(const char* element, VkBuffer buffer) {
  if (buffer != VK_NULL_HANDLE) return std::nullopt;
  return Error{element, "expected a buffer, which the method reads, got none"};
}

std::optional<Error> check_depth(const Resource& depth) {
  if (depth.image == VK_NULL_HANDLE) return Error{"depth image", "expected an image, which the method reads, got none"};
  if (depth.view == VK_NULL_HANDLE) return Error{"depth view", "expected a view of the depth image, got none"};
  if (depth.layout == VK_IMAGE_LAYOUT_UNDEFINED)
    return Error{"depth layout", "expected the layout that the image is in, got VK_IMAGE_LAYOUT_UNDEFINED"};
  return std::nullopt;
}

bool has_host_pass(const std::vector<Pass>& passes) {
  return std::ranges::find(passes, PassKind::host, &Pass::kind) != passes.end();
}

}  // namespace

std::optional<Error> PlanRunner::check(const PlanInputs& inputs) const {
  if (inputs.host_frame == nullptr) return Error{"host frame", "expected the frame's record, got none"};
  if (auto error = check_record(plan_, *inputs.host_frame)) return error;
  if (auto error = check_buffer("frame", inputs.frame)) return error;
  if (plan_.binds(INPUT_LIGHTS))
    if (auto error = check_buffer("lights", inputs.lights)) return error;
  if (plan_.binds(INPUT_SPHERES))
    if (auto error = check_buffer("spheres", inputs.spheres)) return error;
  if (plan_.binds(INPUT_DEPTH))
    if (auto error = check_depth(inputs.depth)) return error;
  if (inputs.slot >= plan_.frames_in_flight)
    return Error{"slot", "expected less than " + std::to_string(plan_.frames_in_flight) +
                             ", the frames in flight that the plan was made for, got " + std::to_string(inputs.slot)};
  const bool on_host = has_host_pass(plan_.passes) || (plan_.fused && has_host_pass(plan_.fused->passes));
  if (on_host && inputs.host_lights.size() < inputs.host_frame->light_count)
    return Error{"host lights", "expected " + std::to_string(inputs.host_frame->light_count) +
                                    ", as many as there are lights, since options of the method work on the CPU; got " +
                                    std::to_string(inputs.host_lights.size())};
  return std::nullopt;
}

}  // namespace lamp::vulkan
