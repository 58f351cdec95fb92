// What the host says of a frame, held against the plan before anything is recorded.
// Promise: in every build; what passes cannot make a shader or a copy go beyond a buffer of the plan.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <string>

#include "lamplight/shared/light_mesh.h"
#include "lamplight/shared/radial.h"
#include "lamplight/shared/world_tree.h"
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
  const auto fits = [](std::uint32_t side, std::uint32_t most) { return side >= 1 && side <= most; };
  if (!fits(frame.size_px.x, plan.width) || !fits(frame.size_px.y, plan.height))
    return Error{"size " + size_text(frame.size_px.x, frame.size_px.y),
                 "expected 1x1 to " + size_text(plan.width, plan.height) + " pixels, which the plan was made for"};
  const char* capacity = "the capacity that the plan was made for";
  if (auto error = check_count("light count", frame.light_count, plan.light_capacity, capacity)) return error;
  if (auto error = check_count("light capacity of the frame", frame.light_capacity, plan.light_capacity, capacity))
    return error;
  if (auto error = check_count("light count", frame.light_count, frame.light_capacity, "the capacity of the frame"))
    return error;
  const std::uint32_t shift = plan.cell_shift(frame.size_px.x, frame.size_px.y);
  if (!plan.finer.empty() && frame.cell_shift != 0 && frame.cell_shift != shift)
    return Error{"cell shift", "expected " + std::string(shift == 0 ? "0" : "0 or " + std::to_string(shift)) +
                                   ", which the plan's cell_shift gives for the size, got " +
                                   std::to_string(frame.cell_shift)};
  if (auto error = check_count("box count", frame.box_count, frame.light_count, "the light count")) return error;
  return check_count("probe count", frame.probe_count, frame.box_count, "the box count");
}

std::optional<Error> check_buffer(const char* element, VkBuffer buffer) {
  if (buffer != VK_NULL_HANDLE) return std::nullopt;
  return Error{element, "expected a buffer, which the method reads, got none"};
}

/// Shaders read 16 bytes at once, and a descriptor begins where the device lets it.
std::optional<Error> check_part(const std::string& element, const BufferPart& part, std::uint64_t needed,
                                std::uint32_t device_alignment) {
  constexpr std::uint32_t UNIT = 16;
  if (auto error = check_buffer(element.c_str(), part.buffer)) return error;
  const std::uint32_t alignment = std::max(UNIT, device_alignment);
  if (part.offset % alignment != 0)
    return Error{element + " offset", "expected a multiple of " + std::to_string(alignment) + " bytes" +
                                          (alignment > UNIT ? ", this device's minStorageBufferOffsetAlignment" : "") +
                                          ", got " + std::to_string(part.offset)};
  if (part.bytes != VK_WHOLE_SIZE && (part.bytes == 0 || part.bytes < needed))
    return Error{element, "expected a part of at least " + std::to_string(std::max<std::uint64_t>(needed, 1)) +
                              " bytes for what the shaders read, got " + std::to_string(part.bytes)};
  return std::nullopt;
}

/// Later versions of Vulkan may have more that they can.
bool shaders_cannot_read(VkImageLayout layout) {
  switch (layout) {
    case VK_IMAGE_LAYOUT_UNDEFINED:
    case VK_IMAGE_LAYOUT_PREINITIALIZED:
    case VK_IMAGE_LAYOUT_TRANSFER_SRC_OPTIMAL:
    case VK_IMAGE_LAYOUT_TRANSFER_DST_OPTIMAL:
    case VK_IMAGE_LAYOUT_COLOR_ATTACHMENT_OPTIMAL:
    case VK_IMAGE_LAYOUT_DEPTH_STENCIL_ATTACHMENT_OPTIMAL:
    case VK_IMAGE_LAYOUT_DEPTH_ATTACHMENT_OPTIMAL:
    case VK_IMAGE_LAYOUT_ATTACHMENT_OPTIMAL:
    case VK_IMAGE_LAYOUT_PRESENT_SRC_KHR:
      return true;
    default:
      return false;
  }
}

