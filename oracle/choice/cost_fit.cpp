// Fits the cost model: least squares without negative coefficients.
// Based on: coordinate descent on the normal equations, Franc, Hlavác, Navara, Sequential Coordinate-Wise Algorithm for
// the Non-Negative Least Squares Problem (2005).
// Promise: deterministic; a term that is 0 in every sample gets the coefficient 0.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "oracle/choose.h"

namespace lamp {
namespace {

constexpr int SWEEPS = 5000;
constexpr double LEAST_MS = 1e-4;  // below, times are rounding

/// Rows of terms and what they shall come to, both over the latter: what is minimised is the relative error.
template <std::size_t COUNT>
class RelativeFit {
 public:
  void add(std::array<double, COUNT> terms, double ms) {
    const double scale = 1.0 / std::max(ms, LEAST_MS);
    for (double& term : terms) term *= scale;
    for (std::size_t i = 0; i < COUNT; ++i) {
      right_[i] += terms[i] * ms * scale;
      for (std::size_t j = 0; j < COUNT; ++j) matrix_[i][j] += terms[i] * terms[j];
    }
  }

  [[nodiscard]] std::array<double, COUNT> solve() const {
    std::array<double, COUNT> x{};
    for (int sweep = 0; sweep < SWEEPS; ++sweep) {
      for (std::size_t i = 0; i < COUNT; ++i) {
        if (matrix_[i][i] <= 0.0) continue;
        double residual = right_[i];
        for (std::size_t j = 0; j < COUNT; ++j) residual -= matrix_[i][j] * x[j];
        x[i] = std::max(0.0, x[i] + residual / matrix_[i][i]);
      }
    }
    return x;
  }

 private:
  std::array<std::array<double, COUNT>, COUNT> matrix_{};
  std::array<double, COUNT> right_{};
};

}  // namespace

CandidateCost fit_cost(const AutoCandidate& candidate, std::span<const CostSample> samples) {
  RelativeFit<CULL_TERMS> cull;
  RelativeFit<SHADE_TERMS> shade;
  for (const CostSample& sample : samples) {
    cull.add(cull_terms(candidate, sample.workload), sample.cull_ms);
    shade.add(shade_terms(candidate, sample.workload), sample.shade_ms);
  }
  return {.cull = cull.solve(), .shade = shade.solve()};
}

}  // namespace lamp
