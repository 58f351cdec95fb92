// Renders, shrinks, writes.
// SPDX-License-Identifier: Apache-2.0
#include "commands/bench_pictures.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <bit>
#include <cctype>

#include "commands/pictures.h"
#include "files/content_hash.h"
#include "files/utf8_path.h"
#include "render/heatmap.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t MAX_WIDTH = 640;

/// Letters and digits stay, everything else becomes one hyphen; a hash of the key tells names apart that this makes
/// alike.
std::string file_name(const Group& group, const BenchPicture& picture) {
  constexpr std::size_t MOST = 100;  // bytes
  const std::string scene = utf8_path(group.scene).filename().string();
  std::string name;
  for (const char c : fmt::format("{} {} {}", group.series, scene, picture.label).substr(0, MOST)) {
    if (std::isalnum(static_cast<unsigned char>(c)) != 0)
      name += c;
    else if (!name.empty() && name.back() != '-')
      name += '-';
  }
  return name + (name.empty() || name.back() == '-' ? "" : "-") + hash_text(hash_of(picture.key)).substr(0, 8);
}

/// Each pixel is the mean of `factor` x `factor` of the picture's.
LdrImage shrunk(const LdrImage& image, std::uint32_t factor) {
  LdrImage small{image.width / factor, image.height / factor, {}};
  for (std::uint32_t y = 0; y < small.height; ++y)
    for (std::uint32_t x = 0; x < small.width; ++x) {
      glm::uvec4 sum(0);
      for (std::uint32_t j = 0; j < factor; ++j)
        for (std::uint32_t i = 0; i < factor; ++i)
          sum += glm::uvec4(image.pixels[std::size_t{y * factor + j} * image.width + x * factor + i]);
      small.pixels.emplace_back(sum / (factor * factor));
    }
  return small;
}

std::vector<std::uint32_t> shrunk(std::span<const std::uint32_t> counts, std::uint32_t width, std::uint32_t height,
                                  std::uint32_t factor) {
  std::vector<std::uint32_t> small;
  for (std::uint32_t y = 0; y < height / factor; ++y)
    for (std::uint32_t x = 0; x < width / factor; ++x)
      small.push_back(counts[std::size_t{y * factor} * width + x * factor]);
  return small;
}

struct Shown {
  LdrImage picture;
  std::vector<std::uint32_t> counts;  ///< empty: there is no look-up
};

Shown show(Renderer& renderer, const BenchPicture& of, std::uint32_t factor) {
  Lighting& lighting = *of.lighting;
  const Targets& targets = renderer.targets();
  const HdrImage image = renderer.render(lighting).image;
  Shown shown{.picture = shrunk(tone_map(image, automatic_exposure(image)), factor)};
  if (lighting.info().path == ShadingPath::standard_deferred) return shown;
  const auto which = lighting.fused() ? vulkan::PlanRunner::Passes::fused : vulkan::PlanRunner::Passes::separate;
  const std::vector<Visit> visits = renderer.visit_all(lighting, which);
  std::vector<std::uint32_t> counts = walked_lights(visits);
  if (of.still != nullptr) add_still_walks(*of.still, pixel_points(renderer), counts);
  shown.counts = shrunk(counts, targets.width, targets.height, factor);
  return shown;
}

std::uint32_t longest(std::span<const Shown> all) {
  std::uint32_t most = 1;
  for (const Shown& shown : all)
    for (const std::uint32_t count : shown.counts)
      if (count != SKY_CELL) most = std::max(most, count);
  return most;
}

}  // namespace

std::vector<nlohmann::json> write_pictures(const std::filesystem::path& folder, const Group& group, Renderer& renderer,
                                           std::span<const BenchPicture> pictures) {
  const std::uint32_t factor = (renderer.targets().width + MAX_WIDTH - 1) / MAX_WIDTH;
  std::vector<Shown> all;
  for (const BenchPicture& picture : pictures) {
    picture.show();
    all.push_back(show(renderer, picture, factor));
  }
  const std::uint32_t scale = std::bit_ceil(longest(all));
  std::vector<nlohmann::json> files;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::string base = "pictures/" + file_name(group, pictures[i]);
    const auto write = [&](const std::string& name, const LdrImage& picture) {
      write_output(folder / utf8_path(name), [&](const auto& file) { write_png(file, picture); });
    };
    write(base + ".png", all[i].picture);
    files.push_back({{"picture", base + ".png"}});
    if (all[i].counts.empty()) continue;
    write(base + "-heat.png", draw_heatmap({.width = all[i].picture.width,
                                            .height = all[i].picture.height,
                                            .counts = all[i].counts,
                                            .scale_max = scale,
                                            .title = pictures[i].label}));
    files.back()["heatmap"] = base + "-heat.png";
  }
  return files;
}

}  // namespace lamp::app
