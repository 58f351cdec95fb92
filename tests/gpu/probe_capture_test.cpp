// Captures of scenes: the pictures that the renderer draws, by world-cells what brute force gives, and the same bits in
// every run.
// SPDX-License-Identifier: Apache-2.0
#include "render/probe_capture.h"

#include <algorithm>

#include "gpu/dispatch.h"
#include "gpu/method_check.h"
#include "gpu/test_lights.h"
#include "gpu/test_scenes.h"
#include "gpu/test_surfaces.h"

namespace lamp::app {
namespace {

constexpr std::uint32_t COUNT = 120;
constexpr std::size_t FACE = std::size_t{gpu::PROBE_SIDE} * gpu::PROBE_SIDE;

std::vector<glm::vec4> faces_of(const ProbeAtlas& atlas) {
  const vulkan::Buffer copy = host_buffer("faces", atlas.faces().bytes());
  test_context().submit([&](VkCommandBuffer commands) {
    vulkan::AccessTracker tracker;
    vulkan::Recorder recorder(test_context().device(), commands, tracker);
    recorder.order(VK_PIPELINE_STAGE_2_COMPUTE_SHADER_BIT, VK_PIPELINE_STAGE_2_COPY_BIT);
    const VkBufferCopy all{.size = copy.bytes()};
    vkCmdCopyBuffer(commands, atlas.faces().handle(), copy.handle(), 1, &all);
    recorder.order(VK_PIPELINE_STAGE_2_COPY_BIT, VK_PIPELINE_STAGE_2_HOST_BIT);
  });
  return contents<glm::vec4>(copy);
}

class ProbeCaptures : public GpuTest {
 protected:
  ProbeCaptures() : atlas_(test_context(), shader_library(), 2) {}

  static ProbeCaptureInfo with(std::string_view name, std::uint32_t lights) {
    const Method& method = *take(find_method(name));
    return {.method = &method, .options = take(resolve_options(method, {})), .light_capacity = lights};
  }

