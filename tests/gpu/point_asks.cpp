// SPDX-License-Identifier: Apache-2.0
#include "gpu/point_asks.h"

#include <algorithm>

#include "gpu/check.h"
#include "gpu/test_scenes.h"
#include "scene/flight.h"

namespace lamp::app {

View view_from(const glm::vec3& eye) {
  Camera camera{.name = "any"};
  camera.world_from_camera[3] = glm::vec4(eye, 1.0F);
  return view_of(camera, ASK_SIDE, ASK_SIDE, "infinite");
}

Plan plan_of(const Method& method, const Asked& asked) {
  DeviceTraits traits = test_context().device().traits;
  traits.max_groups[0] = std::min(traits.max_groups[0], asked.max_groups);
  return take(make_plan(method, {.width = ASK_SIDE,
                                 .height = ASK_SIDE,
                                 .light_capacity = static_cast<std::uint32_t>(asked.lights.size()),
                                 .options = take(resolve_options(method, asked.settings)),
                                 .traits = traits}));
}

Answered answer(const Method& method, const Asked& asked) {
  PointWalks walks(test_context(), shader_library(), plan_of(method, asked), asked.view, asked.lights);
  Answered answered{.lights = walks.walk(asked.points)};
  answered.findings =
      check_points(answered.lights, truth_at(asked.points, asked.lights), asked.lights.size(), order_of(walks.plan()));
  answered.counters = walks.counts().counters;
  EXPECT_EQ(answered.findings.reason(), "");
  return answered;
}

}  // namespace lamp::app
