// Dispatches truth and walks in parts that no device takes for a hang, and adds up what comes back.
// SPDX-License-Identifier: Apache-2.0
#include "render/gpu_verifier.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <unordered_map>

#include "gpu/check.h"
#include "gpu/transfer.h"

namespace lamp::app {
namespace {

constexpr VkAccessFlags2 READ = VK_ACCESS_2_SHADER_STORAGE_READ_BIT;
constexpr VkAccessFlags2 WRITE = VK_ACCESS_2_SHADER_STORAGE_WRITE_BIT;

// Pixels of a band: 56 MiB of surveys.
constexpr std::uint64_t BAND_PIXELS = 1U << 21;

// Lights of a truth dispatch: software devices end a thread's loops after some 65 000 rounds, and a thread may go
// through each of its slice's lights and once more for every 256 of them.
constexpr std::uint32_t SLICE_LIGHTS = 1U << 15;

// Pairs of pixel and light that a dispatch may come to if a list holds every light: a desktop takes a GPU away after
// two seconds or so.
constexpr std::uint64_t DISPATCH_PAIRS = 100'000'000'000;
constexpr std::uint32_t GROUP_ROWS = 16;

constexpr std::size_t PUSHED = 5;  // constants of verify_walk.comp; verify_cells.comp reads the first four

// Of the marks of a dispatch of verify_distinct.comp.
constexpr std::uint64_t MARK_BYTES = 64ULL << 20;

std::vector<gpu::ReachLimits> limits_of(std::span<const shared::Light> lights) {
  std::vector<gpu::ReachLimits> limits;
  limits.reserve(lights.size());
  for (const shared::Light& light : lights) {
    const double near = 1.0 - BOUNDARY_BAND;
    const double far = 1.0 + BOUNDARY_BAND;
    const double range = light.range >= shared::INFINITE_RADIUS ? std::numeric_limits<double>::infinity() : light.range;
    const double outer = light.type == shared::LIGHT_POINT ? 0.0 : light.outer_angle;
    limits.push_back({.near_squared = range * near * (range * near),
                      .far_squared = range * far * (range * far),
                      .near_sin = std::sin(outer * near),
                      .near_cos = std::cos(outer * near),
                      .far_sin = std::sin(outer * far),
                      .far_cos = std::cos(outer * far)});
  }
  return limits;
}

constexpr VkBufferUsageFlags STORAGE = VK_BUFFER_USAGE_STORAGE_BUFFER_BIT;

vulkan::Buffer storage_buffer(const vulkan::Device& device, const char* name, std::uint64_t bytes,
                              vulkan::MemoryUse memory, VkBufferUsageFlags usage = STORAGE) {
  if (bytes > device.traits.max_storage_buffer_bytes)
    throw Error(fmt::format("GPU verifier: {}: {} bytes, expected at most {} on this device", name, bytes,
                            device.traits.max_storage_buffer_bytes));
  return take(vulkan::Buffer::create(device, {.name = name, .bytes = bytes, .usage = usage, .memory = memory}));
}

/// The first pixels of something, numbered through a band.
struct Firsts {
  std::optional<std::size_t> miss;
  std::optional<std::size_t> unfollowed;
};

/// Adds a band's pixels.
Firsts add_up(std::span<const gpu::Survey> surveys, Findings& sums) {
  Firsts firsts;
  for (std::size_t i = 0; i < surveys.size(); ++i) {
    const gpu::Survey& survey = surveys[i];
    if (survey.cell == gpu::SKY_CELL) continue;
    sums.boundary_pairs += survey.boundary;
    if (survey.ended != 0) {
      if (!firsts.unfollowed) firsts.unfollowed = i;
      ++sums.unfollowed;
      continue;
    }
    if (survey.missed != 0 && !firsts.miss) firsts.miss = i;
    sums.missed += survey.missed;
    sums.evaluations += survey.visited;
    sums.useful += survey.useful;
    sums.repeated += survey.repeated;
    sums.list_max = std::max(sums.list_max, survey.visited);
    sums.unordered = sums.unordered || survey.unordered != 0;
  }
  return firsts;
}

/// Adds a band's pixels that miss lights; `first` is the band's first pixel.
void add_misses(std::span<const gpu::Survey> surveys, std::size_t first, std::vector<PixelMisses>& misses) {
  for (std::size_t i = 0; i < surveys.size(); ++i)
    if (surveys[i].cell != gpu::SKY_CELL && surveys[i].ended == 0 && surveys[i].missed != 0)
      misses.push_back({static_cast<std::uint32_t>(first + i), surveys[i].missed});
}

/// From `pixel` on, the first whose misses nobody has counted.
std::size_t next_uncounted(std::span<const gpu::Survey> surveys, std::size_t pixel) {
  while (pixel < surveys.size() && (surveys[pixel].missed != gpu::NOT_COUNTED || surveys[pixel].ended != 0)) ++pixel;
  return pixel;
}

}  // namespace

/// The cells that were seen, with the length of their lists and the place of the first light in a row of all lists.
class GpuVerifier::Cells {
 public:
  void add(std::span<const gpu::Survey> surveys) {
    for (const gpu::Survey& survey : surveys) {
      first_places_.push_back(0);
      if (survey.cell == gpu::SKY_CELL || survey.ended != 0) continue;
      if (last_ == nullptr || survey.cell != last_cell_) {
        const auto [found, is_new] = cells_.try_emplace(survey.cell, Cell{survey.visited, survey.list, places_});
        if (is_new) places_ += survey.visited;
        last_ = &found->second;
        last_cell_ = survey.cell;
      }
      same_lists_ = same_lists_ && last_->length == survey.visited && last_->list == survey.list;
      first_places_.back() = static_cast<std::uint32_t>(last_->first_place);
    }
  }