std::optional<Error> check_depth(const Resource& depth) {
  if (depth.image == VK_NULL_HANDLE) return Error{"depth image", "expected an image, which the method reads, got none"};
  if (depth.view == VK_NULL_HANDLE) return Error{"depth view", "expected a view of the depth image, got none"};
  if (shaders_cannot_read(depth.layout))
    return Error{"depth layout",
                 "expected the layout that the image is in, one that shaders can read, such as "
                 "VK_IMAGE_LAYOUT_SHADER_READ_ONLY_OPTIMAL, got VkImageLayout " +
                     std::to_string(depth.layout)};
  return std::nullopt;
}

Error of_view(Error error, std::uint32_t view) {
  error.source = "view " + std::to_string(view) + ": " + error.source;
  return error;
}

/// All views see the same lights.
std::optional<Error> check_count_of_views(const shared::Frame& frame, const shared::Frame& first) {
  if (frame.light_count == first.light_count && frame.box_count == first.box_count &&
      frame.probe_count == first.probe_count)
    return std::nullopt;
  return Error{"light count", "expected " + std::to_string(first.light_count) + ", as in view 0, got " +
                                  std::to_string(frame.light_count)};
}

bool has_host_pass(const std::vector<Pass>& passes) {
  return std::ranges::find(passes, PassKind::host, &Pass::kind) != passes.end();
}

}  // namespace

std::optional<Error> PlanRunner::check_lights(const PlanInputs& inputs) const {
  const std::uint64_t count = inputs.host_frame->light_count;
  const LightLayout& layout = plan_.light_layout;
  if (plan_.binds(INPUT_LIGHTS))
    if (auto error = check_part("lights", inputs.lights, layout.light_bytes(count), offset_alignment_)) return error;
  if (plan_.binds(INPUT_CONES))
    if (auto error = check_part("cones", inputs.cones, layout.cone_bytes(count), offset_alignment_)) return error;
  if (plan_.binds(INPUT_RADIAL))
    if (auto error = check_part("radial bounds", inputs.radial, sizeof(shared::RadialBound), offset_alignment_))
      return error;
  if (plan_.binds(INPUT_MESHES))
    if (auto error = check_part("light meshes", inputs.meshes, sizeof(shared::LightMesh), offset_alignment_))
      return error;
  if (plan_.binds(INPUT_STILL) && inputs.still.buffer != VK_NULL_HANDLE)
    if (auto error =
            check_part("still lights", inputs.still, shared::TREE_HEADER * sizeof(std::uint32_t), offset_alignment_))
      return error;
  if (plan_.binds(INPUT_SPHERES))
    return check_part("spheres", inputs.spheres, count * sizeof(shared::LightSphere), offset_alignment_);
  return std::nullopt;
}

std::optional<Error> PlanRunner::check_depths(const PlanInputs& inputs) const {
  if (!plan_.binds(INPUT_DEPTH)) return std::nullopt;
  if (plan_.views == 1 && inputs.depths.empty()) return check_depth(inputs.depth);
  if (inputs.depths.size() != plan_.views)
    return Error{"depth images", "expected " + std::to_string(plan_.views) + ", one a view, got " +
                                     std::to_string(inputs.depths.size())};
  for (std::uint32_t view = 0; view < plan_.views; ++view)
    if (auto error = check_depth(inputs.depths[view])) return of_view(std::move(*error), view);
  return std::nullopt;
}

std::optional<Error> PlanRunner::check(const PlanInputs& inputs) const {
  if (inputs.host_frame == nullptr) return Error{"host frame", "expected the frame's record, got none"};
  for (std::uint32_t view = 0; view < plan_.views; ++view) {
    const shared::Frame& record = inputs.host_frame[view];
    std::optional<Error> error = check_record(plan_, record);
    if (!error) error = check_count_of_views(record, *inputs.host_frame);
    if (error) return plan_.views == 1 ? error : of_view(std::move(*error), view);
  }
  if (auto error = check_buffer("frame", inputs.frame.buffer)) return error;
  if (auto error = check_lights(inputs)) return error;
  if (auto error = check_depths(inputs)) return error;
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
