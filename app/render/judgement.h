// What a check comes to: whether a plan does what its row promises, as one word and the reason.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "error.h"
#include "image/image.h"
#include "lamplight/plan.h"
#include "render/verification.h"

namespace lamp::app {

/// From good to bad.
enum class Verdict : std::uint8_t {
  ok,           ///< nothing missed or repeated, lists in order, brute force's picture
  approximate,  ///< lights are missed, as the row says that they may be
  unchecked,    ///< a part could not be checked on this device; the rest is right
  failed,
};
/// "ok", "approximate", "could not check", "failed".
[[nodiscard]] std::string_view name_of(Verdict verdict);
/// Of a command whose worst verdict it is.
[[nodiscard]] Exit exit_of(Verdict worst);

struct Judgement {
  Verdict verdict = Verdict::ok;
  std::string reason;  ///< of `unchecked` and `failed`, one line
};

/// How far a picture may be from brute force's: not at all where lists ascend; else, for 4096 additions in any order,
/// by this share of one more than the largest value.
inline constexpr float UNORDERED_TOLERANCE = 1e-4F;
[[nodiscard]] float picture_tolerance(const Plan& plan, const HdrImage& reference);
[[nodiscard]] float largest_value(const HdrImage& image);

/// What a difference that is infinite comes from.
inline constexpr const char* NOT_FINITE = "a pixel of one of the pictures is infinite or not a number, and differs";

/// A picture against brute force's.
struct PictureDifference {
  float max_abs = 0.0F;    ///< of max_abs_difference
  float tolerance = 0.0F;  ///< of picture_tolerance
};
/// The largest difference of a channel; 0 if and only if all bits that matter agree, infinity where one is NaN or where
/// one alone is infinite. Sums of light that are beyond 32 bits in both agree: they say nothing of lists.
[[nodiscard]] float max_abs_difference(const HdrImage& a, const HdrImage& b);

/// What an approximate plan misses is counted, not held against it, and so is its picture. Where a device ends loops, a
/// picture that differs says nothing of a plan whose longest walk is beyond `LookUp::most_walked`. No `difference`:
/// pictures were not compared. `kind`: what the findings are of.
[[nodiscard]] Judgement judge(const Plan& plan, const Findings& findings,
                              const std::optional<PictureDifference>& difference, std::string_view kind = "light");

/// The worse of the two; of equal ones the first.
[[nodiscard]] Judgement worse_of(Judgement a, Judgement b);

}  // namespace lamp::app