  [[nodiscard]] std::uint64_t seen() const { return cells_.size(); }
  [[nodiscard]] std::uint64_t places() const { return places_; }
  /// Pixel by pixel, in the order in which they were added.
  [[nodiscard]] std::span<const std::uint32_t> first_places() const { return first_places_; }
  /// Whether all pixels of a cell walk the same lights, and places are 32-bit numbers.
  [[nodiscard]] bool comparable() const { return same_lists_ && places_ <= ~0U; }

 private:
  struct Cell {
    std::uint32_t length = 0;
    std::uint32_t list = 0;
    std::uint64_t first_place = 0;
  };
  std::unordered_map<std::uint32_t, Cell> cells_;
  std::vector<std::uint32_t> first_places_;
  std::uint64_t places_ = 0;
  bool same_lists_ = true;
  const Cell* last_ = nullptr;
  std::uint32_t last_cell_ = 0;
};

GpuVerifier::GpuVerifier(Renderer& renderer, std::span<const shared::Light> lights, Rows rows)
    : renderer_(renderer), lights_(lights), rows_(rows) {
  if (!renderer.context().has_doubles())
    throw Error("GPU verifier: the device lacks the feature shaderFloat64; --verifier oracle needs none",
                Exit::no_device);
  const View& view = renderer.view();
  if (rows_.count == 0) rows_ = {0, view.height()};
  limits_ = upload_buffer(renderer.context(), "reach limits", bytes_of(limits_of(lights)),
                          VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  const std::vector<glm::dmat4> matrix{view.world_from_view()};
  world_from_view_ =
      upload_buffer(renderer.context(), "world from view", bytes_of(matrix), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
  const auto step = static_cast<std::uint32_t>(std::max<std::uint64_t>(1, BAND_PIXELS / view.width()));
  for (std::uint32_t row = rows_.first; row < rows_.first + rows_.count; row += step) {
    const std::uint32_t count = std::min(step, rows_.first + rows_.count - row);
    bands_.push_back(
        {{row, count},
         storage_buffer(renderer.device(), "pixel truth", std::uint64_t{view.width()} * count * sizeof(gpu::PixelTruth),
                        vulkan::MemoryUse::device)});
    make_truth(bands_.back());
  }
}

GpuVerifier::~GpuVerifier() {
  renderer_.forget(limits_);
  renderer_.forget(world_from_view_);
  for (const Band& band : bands_) renderer_.forget(band.truth);
}

std::vector<PixelPass::Storage> GpuVerifier::inputs() const {
  return {{2, renderer_.data().lights()},
          {3, vulkan::Resource::storage(limits_.handle())},
          {4, vulkan::Resource::storage(world_from_view_.handle())}};
}

void GpuVerifier::make_truth(const Band& band) {
  const auto count = static_cast<std::uint32_t>(lights_.size());
  PixelPass pass{.shader = "verify_truth", .storage = inputs(), .rows = band.rows};
  pass.storage.push_back({5, vulkan::Resource::storage(band.truth.handle()), READ | WRITE});
  std::uint32_t first = 0;
  do {  // once even without lights: it clears
    const std::uint32_t end = first + std::min(SLICE_LIGHTS, count - first);
    pass.push = {band.rows.first, band.rows.count, first, end};
    renderer_.run(pass);
    pass.prepares = false;
    first = end;
  } while (first < count);
}

void GpuVerifier::walk(PixelPass pass, const Band& band) {
  const std::uint64_t row_pairs = std::max<std::uint64_t>(1, renderer_.view().width() * lights_.size());
  const auto groups = static_cast<std::uint32_t>(
      std::clamp<std::uint64_t>(DISPATCH_PAIRS / row_pairs / GROUP_ROWS, 1, band.rows.count / GROUP_ROWS + 1));
  // A fused look-up culls the tile of its work group, whose place is the dispatch's.
  const bool whole = pass.which == Passes::fused;
  const std::uint32_t step = whole ? band.rows.count : groups * GROUP_ROWS;
  pass.push.resize(PUSHED);
  const vulkan::Pipeline pipeline = renderer_.pixel_pipeline(pass);
  for (std::uint32_t row = band.rows.first; row < band.rows.first + band.rows.count; row += step) {
    pass.rows = {row, std::min(step, band.rows.first + band.rows.count - row)};
    pass.push = {band.rows.first, pass.rows.first, pass.rows.count, whole ? 0 : row, /*two*/ 2};
    renderer_.run(pass, pipeline);
    pass.prepares = false;
  }
}

std::vector<gpu::Survey> GpuVerifier::survey(Lighting& lighting, Passes which, const Band& band) {
  const std::size_t pixels = std::size_t{renderer_.view().width()} * band.rows.count;
  const vulkan::Buffer surveys =
      storage_buffer(renderer_.device(), "surveys", pixels * sizeof(gpu::Survey), vulkan::MemoryUse::readback);
  PixelPass pass{.shader = "verify_walk",
                 .lighting = &lighting,
                 .which = which,
                 .prepares = &band == &bands_.front(),
                 .storage = inputs()};
  pass.storage.push_back({5, vulkan::Resource::storage(band.truth.handle())});
  pass.storage.push_back({6, vulkan::Resource::storage(surveys.handle()), WRITE});
  walk(std::move(pass), band);
  std::vector<gpu::Survey> found(pixels);
  std::memcpy(found.data(), surveys.mapped().data(), pixels * sizeof(gpu::Survey));
  if (next_uncounted(found, 0) != pixels) {
    count_distinct(lighting, which, band, found, surveys);
    std::memcpy(found.data(), surveys.mapped().data(), pixels * sizeof(gpu::Survey));
  }
  renderer_.forget(surveys);
  return found;
}

void GpuVerifier::count_distinct(Lighting& lighting, Passes which, const Band& band, std::span<const gpu::Survey> found,
                                 const vulkan::Buffer& surveys) {
  const std::uint64_t pixel_bytes = (lights_.size() + 31) / 32 * sizeof(std::uint32_t);
  const std::uint64_t room = std::min(MARK_BYTES, renderer_.device().traits.max_storage_buffer_bytes);
  const std::size_t most = std::clamp<std::size_t>(room / pixel_bytes, 1, found.size());
  const vulkan::Buffer marks = storage_buffer(renderer_.device(), "light marks", most * pixel_bytes,
                                              vulkan::MemoryUse::device, STORAGE | VK_BUFFER_USAGE_TRANSFER_DST_BIT);
  PixelPass pass{
      .shader = "verify_distinct", .lighting = &lighting, .which = which, .prepares = false, .storage = inputs()};
  pass.storage.push_back({5, vulkan::Resource::storage(surveys.handle()), READ | WRITE});
  pass.storage.push_back({6, vulkan::Resource::storage(marks.handle()), READ | WRITE, /*zeroed=*/true});
  pass.push.resize(4);
  const vulkan::Pipeline pipeline = renderer_.pixel_pipeline(pass);
  const std::uint32_t width = renderer_.view().width();
  const auto before = static_cast<std::size_t>(band.rows.first) * width;
  for (std::size_t first = next_uncounted(found, 0); first < found.size();) {
    const std::size_t end = std::min(first + most, found.size());
    const auto first_row = static_cast<std::uint32_t>((before + first) / width);
    const auto end_row = static_cast<std::uint32_t>((before + end - 1) / width) + 1;
    pass.rows = {first_row, end_row - first_row};
    pass.push = {band.rows.first, static_cast<std::uint32_t>(before + first), static_cast<std::uint32_t>(before + end),
                 which == Passes::fused ? 0 : first_row};
    renderer_.run(pass, pipeline);
    first = next_uncounted(found, end);
  }
  renderer_.forget(marks);
}

std::optional<std::uint64_t> GpuVerifier::count_cell_truth(Lighting& lighting, const Cells& cells) {
  const std::vector<std::uint32_t> zeros((cells.places() + 31) / 32, 0);
  if (!cells.comparable() || zeros.size() * sizeof(std::uint32_t) > renderer_.device().traits.max_storage_buffer_bytes)
    return std::nullopt;
  const vulkan::Buffer marks =
      storage_buffer(renderer_.device(), "list marks", std::max<std::size_t>(1, zeros.size()) * sizeof(std::uint32_t),
                     vulkan::MemoryUse::readback);
  std::ranges::fill(marks.mapped(), std::byte{0});
  for (const Band& band : bands_) {
    const std::size_t width = renderer_.view().width();
    const auto places = cells.first_places().subspan(width * (band.rows.first - rows_.first), width * band.rows.count);
    const vulkan::Buffer first_places =
        upload_buffer(renderer_.context(), "first places", std::as_bytes(places), VK_BUFFER_USAGE_STORAGE_BUFFER_BIT);
    PixelPass pass{.shader = "verify_cells", .lighting = &lighting, .prepares = false, .storage = inputs()};
    pass.storage.push_back({5, vulkan::Resource::storage(first_places.handle())});
    pass.storage.push_back({6, vulkan::Resource::storage(marks.handle()), READ | WRITE});
    walk(std::move(pass), band);
    renderer_.forget(first_places);
  }
  renderer_.forget(marks);
  std::vector<std::uint32_t> words(zeros.size());
  std::memcpy(words.data(), marks.mapped().data(), words.size() * sizeof(std::uint32_t));
  std::uint64_t count = 0;
  for (const std::uint32_t word : words) count += static_cast<std::uint64_t>(std::popcount(word));
  return count;
}

std::string GpuVerifier::name_miss(Lighting& lighting, Passes which, std::uint32_t x, std::uint32_t y) {
  const View& view = renderer_.view();
  const double depth = renderer_.read_depth()[std::size_t{y} * view.width() + x];
  const glm::dvec3 position = view.world_position(x, y, depth);
  Truth truth{.first_row = y, .rows = 1};
  truth.offsets.assign(x + 1, 0);
  for (std::uint32_t i = 0; i < lights_.size(); ++i)
    if (reach(lights_[i], position) == Reach::inside) truth.lights.push_back(i);
  truth.offsets.resize(view.width() + 1, static_cast<std::uint32_t>(truth.lights.size()));
  const Visit visit = renderer_.visit(lighting, truth, which)[x];
  if (visit.missed == 0) return fmt::format("pixel ({}, {}): a light that the oracle does not find missing", x, y);
  return fmt::format("pixel ({}, {}): light {}", x, y, visit.first_missed);
}

Findings GpuVerifier::check(Lighting& lighting, Passes which, std::vector<PixelMisses>* misses) {
  Findings findings;
  Cells cells;
  std::optional<glm::uvec2> miss;
  for (const Band& band : bands_) {
    const std::vector<gpu::Survey> surveys = survey(lighting, which, band);
    const Firsts firsts = add_up(surveys, findings);
    const std::uint32_t width = renderer_.view().width();
    const auto at = [&](std::size_t i) { return glm::uvec2(i % width, band.rows.first + i / width); };
    if (firsts.miss && !miss) miss = at(*firsts.miss);
    if (firsts.unfollowed && findings.first_unfollowed.empty())
      findings.first_unfollowed = fmt::format("pixel ({}, {})", at(*firsts.unfollowed).x, at(*firsts.unfollowed).y);
    cells.add(surveys);
    if (misses != nullptr) add_misses(surveys, std::size_t{width} * band.rows.first, *misses);
  }
  findings.list_sum = cells.places();
  findings.cells_seen = cells.seen();
  if (findings.missed == 0 && findings.repeated == 0 && findings.unfollowed == 0 && which == Passes::separate)
    findings.truth_sum = count_cell_truth(lighting, cells);
  if (miss) findings.first_miss = name_miss(lighting, which, miss->x, miss->y);
  return findings;
}

}  // namespace lamp::app
