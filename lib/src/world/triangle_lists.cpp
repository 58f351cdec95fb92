// Triangles are halved along the longest side of their box, again and again; each half takes on the lights whose
// spheres touch its box. So neighbours come one after the other, and their lists share a group.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/triangle_lists.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <sstream>

#include "../is_finite.h"
#include "../light_faults.h"
#include "list_groups.h"
#include "patches.h"
#include "still_light.h"

namespace lamp {
namespace {

using world::Bounds;
using world::StillLight;

constexpr std::size_t FEW_TRIANGLES = 16;  // that are not halved
constexpr double FURTHEST_M = 1e15;        // of anything from the origin, as scenes have it
constexpr float LARGEST_PATCH = 1024.0F;   // over a light's range: then nothing is cut
constexpr float COARSER = 1.41421356F;     // half as many patches
constexpr std::uint32_t MOST_MERGED = 1U << 30;

bool is_near(double coordinate) { return std::abs(coordinate) <= FURTHEST_M; }  // false for a NaN

std::optional<Error> fault_of(const StillTriangle& triangle, std::size_t number) {
  const std::string name = "triangle " + std::to_string(number);
  for (const DVec3& corner : triangle.corners)
    if (!is_near(corner.x) || !is_near(corner.y) || !is_near(corner.z))
      return Error(name, expected("corners must be finite and at most 1e15 m from the origin",
                                  Vec3(glm::vec3(glm::dvec3(corner)))));
  for (const Vec3& normal : triangle.normals)
    if (!is_finite(normal)) return Error(name, expected("normals must be finite", normal));
  if (!(triangle.normal_tilt >= 0.0F))
    return Error(name, expected("normal_tilt must be >= 0 radians", triangle.normal_tilt));
  return std::nullopt;
}

std::optional<Error> fault_of(const shared::Light& light, std::size_t number) {
  std::string fault = fault_of_packed(light);
  if (fault.empty()) return std::nullopt;
  return Error("light " + std::to_string(number), std::move(fault));
}

std::optional<Error> fault_of(const TriangleListsInfo& info) {
  if (!(info.slack_m >= 0.0F) || std::isinf(info.slack_m))
    return Error("slack_m", expected("must be >= 0 m and finite", info.slack_m));
  if (!(info.patch > 0.0F)) return Error("patch", expected("must be > 0", info.patch));
  if (info.budget_bytes == 0) return Error("budget_bytes", "must be > 0, got 0");
  if (info.triangles.size() > world::MOST_LIST_WORDS)
    return Error("triangles", "must be at most " + std::to_string(world::MOST_LIST_WORDS) + ", got " +
                                  std::to_string(info.triangles.size()));
  for (std::size_t i = 0; i < info.triangles.size(); ++i)
    if (auto fault = fault_of(info.triangles[i], i)) return fault;
  for (std::size_t i = 0; i < info.lights.size(); ++i)
    if (auto fault = fault_of(info.lights[i], i)) return fault;
  return std::nullopt;
}

Bounds box_of(const StillTriangle& triangle) {
  const glm::dvec3 a(triangle.corners[0]);
  const glm::dvec3 b(triangle.corners[1]);
  const glm::dvec3 c(triangle.corners[2]);
  return {glm::min(a, glm::min(b, c)), glm::max(a, glm::max(b, c))};
}

/// How closely lists are to fit.
struct Fineness {
  float patch = 0.0F;
  std::uint32_t merged = 1;
};

/// One way to make all lists. As soon as they take more than `most_words`, it leaves the rest.
class Build {
 public:
  Build(const TriangleListsInfo& info, std::span<const StillLight> lights, const Fineness& fineness,
        std::size_t most_words)
      : info_(info), lights_(lights), merged_(fineness.merged), most_words_(most_words) {
    how_ = {.lights = lights,
            .hides = info.hides ? &info.hides : nullptr,
            .slack = info.slack_m,
            .patch = fineness.patch,
            .found = [this](std::size_t word, std::vector<std::uint32_t> list) { found(word, std::move(list)); },
            .is_too_much = [this] { return is_too_much(); }};
    made_.stats.patch = fineness.patch;
    made_.stats.merged = fineness.merged;
    made_.triangles = static_cast<std::uint32_t>(info.triangles.size());
    made_.lights = static_cast<std::uint32_t>(lights.size());
    made_.words.assign(std::max<std::size_t>(1, info.triangles.size()), shared::TRIANGLE_UNLIT);
  }

