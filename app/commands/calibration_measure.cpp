// Measures what the cost model is fitted to: each candidate on a few sizes and counts of lights.
// Promise: the lights and the picture are always the same; only times differ. SPDX-License-Identifier: Apache-2.0
#include <tbb/parallel_for.h>

#include <algorithm>
#include <chrono>
#include <future>
#include <list>
#include <vector>

#include "commands/calibration.h"
#include "commands/request.h"
#include "gpu/check.h"
#include "render/frame_times.h"
#include "render/wake.h"
#include "scene/flight.h"
#include "scene/place_lights.h"

namespace lamp::app {
namespace {

/// What is measured: every point of a device's plan, by every candidate.
struct MeasuredPoint {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t lights = 0;
  float range = 0.0F;  ///< m, of all lights; 0: automatic
};

// Small and large pictures, few and many lights, so that every term of the model leads somewhere. With one light, and
// with lights that reach next to nothing, pixels and lights cost what they cost alone: else lists, which grow with
// both, would be given their part. No light at all is another matter: passes end at once, and auto does not ask.
constexpr float TINY = 0.02F;
constexpr MeasuredPoint GPU_POINTS[] = {{480, 270, 64},           {480, 270, 4096},   {1920, 1080, 1, TINY},
                                        {1920, 1080, 64},         {1920, 1080, 2048}, {1920, 1080, 32768},
                                        {1920, 1080, 32768, TINY}};
constexpr MeasuredPoint SOFTWARE_POINTS[] = {{96, 54, 64},   {96, 54, 1024},   {256, 144, 1, TINY},
                                             {256, 144, 64}, {256, 144, 2048}, {256, 144, 2048, TINY}};

// Pairs of pixel and light that brute force is asked to walk at most.
constexpr std::uint64_t GPU_PAIRS = 10'000'000'000;
constexpr std::uint64_t SOFTWARE_PAIRS = 40'000'000;

// A software device takes longer to compile than to run: there, plans that differ in capacity alone would be compiled
// for every count of lights.
constexpr std::uint32_t SOFTWARE_CAPACITY = 2048;

constexpr int WARM_UP = 1;
constexpr int GPU_FRAMES = 3;
constexpr int SOFTWARE_FRAMES = 4;

/// A hall of columns with lights everywhere, as in any scene: between open and crowded.
Scene calibration_scene() {
  Scene scene = load_scene("one-tile");
  scene.placement = {};
  return scene;
}

/// A candidate under measurement at one point.
struct Timed {
  std::size_t candidate;
  Lighting lighting;
  FrameTimes times;
};

bool is_software(Context& context) { return context.row().kind == "CPU"; }

std::span<const MeasuredPoint> points_of(Context& context) {
  return is_software(context) ? std::span<const MeasuredPoint>(SOFTWARE_POINTS) : GPU_POINTS;
}

LightingInfo lighting_info(const AutoCandidate& candidate, const MeasuredPoint& point, bool software) {
  const Method& method = parse_method(std::string(candidate.method));
  const std::uint32_t capacity = software ? SOFTWARE_CAPACITY : point.lights;
  return {.method = &method,
          .options = take(resolve_options(method, candidate.settings())),
          .width = point.width,
          .height = point.height,
          .light_capacity = std::clamp(capacity, candidate.least_capacity, candidate.most_capacity)};
}

/// Whether it can be asked to take the point, and is.
bool takes(const AutoCandidate& candidate, const MeasuredPoint& point, bool software) {
  const std::uint64_t pairs = std::uint64_t{point.width} * point.height * point.lights;
  const bool can_walk_all = pairs <= (software ? SOFTWARE_PAIRS : GPU_PAIRS);
  return point.lights <= candidate.most_capacity && (candidate.walk != nullptr || can_walk_all);
}

/// Drivers take long to compile, so everything of every point is made once beforehand, by all threads; the device keeps
/// the pipelines.
void compile_all(Context& context, const ShaderLibrary& shaders) {
  const std::span<const AutoCandidate> candidates = auto_candidates();
  const std::span<const MeasuredPoint> points = points_of(context);
  const bool software = is_software(context);
  tbb::parallel_for(std::size_t{0}, points.size() * candidates.size(), [&](std::size_t i) {
    const AutoCandidate& candidate = candidates[i % candidates.size()];
    const MeasuredPoint& point = points[i / candidates.size()];
    if (!takes(candidate, point, software)) return;
    const Lighting compiled(context.device(), shaders, lighting_info(candidate, point, software));
  });
}

// A GPU that has slept for long is awake after that much work at the latest.
constexpr std::chrono::milliseconds WAKE_TIME(400);

View view_at(const Scene& scene, const MeasuredPoint& point) {
  return view_of(scene.cameras.front(), point.width, point.height, "camera");
}

/// Renders until then, and for WAKE_TIME at least: a GPU that waits falls asleep, and takes as long to wake as it
/// slept.
void keep_awake(Context& context, const ShaderLibrary& shaders, const Scene& scene, const GpuScene& gpu_scene,
                const std::future<void>& until) {
  const MeasuredPoint& point = points_of(context).front();
  Renderer renderer(context, shaders, gpu_scene, point.width, point.height, 1);
  renderer.set_frame(view_at(scene, point), {});
  Lighting lighting(context.device(), shaders, lighting_info(auto_candidates().front(), point, false));
  const auto begin = std::chrono::steady_clock::now();
  while (until.wait_for(std::chrono::seconds(0)) != std::future_status::ready ||
         std::chrono::steady_clock::now() - begin < WAKE_TIME)
    static_cast<void>(renderer.time(lighting, Timing::parts));
}

std::list<Timed> candidates_for(Context& context, const ShaderLibrary& shaders, const MeasuredPoint& point) {
  const std::span<const AutoCandidate> all = auto_candidates();
  const bool software = is_software(context);
  std::list<Timed> timed;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (takes(all[i], point, software))
      timed.push_back(
          {i, Lighting(context.device(), shaders, lighting_info(all[i], point, software)), FrameTimes(GPU_FRAMES)});
  return timed;
}

/// In turns, so that what changes with time (clocks, other work) meets all alike.
void time_rounds(Renderer& renderer, std::list<Timed>& timed, int frames) {
  for (int frame = 0; frame < WARM_UP + frames; ++frame)
    for (Timed& one : timed) {
      const std::vector<vulkan::Timestamps::Time> times = renderer.time(one.lighting, one.times.next());
      if (frame >= WARM_UP) one.times.add(times, one.lighting);
    }
}

/// The least of each: what disturbs a frame makes it longer, never shorter.
CostSample sample_of(const Timed& timed, const Workload& workload) {
  const auto least = [&](double FrameTime::* part) { return std::ranges::min(timed.times.frames(), {}, part).*part; };
  return {.workload = workload, .cull_ms = least(&FrameTime::cull_ms), .shade_ms = least(&FrameTime::shade_ms)};
}

}  // namespace

Calibration measure_calibration(Context& context, const ShaderLibrary& shaders) {
  const bool software = is_software(context);
  std::future<void> compiled = std::async(std::launch::async, [&] { compile_all(context, shaders); });
  const Scene scene = calibration_scene();
  const OpenAir air = find_open_air(scene);
  const GpuScene gpu_scene(context, scene);
  if (!software) keep_awake(context, shaders, scene, gpu_scene, compiled);
  compiled.get();
  auto before = std::chrono::steady_clock::now();
  const std::span<const AutoCandidate> candidates = auto_candidates();
  std::vector<std::vector<CostSample>> samples(candidates.size());
  for (const MeasuredPoint& point : points_of(context)) {
    Renderer renderer(context, shaders, gpu_scene, point.width, point.height,
                      std::max(point.lights, SOFTWARE_CAPACITY));
    const View view = view_at(scene, point);
    const std::vector<shared::Light> lights =
        pack(place_lights(air, {.count = point.lights, .min_range = point.range, .max_range = point.range}));
    renderer.set_frame(view, lights);
    Workload workload = estimate_workload(view, renderer.draw_depth(), lights);
    if (software) workload.capacity = SOFTWARE_CAPACITY;
    std::list<Timed> timed = candidates_for(context, shaders, point);
    const std::chrono::duration<double, std::milli> waited = std::chrono::steady_clock::now() - before;
    if (!software) wake(renderer, timed.front().lighting, waited.count());  // the host had work
    time_rounds(renderer, timed, software ? SOFTWARE_FRAMES : GPU_FRAMES);
    for (const Timed& one : timed) samples[one.candidate].push_back(sample_of(one, workload));
    before = std::chrono::steady_clock::now();
  }
  Calibration calibration{.device = context.row().name, .driver = context.row().driver};
  for (std::size_t i = 0; i < candidates.size(); ++i) calibration.costs.push_back(fit_cost(candidates[i], samples[i]));
  return calibration;
}

}  // namespace lamp::app
