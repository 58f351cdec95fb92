// Every method, and the axes of each that look at depths and bounds, on frames that few hosts have.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <ostream>

#include "gpu/method_check.h"
#include "gpu/odd_frames.h"
#include "gpu/test_scenes.h"
#include "render/gpu_verifier.h"

namespace lamp::app {
namespace {

/// A captured frame on the GPU, and the oracle's answer.
struct Stage {
  explicit Stage(const OddFrame& odd)
      : name(odd.name),
        scene(captured(odd)),
        gpu(test_context(), scene),
        renderer(test_context(), shader_library(), gpu, ODD_SIZE.x, ODD_SIZE.y, ODD_LIGHTS),
        lit(make_case(renderer, odd.view, pack(odd.lights))) {}

  static Scene captured(const OddFrame& odd) {
    const std::size_t pixels = odd.depth.size();
    return {.name = odd.name,
            .captured = CapturedFrame{.view = odd.view,
                                      .depth = odd.depth,
                                      .albedo = std::vector<glm::vec3>(pixels, glm::vec3(0.5F)),
                                      .normal = normals_from_depth(odd.view, odd.depth),
                                      .material = std::vector<glm::vec3>(pixels, glm::vec3(0.0F, 1.0F, 1.0F)),
                                      .emission = std::vector<glm::vec3>(pixels, glm::vec3(0.0F))}};
  }

  std::string name;
  Scene scene;
  GpuScene gpu;
  Renderer renderer;
  LitCase lit;
};

std::vector<std::unique_ptr<Stage>>& stages() {
  static std::vector<std::unique_ptr<Stage>> made;
  if (!made.empty()) return made;
  at_context_end([] { made.clear(); });
  for (const OddFrame& odd : odd_frames()) made.push_back(std::make_unique<Stage>(odd));
  return made;
}

struct Variant {
  std::string_view method;
  std::vector<std::string> settings;
};

void PrintTo(const Variant& variant, std::ostream* out) {
  *out << fmt::format("{} {}", variant.method, fmt::join(variant.settings, " "));
}

/// Every row as it is, and combinations in which every bound, test and container occurs.
std::vector<Variant> variants() {
  std::vector<Variant> all;
  for (const Method& method : methods()) all.push_back({method.name, {}});
  const std::vector<Variant> more{
      {"tiled", {"bounds=half", "test=cone", "spot=cone-sphere", "lights=aos"}},
      {"tiled", {"bounds=modified-half", "test=exact", "spot=cone-planes", "reduce=subgroup"}},
      {"tiled", {"bounds=modified-half", "test=planes+aabb", "reduce=parallel", "prune=pixel"}},
      {"tiled", {"bounds=mask", "test=cone", "spot=cone-segments", "reduce=parallel"}},
      {"tiled", {"bounds=mask", "test=aabb", "spot=cone-sphere", "container=bits"}},
      {"tiled", {"bounds=none", "test=cone", "spot=cone-planes", "frusta=cached"}},
      {"tiled", {"order=type", "test=exact", "prune=pixel"}},
      {"clustered", {"container=bits", "scale=linear"}},
      {"world-cells", {"cells=16"}},
      {"lamplight", {"cells=list"}},
      {"lamplight", {"cells=bits", "prune=pixel"}},
      {"lamplight", {"cells=list", "container=bits", "tile=8"}},
      {"lamplight", {"cells=gather", "container=bits", "prune=pixel"}},
      {"lamplight", {"depth=none", "cells=list", "scale=linear"}},
      {"lamplight", {"depth=none", "cells=bits", "container=bits", "tile=8"}},
      {"drobot-zbin", {"sort=cpu"}},
      {"drobot-zbin", {"bin_scale=log2", "bins=64", "tile=32"}},
      {"drobot-raster-tile", {"raster=full", "depth=test"}},
      {"drobot-raster-tile", {"raster=quarter-msaa", "depth=stencil", "compact=off"}},
      {"drobot-raster-cluster", {"raster=full", "early=on"}},
      {"drobot-raster-cluster", {"raster=quarter-msaa", "scale=linear", "tile=16"}}};
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

class OddFrames : public GpuTest, public ::testing::WithParamInterface<Variant> {};

TEST_P(OddFrames, MissNothing) {
  const Candidate candidate{
      .method = take(find_method(GetParam().method)), .settings = GetParam().settings, .light_capacity = ODD_LIGHTS};
  for (const std::unique_ptr<Stage>& stage : stages()) {
    SCOPED_TRACE(stage->name);
    ASSERT_GT(stage->lit.truth.lights.size(), ODD_LIGHTS) << "lights that reach nothing show nothing";
    check_method(stage->renderer, stage->lit, candidate, Check::lists);
  }
}

TEST_F(GpuTest, OddFramesHaveTheSameTruthOnTheGpu) {
  LAMP_SKIP_WITHOUT_DOUBLES();
  Lighting lighting =
      make_lighting(stages().front()->renderer, {.method = &brute_force(), .light_capacity = ODD_LIGHTS});
  for (const std::unique_ptr<Stage>& stage : stages()) {
    SCOPED_TRACE(stage->name);
    stage->renderer.set_frame(stage->lit.view, stage->lit.lights);
    GpuVerifier verifier(stage->renderer, stage->lit.lights);
    EXPECT_EQ(verifier.check(lighting, vulkan::PlanRunner::Passes::separate).useful, stage->lit.truth.lights.size());
  }
}

INSTANTIATE_TEST_SUITE_P(Of, OddFrames, ::testing::ValuesIn(variants()), [](const auto& test) {
  return test_name(fmt::format("{}_{}", test.param.method, fmt::join(test.param.settings, "_")));
});

}  // namespace
}  // namespace lamp::app
