// Two dispatches over a part of the points: one counts, one writes the lists. Parts whose lists would be too long are
// halved.
// SPDX-License-Identifier: Apache-2.0
#include "render/point_walks.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cstring>
#include <numeric>
#include <string>
#include <utility>

#include "gpu/check.h"
#include "gpu/transfer.h"
#include "render/pass_uses.h"

namespace lamp::app {
namespace {

constexpr const char* POINT_SHADER = "walk_";       // and the look-up
constexpr std::uint32_t WALK_GROUP = 64;            // threads of it
constexpr std::uint32_t POINTS_AT_ONCE = 1U << 14;  // points
constexpr std::uint32_t POINT_BINDING = 0;          // its bindings
constexpr std::uint32_t WORD_BINDING = 1;
constexpr std::uint32_t ENDED_BINDING = 2;
constexpr std::uint32_t LIST_BINDING = 3;

}  // namespace

PointWalks::PointWalks(Context& context, const ShaderLibrary& shaders, Plan plan, const View& view,
                       std::span<const shared::Light> lights, std::span<const std::uint32_t> still)
    : context_(context), data_(context.device(), static_cast<std::uint32_t>(lights.size())) {
  data_.set({&view, 1}, lights);
  if (!still.empty()) data_.set_still(context, still);
  runner_ = take(vulkan::PlanRunner::create(context.device(), std::move(plan), shaders.source()));
  const vulkan::BoundLookUp lookup = runner_.lookup(inputs());
  const std::string shader = POINT_SHADER + std::string(lookup.name);
  vulkan::PipelineInfo info{.name = shader,
                            .constants = lookup.constants,
                            .bindings = {{POINT_BINDING}, {WORD_BINDING}, {ENDED_BINDING}, {LIST_BINDING}},
                            .push_constant_bytes = 12};
  for (const vulkan::Bound& bound : lookup.resources) info.bindings.push_back({bound.binding, bound.resource.type});
  pipeline_ = take(vulkan::Pipeline::compute(context.device(), info, shaders.spirv(shader)));
  words_ = readback_buffer(context.device(), "counts of points", POINTS_AT_ONCE * sizeof(std::uint32_t));
  ended_ = readback_buffer(context.device(), "ended points", POINTS_AT_ONCE * sizeof(std::uint32_t));
}

vulkan::PlanInputs PointWalks::inputs() const {
  const vulkan::Resource no_depth;
  vulkan::PlanInputs inputs = data_.plan_inputs({&no_depth, 1});
  inputs.depths = {};
  return inputs;
}

PointLights PointWalks::walk(std::span<const glm::vec3> points) {
  cull();
  PointLights found;
  for (std::size_t first = 0; first < points.size(); first += POINTS_AT_ONCE)
    walk_part(points.subspan(first, std::min<std::size_t>(POINTS_AT_ONCE, points.size() - first)), found);
  return found;
}

void PointWalks::cull() {
  context_.submit([&](VkCommandBuffer commands) {
    vulkan::Recorder recorder(context_.device(), commands, tracker_);
    data_.record_upload(recorder);
    static_cast<void>(take(runner_.record(recorder, inputs())));
    runner_.record_counts(recorder);
  });
  runner_.finish(runner_.records());
  counts_ = runner_.counts();
}

std::uint32_t PointWalks::word_of(std::string_view buffer) {
  const std::vector<BufferDesc>& buffers = plan().buffers;
  const auto found = std::ranges::find(buffers, buffer, &BufferDesc::name);
  assert(found != buffers.end() && "a buffer of the plan");
  const VkBuffer from = runner_.buffer(PLAN_BUFFER + static_cast<ResourceId>(found - buffers.begin()));
  const vulkan::Buffer read = readback_buffer(context_.device(), "a word", sizeof(std::uint32_t));
  const vulkan::Resource to = vulkan::Resource::storage(read.handle());
  context_.submit([&](VkCommandBuffer commands) {
    vulkan::Recorder recorder(context_.device(), commands, tracker_);
    recorder.barrier({copies_from(vulkan::Resource::storage(from)), copies_to(to)});
    const VkBufferCopy part{.size = sizeof(std::uint32_t)};
    vkCmdCopyBuffer(commands, from, read.handle(), 1, &part);
    recorder.barrier({host_reads(to)});
  });
  tracker_.forget(read.handle());
  return first_values<std::uint32_t>(read, 1).front();
}

void PointWalks::walk_part(std::span<const glm::vec3> points, PointLights& to) {
  const auto count = static_cast<std::uint32_t>(points.size());
  const vulkan::Buffer positions =
      upload_buffer(context_, "points", std::as_bytes(points), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  {
    const vulkan::Buffer none = readback_buffer(context_.device(), "no lists", 0);
    dispatch(positions, none, count, /*writes=*/false);
  }
  std::vector<std::uint32_t> firsts = first_values<std::uint32_t>(words_, count);
  const std::uint64_t sum = std::accumulate(firsts.begin(), firsts.end(), std::uint64_t{0});
  if (sum > listed_at_once_ && count > 1) {
    walk_part(points.first(count / 2), to);
    return walk_part(points.subspan(count / 2), to);
  }
  for (const std::uint32_t length : firsts) to.offsets.push_back(to.offsets.back() + length);
  std::exclusive_scan(firsts.begin(), firsts.end(), firsts.begin(), 0U);
  if (count != 0) std::memcpy(words_.mapped().data(), firsts.data(), count * sizeof(std::uint32_t));
  const vulkan::Buffer lists = readback_buffer(context_.device(), "lists of points", sum * sizeof(std::uint32_t));
  dispatch(positions, lists, count, /*writes=*/true);
  const std::vector<std::uint32_t> lights = first_values<std::uint32_t>(lists, sum);
  to.lights.insert(to.lights.end(), lights.begin(), lights.end());
  const std::vector<std::uint32_t> ended = first_values<std::uint32_t>(ended_, count);
  to.ended.insert(to.ended.end(), ended.begin(), ended.end());
}

void PointWalks::dispatch(const vulkan::Buffer& points, const vulkan::Buffer& lists, std::uint32_t count, bool writes) {
  constexpr VkPipelineStageFlags2 COMPUTE = VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT;
  const vulkan::BoundLookUp lookup = runner_.lookup(inputs());
  std::vector<vulkan::Bound> bound = lookup.resources;
  std::vector<vulkan::Use> uses;
  for (const vulkan::Bound& b : bound) uses.push_back(reads(b.resource, COMPUTE));
  const vulkan::Resource from = vulkan::Resource::storage(points.handle());
  bound.push_back({POINT_BINDING, from});
  uses.push_back(reads(from, COMPUTE));
  std::vector<vulkan::Use> to_host;
  const std::array<std::pair<std::uint32_t, const vulkan::Buffer*>, 3> outputs{
      {{WORD_BINDING, &words_}, {ENDED_BINDING, &ended_}, {LIST_BINDING, &lists}}};
  for (const auto& [binding, buffer] : outputs) {
    const vulkan::Resource resource = vulkan::Resource::storage(buffer->handle());
    bound.push_back({binding, resource});
    uses.push_back(changes(resource));
    to_host.push_back(host_reads(resource));
  }
  const std::array<std::uint32_t, 3> push{count, writes ? 1U : 0U, /*two*/ 2U};
  context_.submit([&](VkCommandBuffer commands) {
    vulkan::Recorder recorder(context_.device(), commands, tracker_);
    recorder.begin_pass("walk points", uses);
    recorder.bind(pipeline_, bound);
    vkCmdPushConstants(commands, pipeline_.layout(), VK_SHADER_STAGE_ALL, 0, sizeof(push), push.data());
    vkCmdDispatch(commands, (count + WALK_GROUP - 1) / WALK_GROUP, 1, 1);
    recorder.end_pass();
    recorder.barrier(to_host);
  });
  for (const vulkan::Buffer* buffer : {&points, &lists}) tracker_.forget(buffer->handle());
}

}  // namespace lamp::app
