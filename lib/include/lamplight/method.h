// Methods: one row each in one explicit table, found by name; their options; the problem they plan for.
// Promise: the command line, the tests, the bench and the docs loop over `methods()`; nothing registers itself.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "lamplight/error.h"
#include "lamplight/export.h"
#include "lamplight/plan.h"

namespace lamp {

/// An option of a method: a choice among words, or an integer in a range.
struct OptionSpec {
  std::string_view key;
  std::string_view help;
  std::string_view fallback;              ///< the value when nobody sets it
  std::vector<std::string_view> choices;  ///< not empty: one of these
  long long min = 0;                      ///< choices empty: an integer min .. max
  long long max = 0;
};

/// Values to try of an option: each word, or both ends and the middle of a range.
[[nodiscard]] LAMPLIGHT_API std::vector<std::string> sample_values(const OptionSpec& spec);

/// Options that have been checked against a method and completed with its defaults (`resolve_options`). `Options()` has
/// none.
class LAMPLIGHT_API Options {
 public:
  /// Of the method's row; others assert.
  [[nodiscard]] std::uint32_t integer(std::string_view key) const;
  [[nodiscard]] const std::string& word(std::string_view key) const;
  [[nodiscard]] const std::map<std::string, std::string, std::less<>>& all() const { return values_; }

 private:
  friend Result<Options> resolve_options(const struct Method&, const std::vector<std::string>&);
  std::map<std::string, std::string, std::less<>> values_;
};

inline constexpr std::uint32_t MAX_LIGHTS = 1U << 24;
inline constexpr std::uint32_t MAX_FRAMES_IN_FLIGHT = 4;
inline constexpr std::uint32_t MAX_VIEWS = 8;
inline constexpr std::uint32_t MAX_IMAGE_SIZE = 1U << 16;  ///< pixels a side, whatever a device says

/// What a method plans for: frames of up to a size, in pixels, 1 .. traits.max_image_size and MAX_IMAGE_SIZE;
/// light_capacity up to MAX_LIGHTS.
struct Problem {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t views = 1;  ///< that a frame has, 1 .. MAX_VIEWS: eyes, faces of a cube, parts of a split screen
  std::uint32_t light_capacity = 0;
  Options options;  ///< `resolve_options` of the method; options that are not among them have its defaults
  DeviceTraits traits;
  /// What the host brings of its lights. Where it is not records of 64 bytes, one behind the other, the plan makes
  /// those itself, if it reads them.
  LightLayout light_layout;
  /// The host keeps no spheres: the plan makes INPUT_SPHERES from the lights, if it reads any.
  bool own_spheres = false;
  /// Of the depth image, a pixel: 1, 2, 4, 8, 16, 32 or 64. A light that reaches any of them is listed.
  std::uint32_t depth_samples = 1;
  /// Frames that may be recorded and not done yet, 1 .. MAX_FRAMES_IN_FLIGHT: what the host writes has as many slots.
  std::uint32_t frames_in_flight = 1;
  /// Frames may be smaller than width x height, and are to take no longer than with a plan for their size: where the
  /// size of a method's cells goes by that of the picture, the plan has passes for finer cells, too (Plan::finer).
  bool smaller_frames = false;
};

struct Method {
  std::string_view name;
  std::string_view title;    ///< a few words
  std::string_view source;   ///< author, title, venue, section
  std::string_view summary;  ///< one sentence: the idea
  std::string_view result;   ///< what it makes: the name of its look-up, but for `_scalar`, `_stepped` (Plan::lookup)
  bool ordered = true;       ///< lists ascend, with the default options (else see Plan::ordered)
  bool approximate = false;  ///< may miss lights, by the paper's design (likewise)
  bool needs_depth = true;   ///< reads the depth buffer
  bool any_depth = false;    ///< right for any depth of a pixel, not only the depth buffer's (likewise)
  bool any_point = false;    ///< has a look-up by position, right at any point of the world (world_walk_begin)
  bool still = false;        ///< of lights that stand still: its look-up reads what the host made ahead (INPUT_STILL)
  std::vector<OptionSpec> options;
  Plan (*plan)(const Problem&) = nullptr;
  std::optional<Error> (*check)(const Problem&) = nullptr;  ///< why options or sizes do not go together; may be null
};

/// Every method, in the order of the docs.
[[nodiscard]] LAMPLIGHT_API std::span<const Method> methods();

/// The method of that name, or an error with the nearest names.
[[nodiscard]] LAMPLIGHT_API Result<const Method*> find_method(std::string_view name);

/// Checks "key=value" settings against the method's options and completes them.
/// Errors name the option, what was given and what was expected: also where one is given twice.
[[nodiscard]] LAMPLIGHT_API Result<Options> resolve_options(const Method& method,
                                                            const std::vector<std::string>& settings);

/// Checks sizes, capacity and options, makes the plan and checks it (`plan_check`). Errors: what of these a method or
/// the device does not allow, options of another method among them.
[[nodiscard]] LAMPLIGHT_API Result<Plan> make_plan(const Method& method, const Problem& problem);

/// A plan with more room, and the options that made it.
struct GrownPlan {
  Options options;
  Plan plan;
};

/// A plan with room for what a frame needed, and for a quarter more. `needed`: what the counts of `plan.capacities`
/// said, in their order. Nothing if everything fitted, or where the method's options or the device allow no more.
[[nodiscard]] LAMPLIGHT_API std::optional<GrownPlan> grow_plan(const Method& method, const Problem& problem,
                                                               const Plan& plan, std::span<const std::uint32_t> needed);

/// The names nearest to `wanted`, nearest first, at most `count`, for error messages.
[[nodiscard]] LAMPLIGHT_API std::vector<std::string> nearest_names(std::string_view wanted,
                                                                   std::span<const std::string_view> names,
                                                                   std::size_t count = 3);

}  // namespace lamp
