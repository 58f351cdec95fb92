// The schedule of a frame: who is seen, at which size, who is drawn within the budget, and in which order.
// SPDX-License-Identifier: Apache-2.0
#include "lamplight/shadow_atlas.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "../is_finite.h"
#include "holdings.h"
#include "lamplight/light.h"
#include "sizes.h"

namespace lamp {
namespace shadow {

/// A light of this frame that is seen and reaches something.
struct Candidate {
  std::uint32_t light = 0;  ///< index
  Holding* holding = nullptr;
  Wish wish;
  bool keeps_size = false;  ///< for the budget allows it no square at all
  int level = NO_LEVEL;     ///< that it is to have
  float priority = 0.0F;
  enum class Left : std::uint8_t { nothing, budget, room } left = Left::nothing;  ///< what it still lacks
};

/// What a light's radial bound was made from. Squares belong to one map, until they are drawn anew.
struct Bounded {
  bool made = false;
  std::uint32_t kind = shared::SHADOW_NONE;
  std::uint32_t square = 0;
  std::uint32_t shows_all = 0;

  friend bool operator==(const Bounded&, const Bounded&) = default;
};

}  // namespace shadow
namespace {

using shadow::Bounded;
using shadow::Candidate;
using shadow::Holding;
using shadow::NO_LEVEL;
using shadow::Wish;

constexpr std::uint32_t MOST_SIZE = 32768;  // positions of squares fit 16 bits, and so does every device's limit

bool needs_drawing(const Candidate& c) { return !c.holding->drawn || c.holding->stale || c.holding->level != c.level; }

/// Whether a map drawn of one is a map of the other.
bool casts_alike(const shared::Light& a, const shared::Light& b) {
  const bool spots = a.type == shared::LIGHT_SPOT && b.type == shared::LIGHT_SPOT;
  return a.position == b.position && a.range == b.range && a.type == b.type &&
         (!spots || (a.direction == b.direction && a.outer_angle == b.outer_angle));
}

/// Nobody knows where a sphere is that is not finite.
bool touches(const shared::Light& light, const shared::LightSphere& moved) {
  return !is_finite(Vec3(moved.center)) || !std::isfinite(moved.radius) ||
         glm::length(glm::vec3(light.position) - glm::vec3(moved.center)) <=
             (light.range + moved.radius) * (1.0F + 1e-5F);
}

double shown_by(std::span<const View> views, const shared::Light& light) {
  const shared::LightSphere sphere = bounding_sphere(light);
  double most = 0.0;
  for (const View& view : views) most = std::max(most, shown_diameter_px(view, sphere));
  return most;
}

}  // namespace

struct ShadowAtlas::State {
  explicit State(const ShadowAtlasInfo& of)
      : info(of),
        holdings(static_cast<std::uint32_t>(std::countr_zero(of.size)), of.light_capacity),
        checked(of.light_capacity, 0),
        bounded(of.light_capacity) {}

  [[nodiscard]] std::optional<Error> check(const ShadowFrameInfo& frame);
  void meet_lights(const ShadowFrameInfo& frame);
  void add_candidate(const ShadowFrameInfo& frame, std::uint32_t i, Holding& holding);
  void choose_sizes();
  void draw_all(const ShadowFrameInfo& frame);
  void draw(const ShadowFrameInfo& frame, Candidate& c);
  void answer(const ShadowFrameInfo& frame);
  void list_radial_jobs(const ShadowFrameInfo& frame);

  [[nodiscard]] static std::uint32_t id_of(const ShadowFrameInfo& frame, std::uint32_t i) {
    return frame.ids.empty() ? i : frame.ids[i];
  }

  ShadowAtlasInfo info;
  shadow::Holdings holdings;
  std::vector<std::uint64_t> checked;  ///< by id: the check that met it last
  std::vector<Bounded> bounded;        ///< by index
  std::uint64_t checks = 0;
  std::uint64_t frame_number = 0;
  float fall = 0.0F;
  bool lacked_room = false;  ///< some light in the last frame
  std::uint64_t budget_left = 0;