  ProbeAtlas atlas_;
};

/// Rooms and glass: one cull for six faces against brute force, and against the renderer's pictures.
TEST_F(ProbeCaptures, WorldCellsGiveThePictureOfBruteForceAndOfTheRenderer) {
  const TestScene& scene = builtin_test_scene("corridor");
  const AirCell& cell = scene.air.cells[scene.air.cells.size() / 2];
  const glm::vec3 position = cell.min + 0.5F * scene.air.cell_m;
  const std::vector<View> views = probe_views(position);
  const std::vector<shared::Light> lights = test_lights(scene.air, views.front(), {.count = COUNT});
  ProbeCapture by_cells(test_context(), shader_library(), scene.gpu, with("world-cells", COUNT));
  by_cells.set(lights);
  by_cells.capture(position, atlas_, 0);
  const std::vector<glm::vec4> faces = faces_of(atlas_);
  EXPECT_EQ(by_cells.culls(), 1U);

  ProbeCapture by_all(test_context(), shader_library(), scene.gpu, with("lamplight", COUNT));
  by_all.set(lights);
  by_all.capture(position, atlas_, 1);
  EXPECT_EQ(by_all.culls(), 6U);
  EXPECT_TRUE(faces == faces_of(atlas_));

  Renderer renderer(test_context(), shader_library(), scene.gpu, gpu::PROBE_SIDE, gpu::PROBE_SIDE, COUNT);
  Lighting brute(renderer.device(), shader_library(),
                 {.method = &brute_force(),
                  .options = take(resolve_options(brute_force(), {})),
                  .width = gpu::PROBE_SIDE,
                  .height = gpu::PROBE_SIDE,
                  .light_capacity = COUNT,
                  .transparency = !scene.gpu.blended().empty()});
  float brightest = 0.0F;
  for (std::uint32_t face = 0; face < gpu::PROBE_FACES; ++face) {
    renderer.set_frame(views[face], lights);
    const HdrImage picture = renderer.render(brute).image;
    bool same = true;
    for (std::size_t i = 0; i < FACE; ++i) {
      same = same && glm::vec3(picture.pixels[i]) == glm::vec3(faces[face * FACE + i]);
      brightest = std::max(brightest, picture.pixels[i].x);
    }
    EXPECT_TRUE(same) << "face " << face;
  }
  EXPECT_GT(brightest, 0.0F);

  by_cells.capture(position, atlas_, 1);
  for (std::uint32_t level = 0; level < gpu::PROBE_LEVELS; ++level)
    EXPECT_TRUE(atlas_.read_level(test_context(), 0, level).pixels ==
                atlas_.read_level(test_context(), 1, level).pixels)
        << "level " << level;
}

/// A wall that glows, 2 m before the probe, and a sky behind it: what is where, and how far.
TEST_F(ProbeCaptures, EmissionSkyAndDistanceLieWhereTheyAre) {
  Material glowing;
  glowing.base_color = {0.0F, 0.0F, 0.0F, 1.0F};
  glowing.metallic = 1.0F;
  glowing.emissive = {3.0F, 2.0F, 1.0F};
  Scene made = wall_scene(glowing);
  made.ambient = glm::vec3(0.0F);
  made.sky = {0.25F, 0.5F, 0.75F};
  const TestScene scene(std::move(made));
  ProbeCapture capture(test_context(), shader_library(), scene.gpu, with("world-cells", 1));
  capture.capture({0.0F, 0.0F, 2.0F}, atlas_, 0);
  const HdrImage level = atlas_.read_level(test_context(), 0, 0);
  const std::uint32_t middle = gpu::PROBE_SIDE / 2;
  const glm::vec4 sky = level.pixels[middle * gpu::PROBE_SIDE + middle];  // +z
  const glm::vec4 wall = level.pixels.front();                            // a corner is -z
  EXPECT_EQ(sky, glm::vec4(0.25F, 0.5F, 0.75F, 0.0F));
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(wall[c], scene.scene.materials.front().emissive[c], 2e-3F);
  EXPECT_NEAR(1.0F / wall.w, 2.0F, 5e-3F);
}

/// A plate between a wall and `plate_lights`.
Scene wall_and_plate() {
  Scene made = wall_scene(Material{});
  made.ambient = glm::vec3(0.0F);
  made.sky = glm::vec3(0.0F);
  add_wall(made, {.x0 = -1.0F, .y0 = -1.0F, .x1 = 1.0F, .y1 = 1.0F, .z = 1.0F}, 0);
  made.materials.front().double_sided = true;
  return made;
}

std::vector<shared::Light> plate_lights() {
  return {pack(Light{.position = {0.0F, 0.0F, 2.0F}, .range = 30.0F, .intensity = 500.0F})};
}

/// A light behind a plate: with shadows, the wall behind the plate is dark.
TEST_F(ProbeCaptures, LightsCastShadowsIntoCaptures) {
  const TestScene scene(wall_and_plate());
  const std::vector<shared::Light> lights = plate_lights();
  const auto radiance = [&](std::optional<ShadowSettings> shadows) {
    ProbeCaptureInfo info = with("world-cells", 1);
    info.shadows = shadows;
    ProbeCapture capture(test_context(), shader_library(), scene.gpu, info);
    capture.set(lights);
    capture.capture({0.0F, 0.0F, 0.5F}, atlas_, 0);
    return atlas_.read_level(test_context(), 0, 0).pixels.front().x;  // -z: the wall behind the plate
  };
  EXPECT_GT(radiance(std::nullopt), 1.0F);
  EXPECT_EQ(radiance(ShadowSettings{.filter = ShadowFilter::hard, .atlas_size = 1024}), 0.0F);
}

TEST_F(ProbeCaptures, SeeShadowsOfWhatHasMoved) {
  TestScene scene(wall_and_plate());
  const std::vector<shared::Light> lights = plate_lights();
  ProbeCaptureInfo info = with("world-cells", 1);
  info.shadows = ShadowSettings{.filter = ShadowFilter::hard, .atlas_size = 1024};
  ProbeCapture capture(test_context(), shader_library(), scene.gpu, info);
  capture.set(lights);
  const auto radiance = [&] {
    capture.capture({0.0F, 0.0F, 0.5F}, atlas_, 0);
    return atlas_.read_level(test_context(), 0, 0).pixels.front().x;  // -z: the wall
  };
  EXPECT_EQ(radiance(), 0.0F);
  scene.scene.instances.back().world_from_object[3].x = 20.0F;
  static_cast<void>(scene.gpu.move(test_context()));
  EXPECT_GT(radiance(), 1.0F);
}

/// Shadow maps keep their sizes and places from frame to frame, where there is room for few texels all the more.
TEST_F(ProbeCaptures, DoNotDependOnThoseBefore) {
  const TestScene& scene = builtin_test_scene("corridor");
  const std::vector<AirCell>& cells = scene.air.cells;
  const auto place = [&](std::size_t i) { return cells[i].min + 0.5F * scene.air.cell_m; };
  const glm::vec3 position = place(cells.size() / 2);
  const std::vector<shared::Light> lights =
      test_lights(scene.air, probe_views(position).front(), {.count = COUNT, .mix = Mix::both});
  ProbeCaptureInfo info = with("world-cells", COUNT);
  info.shadows = ShadowSettings{.atlas_size = 512};
  ProbeCapture first(test_context(), shader_library(), scene.gpu, info);
  first.set(lights);
  first.capture(position, atlas_, 0);
  info.shadows->budget_texels = 64 * 64;  // of the picture's frames
  ProbeCapture later(test_context(), shader_library(), scene.gpu, info);
  later.set(lights);
  for (const std::size_t i : {std::size_t{0}, cells.size() / 3, cells.size() - 1}) later.capture(place(i), atlas_, 1);
  later.capture(position, atlas_, 1);
  EXPECT_TRUE(atlas_.read_level(test_context(), 0, 0).pixels == atlas_.read_level(test_context(), 1, 0).pixels);
}

}  // namespace
}  // namespace lamp::app
