// Judges findings and pictures.
// SPDX-License-Identifier: Apache-2.0
#include "render/judgement.h"

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace lamp::app {
namespace {

/// What is wrong with the lists, or nothing.
std::string fault_of_lists(const Plan& plan, const Findings& f, std::string_view kind) {
  if (!plan.approximate && f.missed != 0)
    return fmt::format("misses {} pairs of pixel and {}, the first: {}", f.missed, kind, f.first_miss);
  if (f.repeated != 0) return fmt::format("walks {} {}s again at a pixel that they reach", f.repeated, kind);
  if (plan.ordered && f.unordered) return "a list does not ascend";
  if (plan.ordered && f.changed_runs.value_or(0) != 0)
    return fmt::format("{} of the repeated runs had other lists", *f.changed_runs);
  return "";
}

std::string fault_of_picture(const Plan& plan, const std::optional<PictureDifference>& difference) {
  if (plan.approximate || !difference) return "";
  if (!std::isfinite(difference->max_abs)) return NOT_FINITE;
  if (difference->max_abs <= difference->tolerance) return "";
  return fmt::format("the picture differs from brute force by {:.3g}, allowed {:.3g}", difference->max_abs,
                     difference->tolerance);
}

}  // namespace

std::string_view name_of(Verdict verdict) {
  switch (verdict) {
    case Verdict::ok:
      return "ok";
    case Verdict::approximate:
      return "approximate";
    case Verdict::unchecked:
      return "could not check";
    case Verdict::failed:
      break;
  }
  return "failed";
}

Exit exit_of(Verdict worst) {
  if (worst == Verdict::failed) return Exit::check_failed;
  return worst == Verdict::unchecked ? Exit::unchecked : Exit::done;
}

float largest_value(const HdrImage& image) {
  float largest = 0.0F;
  for (const glm::vec4& pixel : image.pixels) largest = std::max({largest, pixel.r, pixel.g, pixel.b});
  return largest;
}

float picture_tolerance(const Plan& plan, const HdrImage& reference) {
  return plan.ordered ? 0.0F : UNORDERED_TOLERANCE * (1.0F + largest_value(reference));
}

float max_abs_difference(const HdrImage& a, const HdrImage& b) {
  assert(a.pixels.size() == b.pixels.size() && "compare pictures of one size");
  float largest = 0.0F;
  for (std::size_t i = 0; i < a.pixels.size(); ++i)
    for (int c = 0; c < 4; ++c) {
      if (a.pixels[i][c] == b.pixels[i][c]) continue;  // two infinities, too, whose difference is NaN
      const float difference = std::abs(a.pixels[i][c] - b.pixels[i][c]);
      if (std::isnan(difference)) return std::numeric_limits<float>::infinity();
      largest = std::max(largest, difference);
    }
  return largest;
}

Judgement judge(const Plan& plan, const Findings& findings, const std::optional<PictureDifference>& difference,
                std::string_view kind) {
  if (std::string fault = fault_of_lists(plan, findings, kind); !fault.empty())
    return {Verdict::failed, std::move(fault)};
  if (findings.unfollowed != 0)
    return {Verdict::unchecked,
            fmt::format("the device ended the {} walks of {} pixels before their end, the first: {}", kind,
                        findings.unfollowed, findings.first_unfollowed)};
  if (std::string fault = fault_of_picture(plan, difference); !fault.empty()) {
    if (findings.list_max <= plan.lookup.most_walked) return {Verdict::failed, std::move(fault)};
    return {Verdict::unchecked, fmt::format("{}; but pixels walk up to {} lights, and on this device shading can lose "
                                            "some beyond {}",
                                            fault, findings.list_max, plan.lookup.most_walked)};
  }
  return {plan.approximate && findings.missed != 0 ? Verdict::approximate : Verdict::ok, ""};
}

Judgement worse_of(Judgement a, Judgement b) { return b.verdict > a.verdict ? b : a; }

}  // namespace lamp::app