  std::vector<Candidate> candidates;
  std::vector<Wish> wishes;
  std::vector<shared::ShadowMap> maps;
  std::vector<shared::ShadowView> views;
  std::vector<ShadowRedraw> redraws;
  std::vector<ShadowSquare> drawn_squares;
  std::vector<shared::RadialJob> radial_jobs;
  std::vector<std::uint32_t> waiting;
  std::vector<std::uint32_t> without;
  ShadowCounts counts;
};

std::optional<Error> ShadowAtlas::State::check(const ShadowFrameInfo& frame) {
  if (!frame.ids.empty() && frame.ids.size() != frame.lights.size())
    return Error{"shadow ids", "expected one for each of " + std::to_string(frame.lights.size()) + " lights, got " +
                                   std::to_string(frame.ids.size())};
  ++checks;
  for (std::uint32_t i = 0; i < frame.lights.size(); ++i) {
    const std::uint32_t id = id_of(frame, i);
    const std::string source = "light " + std::to_string(i);
    if (id >= info.light_capacity)
      return Error{source, "shadow id must be less than the capacity " + std::to_string(info.light_capacity) +
                               ", got " + std::to_string(id)};
    if (std::exchange(checked[id], checks) == checks)
      return Error{source, "shadow id " + std::to_string(id) + " belongs to a light before it, too"};
  }
  return std::nullopt;
}

void ShadowAtlas::State::add_candidate(const ShadowFrameInfo& frame, std::uint32_t i, Holding& holding) {
  const shared::Light& light = frame.lights[i];
  const double shown = shown_by(frame.views, light);
  if (shown <= 0.0) return;
  holding.last_seen = frame_number;
  const std::uint32_t squares = shadow_squares(light, info.points);
  // One square holds all directions of an octahedron, a quarter of its texels what a face holds.
  const bool folded = squares == 1 && (light.type != shared::LIGHT_SPOT || light.outer_angle > WIDEST_SPOT_SQUARE);
  const double side = shown * double{info.texels_per_pixel} * (folded ? 2.0 : 1.0);
  // Where even its least squares are beyond the budget, it is not drawn at any size.
  const bool keeps_size =
      holding.level != NO_LEVEL && shadow::texels_of(shadow::LEAST_LEVEL, squares) > frame.budget_texels;
  const std::uint64_t all = std::uint64_t{info.size} * info.size;
  const std::uint64_t most = keeps_size ? all : std::min(all, frame.budget_texels);
  int most_level = shadow::LEAST_LEVEL;
  while (most_level < shadow::MOST_LEVEL && shadow::texels_of(most_level + 1, squares) <= most) ++most_level;
  // No larger than what there is: else all would have to fall together by what nobody could have.
  const auto level = static_cast<float>(std::min(std::log2(side), shadow::MOST_LEVEL + 0.49));
  const Wish wish{.level = level, .current = holding.level, .most = most_level, .squares = squares};
  wishes.push_back(wish);
  candidates.push_back({.light = i,
                        .holding = &holding,
                        .wish = wish,
                        .keeps_size = keeps_size,
                        .priority = static_cast<float>(shown) * static_cast<float>(holding.waited + 1)});
}

void ShadowAtlas::State::meet_lights(const ShadowFrameInfo& frame) {
  candidates.clear();
  wishes.clear();
  for (std::uint32_t i = 0; i < frame.lights.size(); ++i) {
    const shared::Light& light = frame.lights[i];
    Holding& holding = holdings.of(id_of(frame, i));
    if (holding.in_frame + 1 != frame_number) holding.waited = 0;  // the id may be another light's now
    holding.in_frame = frame_number;
    const std::uint32_t squares = shadow_squares(light, info.points);
    if (holding.level != NO_LEVEL && holding.squares != squares) holdings.release(holding);
    if (squares == 0) continue;
    holding.stale =
        holding.drawn &&
        (holding.stale || !casts_alike(light, holding.light) ||
         std::ranges::any_of(frame.moved, [&](const shared::LightSphere& moved) { return touches(light, moved); }));
    add_candidate(frame, i, holding);
  }
  for (Holding& holding : holdings.all())
    if (holding.level != NO_LEVEL && holding.in_frame != frame_number) holdings.release(holding);
}

void ShadowAtlas::State::choose_sizes() {
  fall = shadow::choose_fall(wishes, std::uint64_t{info.size} * info.size, fall);
  for (Candidate& c : candidates) c.level = c.keeps_size ? c.holding->level : shadow::level_of(c.wish, fall);
}

void ShadowAtlas::State::draw(const ShadowFrameInfo& frame, Candidate& c) {
  Holding& holding = *c.holding;
  c.left = Candidate::Left::budget;
  if (shadow::texels_of(c.level, c.wish.squares) > budget_left) return;
  const int level_before = holding.level;
  const auto places_before = holding.places;
  c.left = Candidate::Left::room;
  if (holding.level != c.level && !holdings.resize(holding, c.wish.squares, c.level, frame_number)) return;
  c.left = Candidate::Left::nothing;
  const bool moved = holding.level != level_before || holding.places != places_before;
  // What could not grow is as it was.
  if (!moved && holding.drawn && !holding.stale) return;

  counts.moved += moved && holding.drawn ? 1 : 0;
  const std::uint64_t texels = shadow::texels_of(holding.level, holding.squares);
  budget_left -= texels;
  holding.drawn = true;
  holding.stale = false;
  holding.waited = 0;
  holding.light = frame.lights[c.light];
  holding.map = shadow_map(holding.light, info, 1U << static_cast<std::uint32_t>(holding.level),
                           shadow::Holdings::corners(holding));
  const auto first = static_cast<std::uint32_t>(views.size());
  add_shadow_views(holding.map, info.size, c.light, views);
  for (const UVec2& corner : shadow::Holdings::corners(holding)) drawn_squares.push_back({corner, holding.map.side});
  redraws.push_back({.light = c.light,
                     .first_view = first,
                     .views = static_cast<std::uint32_t>(views.size()) - first,
                     .texels = texels,
                     .priority = c.priority});
}

void ShadowAtlas::State::draw_all(const ShadowFrameInfo& frame) {
  // Without a shadow; then, where room is short, who gives some back; then whoever has waited longest for the most.
  const auto rank = [&](const Candidate& c) {
    const bool gives = lacked_room && c.holding->level > c.level;
    return std::tuple(!c.holding->drawn ? 0 : gives ? 1 : 2, -c.priority, c.light);
  };
  std::vector<std::pair<decltype(rank(candidates[0])), Candidate*>> order;
  for (Candidate& c : candidates)
    if (needs_drawing(c)) order.emplace_back(rank(c), &c);
  std::ranges::sort(order);
  views.clear();
  redraws.clear();
  drawn_squares.clear();
  budget_left = frame.budget_texels;
  for (const auto& [_, c] : order) draw(frame, *c);
  // Others may have given some since.
  for (const auto& [_, c] : order)
    if (c->left == Candidate::Left::room) draw(frame, *c);
}

void ShadowAtlas::State::answer(const ShadowFrameInfo& frame) {
  waiting.clear();
  without.clear();
  counts.seen = static_cast<std::uint32_t>(candidates.size());
  lacked_room = false;
  for (const Candidate& c : candidates) {
    if (c.left != Candidate::Left::nothing) ++c.holding->waited;
    if (c.left == Candidate::Left::budget) waiting.push_back(c.light);
    if (!c.holding->drawn) without.push_back(c.light);
    if (c.left == Candidate::Left::room) ++counts.no_room;
    if (c.holding->drawn &&
        c.holding->level < shadow::level_of({.level = c.wish.level, .current = c.wish.current}, 0.0F))
      ++counts.smaller;
  }
  lacked_room = counts.no_room != 0;
  counts.waiting = static_cast<std::uint32_t>(waiting.size());
  counts.without = static_cast<std::uint32_t>(without.size());
  counts.shadowed = counts.seen - counts.without;
  counts.redrawn = static_cast<std::uint32_t>(redraws.size());
  counts.evicted = holdings.take_evicted();
  for (const ShadowRedraw& redraw : redraws) counts.redrawn_texels += redraw.texels;
  counts.used_texels = holdings.used_texels();
  maps.resize(frame.lights.size());
  for (std::uint32_t i = 0; i < maps.size(); ++i) maps[i] = holdings.of(id_of(frame, i)).map;
}

void ShadowAtlas::State::list_radial_jobs(const ShadowFrameInfo& frame) {
  radial_jobs.clear();
  for (const ShadowRedraw& redraw : redraws) bounded[redraw.light].made = false;
  for (std::uint32_t i = 0; i < maps.size(); ++i) {
    const Bounded now{.made = true,
                      .kind = maps[i].kind,
                      .square = maps[i].squares[0],
                      .shows_all = shadow_shows_all(maps[i], frame.lights[i]) ? 1U : 0U};
    if (std::exchange(bounded[i], now) != now)
      radial_jobs.push_back({.light = i, .shows_all = now.shows_all, .parts = 1});
  }
  // An index without a light in this frame: its map may be drawn anew at another, which nobody would see here.
  std::fill(bounded.begin() + static_cast<std::ptrdiff_t>(maps.size()), bounded.end(), Bounded{});
}

ShadowAtlas::ShadowAtlas(std::unique_ptr<State> state) : state_(std::move(state)) {}
ShadowAtlas::ShadowAtlas(ShadowAtlas&&) noexcept = default;
ShadowAtlas& ShadowAtlas::operator=(ShadowAtlas&&) noexcept = default;
ShadowAtlas::~ShadowAtlas() = default;

Result<ShadowAtlas> ShadowAtlas::create(const ShadowAtlasInfo& info) {
  const auto wrong = [](std::string message) { return Error{"shadow atlas", std::move(message)}; };
  if (!std::has_single_bit(info.size) || info.size < shared::LEAST_SQUARE || info.size > MOST_SIZE)
    return wrong("size must be a power of two, 16 .. 32768 texels, got " + std::to_string(info.size));
  if (info.size > info.max_image_size)
    return wrong("size must be at most " + std::to_string(info.max_image_size) + " texels on this device, got " +
                 std::to_string(info.size));
  if (info.light_capacity == 0) return wrong("light capacity must be >= 1, got 0");
  if (!(info.texels_per_pixel > 0.0F) || !std::isfinite(info.texels_per_pixel))
    return wrong("texels per pixel must be finite and > 0, got " + std::to_string(info.texels_per_pixel));
  if (info.points != PointShadows::faces && info.points != PointShadows::octahedron)
    return wrong("points must be faces or octahedron, got " + std::to_string(static_cast<std::uint32_t>(info.points)));
  if (info.filter != ShadowFilter::hard && info.filter != ShadowFilter::pcf && info.filter != ShadowFilter::vsm &&
      info.filter != ShadowFilter::evsm)
    return wrong("filter must be hard, pcf, vsm or evsm, got " +
                 std::to_string(static_cast<std::uint32_t>(info.filter)));
  return ShadowAtlas(std::make_unique<State>(info));
}

Result<ShadowFrame> ShadowAtlas::schedule(const ShadowFrameInfo& frame) {
  State& s = *state_;
  if (auto error = s.check(frame)) return std::move(*error);
  ++s.frame_number;
  s.counts = {};
  s.meet_lights(frame);
  s.choose_sizes();
  s.draw_all(frame);
  s.answer(frame);
  s.list_radial_jobs(frame);
  return ShadowFrame{.maps = s.maps,
                     .views = s.views,
                     .redraws = s.redraws,
                     .squares = s.drawn_squares,
                     .radial_jobs = s.radial_jobs,
                     .waiting = s.waiting,
                     .without = s.without,
                     .counts = s.counts};
}

void ShadowAtlas::redraw_all() {
  for (Holding& holding : state_->holdings.all()) {
    holding.drawn = false;
    holding.map = {};
  }
  std::ranges::fill(state_->bounded, Bounded{});
}

const ShadowAtlasInfo& ShadowAtlas::info() const { return state_->info; }

}  // namespace lamp
