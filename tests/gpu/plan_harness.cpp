// Records plans.
// SPDX-License-Identifier: Apache-2.0
#include "gpu/plan_harness.h"

#include <algorithm>

#include "render/pass_uses.h"

namespace lamp::app {

vulkan::ShaderSource test_shader_source() {
  return [](std::string_view name) -> Result<std::vector<std::uint32_t>> {
    const ShaderCode* code = find_shader(test_shaders(), name);
    if (code == nullptr) return lamp::Error{"shader " + std::string(name), "is not among the tests' shaders"};
    return std::vector<std::uint32_t>(code->spirv.begin(), code->spirv.end());
  };
}

Pass words_pass(const char* shader, std::vector<std::uint32_t> constants, std::vector<Binding> bindings,
                std::uint32_t words) {
  return {.name = shader,
          .shader = shader,
          .constants = std::move(constants),
          .bindings = std::move(bindings),
          .extent = {.x = (words + 63) / 64}};
}

PlanHarness::PlanHarness(Plan plan, const std::vector<Light>& lights, const vulkan::ShaderSource& shaders)
    : device(test_context().device()),
      timestamps_(take(vulkan::Timestamps::create(device, 32))),
      frame_(host_buffer_of("frame", std::vector{shared::Frame{}})) {
  if (plan.light_capacity == 0) plan.light_capacity = 1U << 16;
  plan.width = std::max(1U, plan.width);
  plan.height = std::max(1U, plan.height);
  runner_ = take(vulkan::PlanRunner::create(device, std::move(plan), shaders));
  set_lights(lights);
}

void PlanHarness::set_lights(const std::vector<Light>& lights) {
  lights_ = pack(lights);
  const std::uint64_t bytes = std::max<std::size_t>(1, lights_.size()) * sizeof(shared::Light);
  if (light_buffer_.bytes() < bytes) light_buffer_ = host_buffer("lights", bytes);
  if (!lights_.empty()) std::memcpy(light_buffer_.mapped().data(), lights_.data(), bytes);
  const std::vector<shared::LightSphere> spheres = bounding_spheres(lights_);
  const std::uint64_t sphere_bytes = std::max<std::size_t>(1, spheres.size()) * sizeof(shared::LightSphere);
  if (sphere_buffer_.bytes() < sphere_bytes) sphere_buffer_ = host_buffer("spheres", sphere_bytes);
  if (!spheres.empty()) std::memcpy(sphere_buffer_.mapped().data(), spheres.data(), sphere_bytes);
}

void PlanHarness::read_back(vulkan::Recorder& recorder, const std::vector<vulkan::Buffer>& copies) const {
  for (std::uint32_t i = 0; i < copies.size(); ++i) {
    const VkBuffer from = runner_.buffer(PLAN_BUFFER + i);
    recorder.barrier(
        {copies_from(vulkan::Resource::storage(from)), copies_to(vulkan::Resource::storage(copies[i].handle()))});
    const VkBufferCopy whole{.size = copies[i].bytes()};
    vkCmdCopyBuffer(recorder.commands(), from, copies[i].handle(), 1, &whole);
    recorder.barrier({host_reads(vulkan::Resource::storage(copies[i].handle()))});
  }
}

std::vector<std::vector<std::uint32_t>> PlanHarness::run() {
  const auto light_count = static_cast<std::uint32_t>(lights_.size());
  shared::Frame frame{};
  frame.light_count = frame.light_capacity = light_count;
  frame.size_px = {runner_.plan().width, runner_.plan().height};
  if (view_) frame = view_->frame(light_count, light_count);
  std::memcpy(frame_.mapped().data(), &frame, sizeof(frame));
  std::vector<vulkan::Buffer> copies;
  for (const BufferDesc& buffer : runner_.plan().buffers) copies.push_back(host_buffer(buffer.name, buffer.bytes));
  test_context().submit([&](VkCommandBuffer commands) {
    timestamps_.reset(commands, part_of_);
    vulkan::Recorder recorder(device, commands, tracker_, &timestamps_);
    static_cast<void>(take(runner_.record(recorder, {.frame = frame_.handle(),
                                                     .lights = light_buffer_.handle(),
                                                     .spheres = sphere_buffer_.handle(),
                                                     .host_lights = lights_,
                                                     .host_frame = &frame})));
    timestamps_.finish(commands);
    read_back(recorder, copies);
  });
  runner_.finish(runner_.records());
  times_ = timestamps_.read();
  std::vector<std::vector<std::uint32_t>> words;
  for (const vulkan::Buffer& copy : copies) {
    words.push_back(contents<std::uint32_t>(copy));
    tracker_.forget(copy.handle());
  }
  return words;
}

}  // namespace lamp::app