  /// False: they take more.
  [[nodiscard]] bool run() {
    std::vector<std::uint32_t> triangles(info_.triangles.size());
    std::iota(triangles.begin(), triangles.end(), 0U);
    std::vector<std::uint32_t> all(lights_.size());
    std::iota(all.begin(), all.end(), 0U);
    if (!triangles.empty()) halve(triangles, all);
    flush();
    if (!groups_.finish(made_.words.size(), most_words_)) return false;
    groups_.store(made_.words);
    made_.stats.groups = groups_.groups();
    made_.stats.lists = groups_.lists();
    return true;
  }

  [[nodiscard]] TriangleLists take() { return std::move(made_); }

 private:
  [[nodiscard]] bool is_too_much() const { return made_.words.size() + groups_.words() > most_words_; }

  [[nodiscard]] double slack_of(const Bounds& box) const {
    const glm::dvec3 far = glm::max(glm::abs(box.min), glm::abs(box.max));
    return info_.slack_m + 1e-5 * std::max({far.x, far.y, far.z});  // more than a patch's own
  }

  void halve(std::span<std::uint32_t> triangles, const std::vector<std::uint32_t>& lights) {
    if (is_too_much()) return;
    Bounds box = box_of(info_.triangles[triangles.front()]);
    Bounds middles{middle_of(triangles.front()), middle_of(triangles.front())};
    for (const std::uint32_t triangle : triangles) {
      const Bounds other = box_of(info_.triangles[triangle]);
      box = {glm::min(box.min, other.min), glm::max(box.max, other.max)};
      middles = {glm::min(middles.min, middle_of(triangle)), glm::max(middles.max, middle_of(triangle))};
    }
    std::vector<std::uint32_t> near;
    for (const std::uint32_t light : lights)
      if (may_touch(lights_[light], box, slack_of(box))) near.push_back(light);
    if (near.empty()) {
      made_.stats.patches += triangles.size();
      return;
    }
    if (triangles.size() <= FEW_TRIANGLES) return list(triangles, near);
    const glm::dvec3 size = middles.max - middles.min;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto half = triangles.begin() + static_cast<std::ptrdiff_t>(triangles.size() / 2);
    std::ranges::nth_element(triangles, half, [&](std::uint32_t a, std::uint32_t b) {
      const double of_a = middle_of(a)[axis];
      const double of_b = middle_of(b)[axis];
      return of_a != of_b ? of_a < of_b : a < b;
    });
    halve({triangles.begin(), half}, near);
    halve({half, triangles.end()}, near);
  }

  [[nodiscard]] glm::dvec3 middle_of(std::uint32_t triangle) const {
    const Bounds box = box_of(info_.triangles[triangle]);
    return 0.5 * (box.min + box.max);
  }

  void list(std::span<std::uint32_t> triangles, std::span<const std::uint32_t> near) {
    std::ranges::sort(triangles);
    world::PatchTables tables{made_.words, made_.stats};
    for (const std::uint32_t triangle : triangles)
      make_patches(how_, info_.triangles[triangle], near, triangle, tables);
  }

  void found(std::size_t word, std::vector<std::uint32_t> list) {
    if (merged_ == 1) return groups_.add(word, std::move(list));
    std::vector<std::uint32_t> together;
    std::ranges::set_union(waiting_list_, list, std::back_inserter(together));
    waiting_list_ = std::move(together);
    waiting_.push_back(word);
    if (waiting_.size() == merged_) flush();
  }

  void flush() {
    for (const std::size_t word : waiting_) groups_.add(word, waiting_list_);
    waiting_.clear();
    waiting_list_.clear();
  }

