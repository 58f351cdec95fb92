// Walks look-ups and holds them against a truth: one walk of every pixel, and a second one, which marks what it brings,
// where lists are in another order than the truth or lack some of it.
// Promise: any number of lights. A walk is a thread's only loop; pixels are taken in parts whose buffers fit the
// device.
// SPDX-License-Identifier: Apache-2.0
#include "render/visit.h"

#include <algorithm>
#include <cstring>
#include <span>

#include "gpu/transfer.h"
#include "render/renderer.h"

namespace lamp::app {
namespace {

using Passes = vulkan::PlanRunner::Passes;

// Of the marks of one part.
constexpr std::uint64_t MARK_BYTES = 64ULL << 20;

/// Pixels of a truth, numbered through all its rows.
struct Part {
  std::size_t first = 0;
  std::size_t end = 0;
};

/// The first pixels from `first` on whose offsets, lights and results each fit a buffer; at least one pixel.
Part part_from(const Truth& truth, std::size_t first, std::uint64_t max_bytes) {
  const std::size_t pixels = truth.offsets.size() - 1;
  const std::size_t most = std::min<std::size_t>(pixels - first, max_bytes / sizeof(gpu::Met) - 1);
  const std::uint64_t lights = truth.offsets[first] + max_bytes / sizeof(std::uint32_t);
  const auto begin = truth.offsets.begin() + static_cast<std::ptrdiff_t>(first) + 1;
  const auto end = std::upper_bound(begin, begin + static_cast<std::ptrdiff_t>(most), lights);
  return {first, first + std::max<std::size_t>(1, static_cast<std::size_t>(end - begin))};
}

/// Where there are lights alone, no id is passed over: one that no light has is disorder or excess, and shall show.
EntityRange visited_ids(const EntityRanges& entities, Renderer::Kind kind) {
  if (kind == Renderer::Kind::decals) return entities.decals;
  if (kind == Renderer::Kind::probes) return entities.probes;
  return entities.boxes.count() == 0 ? EntityRange{0, ~0U} : entities.lights;
}

/// One look-up and one truth.
class Visitor {
 public:
  Visitor(Renderer& renderer, Lighting& lighting, Passes which, const Truth& truth, Renderer::Kind kind)
      : renderer_(renderer), lighting_(lighting), which_(which), truth_(truth) {
    const EntityRanges entities = renderer.data().entities();
    ids_ = visited_ids(entities, kind);
    marked_ = kind == Renderer::Kind::lights ? entities.lights : ids_;
  }

  std::vector<Visit> run() {
    while (met_.size() + 1 < truth_.offsets.size()) walk(part_from(truth_, met_.size(), max_bytes()));
    const auto first_cell = static_cast<std::uint32_t>(renderer_.shown().view *
                                                       lighting_.runner().plan().cells);  // come again from 2^32 on
    for (const gpu::Met& met : met_)
      visits_.push_back({.visited = met.visited,
                         .cell = met.cell == gpu::SKY_CELL ? met.cell : first_cell + met.cell,
                         .hash = met.hash,
                         .unordered = met.unordered != 0,
                         .ended = met.ended != 0});
    search();
    return std::move(visits_);
  }

 private:
  [[nodiscard]] std::uint64_t max_bytes() const { return renderer_.device().traits.max_storage_buffer_bytes; }
  /// Of a pixel of the truth, in the picture.
  [[nodiscard]] std::uint32_t number_of(std::size_t pixel) const {
    return static_cast<std::uint32_t>(std::size_t{truth_.first_row} * renderer_.targets().width + pixel);
  }
  [[nodiscard]] std::span<const std::uint32_t> truth_of(std::size_t pixel) const {
    return std::span(truth_.lights).subspan(truth_.offsets[pixel], truth_.offsets[pixel + 1] - truth_.offsets[pixel]);
  }
  void walk(const Part& part) {
    const std::uint32_t first_light = truth_.offsets[part.first];
    std::vector<std::uint32_t> offsets;
    for (std::size_t i = part.first; i <= part.end; ++i) offsets.push_back(truth_.offsets[i] - first_light);
    const auto lights = std::span(truth_.lights).subspan(first_light, offsets.back());
    Context& context = renderer_.context();
    constexpr VkBufferUsageFlags STORAGE = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;
    const vulkan::Buffer offset_buffer = upload_buffer(context, "truth offsets", bytes_of(offsets), STORAGE);
    const vulkan::Buffer light_buffer = upload_buffer(context, "truth lights", std::as_bytes(lights), STORAGE);
    const vulkan::Buffer found = readback_buffer(context.device(), "met", (part.end - part.first) * sizeof(gpu::Met));
    renderer_.run({.shader = "visit",
                   .lighting = &lighting_,
                   .which = which_,
                   .prepares = part.first == 0,
                   .storage = {{2, vulkan::Resource::storage(offset_buffer.handle())},
                               {3, vulkan::Resource::storage(light_buffer.handle())},
                               {4, vulkan::Resource::storage(found.handle()), VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT}},
                   .push = {number_of(part.first), number_of(part.end), ids_.first, ids_.end, /*two*/ 2}});
    for (const vulkan::Buffer* buffer : {&offset_buffer, &light_buffer, &found}) renderer_.forget(*buffer);
    std::vector<gpu::Met> met(part.end - part.first);
    std::memcpy(met.data(), found.mapped().data(), met.size() * sizeof(gpu::Met));
    met_.insert(met_.end(), met.begin(), met.end());
  }

