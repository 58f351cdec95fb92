// Checks a method's look-ups against the oracle, and the pictures that are lit through them against brute force.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "gpu/gpu_test.h"
#include "render/judgement.h"

namespace lamp::app {

/// One picture to be lit, and what is known of it: the same for all methods.
struct LitCase {
  View view;
  std::vector<shared::Light> lights;
  std::vector<float> depth;
  Truth truth;
  HdrImage reference;  ///< by brute force, shaded in compute
};

/// Draws the case by brute force and asks the oracle.
[[nodiscard]] LitCase make_case(Renderer& renderer, const View& view, std::vector<shared::Light> lights);

/// A method with options ("tile=8") for a light capacity.
struct Candidate {
  const Method* method = nullptr;
  std::vector<std::string> settings;
  std::uint32_t light_capacity = 0;
  std::uint32_t subgroup_size = 0;  ///< that the plan is made for, whatever the shaders find; 0: the device's
};

/// Plans of `lamplight` for large subgroups share crowded cells out in parts, those for small ones do not.
inline constexpr std::uint32_t PLAN_SUBGROUPS[] = {8, 32};

/// Throws Error when the plan does not fit the device.
[[nodiscard]] Lighting make_lighting(const Renderer& renderer, const Candidate& candidate,
                                     ShadingPath path = ShadingPath::deferred);
/// The same, kept until a few dozen others have been asked for: for tests that come back to it.
[[nodiscard]] Lighting& kept_lighting(const Renderer& renderer, const Candidate& candidate, ShadingPath path);

enum class Check : std::uint8_t {
  separate,
  separate_and_fused,
  lists,  ///< of both, but no pictures
};

/// Expects of the look-ups, separate and fused: no miss unless the plan is approximate, ascending where it says so, no
/// more lights than there are, the same sum from both; and of their pictures: brute force's, bit for bit where lists
/// ascend. Returns what the separate look-up was found to hold.
Findings check_method(Renderer& renderer, const LitCase& lit, const Candidate& candidate,
                      Check check = Check::separate_and_fused);

/// Brute force's row of the table.
[[nodiscard]] const Method& brute_force();

}  // namespace lamp::app