  const TriangleListsInfo& info_;
  std::span<const StillLight> lights_;
  std::uint32_t merged_;
  std::size_t most_words_;
  world::Patching how_;
  world::ListGroups groups_;
  TriangleLists made_;
  std::vector<std::size_t> waiting_;  ///< words of neighbours whose lists are merged
  std::vector<std::uint32_t> waiting_list_;
};

/// From this patch on nothing is cut: the longest side over the least range that ends.
double uncut_patch(std::span<const StillTriangle> triangles, std::span<const StillLight> lights) {
  double longest = 0.0;
  for (const StillTriangle& triangle : triangles) {
    const Bounds box = box_of(triangle);
    const glm::dvec3 size = box.max - box.min;
    longest = std::max({longest, size.x, size.y, size.z});
  }
  double least = std::numeric_limits<double>::infinity();
  for (const StillLight& light : lights)
    if (light.range > 0.0) least = std::min(least, light.range);
  return longest / least;
}

/// What takes less memory; nothing if nothing does.
std::optional<Fineness> coarser(const Fineness& fineness, double largest_patch) {
  if (fineness.patch < largest_patch) return Fineness{.patch = COARSER * fineness.patch};
  if (fineness.merged < MOST_MERGED) return Fineness{.patch = fineness.patch, .merged = 4 * fineness.merged};
  return std::nullopt;
}

void note(TriangleLists& lists, const TriangleListsInfo& info) {
  std::ostringstream text;
  if (lists.bytes() > info.budget_bytes) {
    text << "the coarsest lists take " << lists.bytes() << " bytes, more than the " << info.budget_bytes
         << " bytes they were to fit";
  } else if (lists.stats.merged > 1) {
    text << "triangles are not cut, and " << lists.stats.merged << " neighbours share a list, so that lists fit "
         << info.budget_bytes << " bytes";
  } else if (lists.stats.patch != info.patch) {
    text << "patches are " << lists.stats.patch << " ranges long instead of " << info.patch << ", so that lists fit "
         << info.budget_bytes << " bytes";
  }
  if (!text.str().empty()) lists.notes.push_back(text.str());
}

}  // namespace

Result<TriangleLists> make_triangle_lists(const TriangleListsInfo& info) {
  if (auto fault = fault_of(info)) return *std::move(fault);
  std::vector<StillLight> lights;
  lights.reserve(info.lights.size());
  for (const shared::Light& light : info.lights) lights.push_back(world::still_light(light));
  const double largest_patch = std::min<double>(LARGEST_PATCH, uncut_patch(info.triangles, lights));
  Fineness fineness{.patch = info.patch};
  while (true) {
    const std::optional<Fineness> next = coarser(fineness, largest_patch);
    const std::uint64_t budget_words = next ? info.budget_bytes / sizeof(std::uint32_t) : world::MOST_LIST_WORDS;
    Build build(info, lights, fineness, std::min<std::uint64_t>(budget_words, world::MOST_LIST_WORDS));
    if (build.run()) {
      TriangleLists made = build.take();
      note(made, info);
      return made;
    }
    if (!next) return Error("triangles", "with their lights they take more than the words of a list can name");
    fineness = *next;
  }
}

std::vector<std::uint32_t> lights_at(const TriangleLists& lists, std::uint32_t triangle, const Vec3& position) {
  assert(triangle < lists.triangles && "there are no more triangles");
  std::vector<std::uint32_t> lights;
  const std::uint32_t name = world::list_name(lists.words, lists.words[triangle], position);
  if (name != shared::TRIANGLE_UNLIT) world::read_list(lists.words, name, lights);
  return lights;
}

float raster_slack(float z_view, float pixel_m, std::uint32_t subpixel_bits) {
  // A vertex moves by half a step of the grid along each axis, and with it by as much at its own depth; depths of what
  // is drawn are means of the vertices'. Four times that: depth itself is rounded when it is interpolated.
  return 4.0F * std::sqrt(0.5F) * std::ldexp(pixel_m * z_view, -static_cast<int>(subpixel_bits));
}

}  // namespace lamp