  /// From `pixel` on, the first whose walk came to its end and did not meet all of the truth in passing.
  [[nodiscard]] std::size_t next_open(std::size_t pixel) const {
    const auto is_open = [&] { return met_[pixel].ended == 0 && met_[pixel].in_order < truth_of(pixel).size(); };
    while (pixel < met_.size() && !is_open()) ++pixel;
    return pixel;
  }

  void search() {
    std::size_t pixel = next_open(0);
    if (pixel == met_.size()) return;
    const std::size_t words = (marked_.count() + 31) / 32;  // of a pixel
    const std::uint64_t room = std::min(MARK_BYTES, max_bytes()) / sizeof(std::uint32_t);
    const std::size_t most = std::clamp<std::size_t>(room / std::max<std::size_t>(words, 1), 1, met_.size());
    const vulkan::Buffer marks = readback_buffer(renderer_.device(), "marks", most * words * sizeof(std::uint32_t));
    PixelPass pass{.shader = "visit_marks",
                   .lighting = &lighting_,
                   .which = which_,
                   .prepares = false,
                   .storage = {{2, vulkan::Resource::storage(marks.handle()),
                                VK_ACCESS_2_SHADER_STORAGE_READ_BIT | VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT,
                                /*zeroed=*/true}},
                   .push = {0, 0, ids_.first, ids_.end, marked_.end}};
    const vulkan::Pipeline pipeline = renderer_.pixel_pipeline(pass);
    std::vector<std::uint32_t> found(marks.bytes() / sizeof(std::uint32_t));
    while (pixel < met_.size()) {
      const std::size_t end = std::min(pixel + most, met_.size());
      pass.push[0] = number_of(pixel);
      pass.push[1] = number_of(end);
      renderer_.run(pass, pipeline);
      std::memcpy(found.data(), marks.mapped().data(), marks.bytes());
      const std::size_t first = pixel;
      for (; pixel < end; pixel = next_open(pixel + 1))
        compare(pixel, std::span(found).subspan((pixel - first) * words, words));
    }
    renderer_.forget(marks);
  }

  void compare(std::size_t pixel, std::span<const std::uint32_t> marks) {
    Visit& visit = visits_[pixel];
    for (const std::uint32_t light : truth_of(pixel).subspan(met_[pixel].in_order)) {
      const std::uint32_t bit = light - marked_.first;
      if (light < marked_.end && (marks[bit / 32] >> bit % 32 & 1U) != 0) continue;
      ++visit.missed;
      visit.first_missed = std::min(visit.first_missed, light);
    }
  }

  Renderer& renderer_;
  Lighting& lighting_;
  Passes which_;
  const Truth& truth_;
  EntityRange ids_;     ///< walked
  EntityRange marked_;  ///< that there are
  std::vector<gpu::Met> met_;
  std::vector<Visit> visits_;
};

}  // namespace

Truth empty_truth(std::uint32_t width, std::uint32_t height) {
  Truth truth{.rows = height};
  truth.offsets.assign(std::size_t{width} * height + 1, 0);
  return truth;
}

std::vector<Visit> Renderer::visit(Lighting& lighting, const Truth& truth, Passes which, Kind kind) {
  return Visitor(*this, lighting, which, truth, kind).run();
}

std::vector<Visit> Renderer::visit_all(Lighting& lighting, Passes which) {
  return visit(lighting, empty_truth(targets_->width, targets_->height), which);
}

}  // namespace lamp::app
