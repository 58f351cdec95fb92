// Measures what the cost model is fitted to: each candidate on a few sizes and counts of lights.
// Promise: the lights and the picture are always the same; only times differ.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <functional>
#include <future>
#include <list>
#include <memory>
#include <optional>
#include <vector>

#include "commands/calibration.h"
#include "commands/request.h"
#include "gpu/check.h"
#include "render/frame_times.h"
#include "scene/flight.h"
#include "scene/place_lights.h"
#include "system/progress.h"

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

std::span<const MeasuredPoint> points_of(Context& context) {
  return context.software() ? std::span<const MeasuredPoint>(SOFTWARE_POINTS) : GPU_POINTS;
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

/// Of each point each candidate that takes it, or none yet.
struct Compiled {
  std::vector<std::vector<std::optional<Lighting>>> points;
  bool all_wait = true;  ///< there is room for all of them
};

// Of the device's memory, for buffers of plans that wait for their turn.
constexpr std::uint64_t WAITING_SHARE = 8;

/// Drivers take long to compile, so everything of every point is made beforehand, by all threads. What has no room to
/// wait is made again when its turn comes; the device keeps the pipelines.
Compiled compile_all(Context& context, const ShaderLibrary& shaders) {
  const std::span<const AutoCandidate> candidates = auto_candidates();
  const std::span<const MeasuredPoint> points = points_of(context);
  const bool software = context.software();
  const std::uint64_t room = context.device().traits.memory_bytes / WAITING_SHARE;
  std::atomic<std::uint64_t> taken = 0;
  Compiled compiled{.points = std::vector<std::vector<std::optional<Lighting>>>(points.size())};
  for (auto& of_point : compiled.points) of_point.resize(candidates.size());
  tbb::parallel_for(std::size_t{0}, points.size() * candidates.size(), [&](std::size_t i) {
    const AutoCandidate& candidate = candidates[i % candidates.size()];
    const MeasuredPoint& point = points[i / candidates.size()];
    if (!takes(candidate, point, software)) return;
    Lighting lighting(context.device(), shaders, lighting_info(candidate, point, software));
    const std::uint64_t bytes = lighting.runner().plan().bytes();
    if (taken.fetch_add(bytes) + bytes <= room)
      compiled.points[i / candidates.size()][i % candidates.size()] = std::move(lighting);
  });
  compiled.all_wait = taken <= room;
  return compiled;
}

// A GPU that has slept for long is awake after that much work at the latest.
constexpr std::chrono::milliseconds WAKE_TIME(400);

/// A picture of points of one size, without lights: they have the same depths.
struct Picture {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  View view;
  std::unique_ptr<Renderer> renderer;
  std::vector<float> depth;
};

/// For every point, in their order.
std::vector<std::shared_ptr<const Picture>> make_pictures(Context& context, const ShaderLibrary& shaders,
                                                          const Scene& scene, const GpuScene& gpu_scene) {
  std::uint32_t most_lights = SOFTWARE_CAPACITY;
  for (const MeasuredPoint& point : points_of(context)) most_lights = std::max(most_lights, point.lights);
  std::vector<std::shared_ptr<const Picture>> pictures;
  for (const MeasuredPoint& point : points_of(context)) {
    const auto is_size = [&](const auto& one) { return one->width == point.width && one->height == point.height; };
    if (const auto found = std::ranges::find_if(pictures, is_size); found != pictures.end()) {
      pictures.push_back(*found);
      continue;
    }
    auto renderer = std::make_unique<Renderer>(context, shaders, gpu_scene, point.width, point.height, most_lights);
    const View view = view_of(scene.cameras.front(), point.width, point.height, "camera");
    renderer->set_frame(view, {});
    std::vector<float> depth = renderer->draw_depth();
    renderer->keep_surfaces();  // frames that copy them take less time
    pictures.push_back(
        std::make_shared<Picture>(Picture{point.width, point.height, view, std::move(renderer), std::move(depth)}));
  }
  return pictures;
}

/// The lights of a point, and what they mean to its picture.
struct LightLoad {
  std::vector<shared::Light> lights;
  Workload workload;
};

std::vector<LightLoad> make_loads(Context& context, const Scene& scene,
                                  const std::vector<std::shared_ptr<const Picture>>& pictures) {
  const OpenAir air = find_open_air(scene);
  const std::span<const MeasuredPoint> points = points_of(context);
  std::vector<LightLoad> loads(points.size());
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t i) {
    const float range = points[i].range;
    loads[i].lights = pack(place_lights(air, {.count = points[i].lights, .min_range = range, .max_range = range}));
    loads[i].workload = estimate_workload(pictures[i]->view, pictures[i]->depth, loads[i].lights);
    if (context.software()) loads[i].workload.capacity = SOFTWARE_CAPACITY;
  });
  return loads;
}

/// Renders until that is there, and for WAKE_TIME at least: a GPU that waits falls asleep, and takes as long to wake as
/// it slept.
void keep_awake(Context& context, const ShaderLibrary& shaders, Renderer& renderer,
                const std::function<bool()>& is_there) {
  const LightingInfo info = lighting_info(auto_candidates().front(), points_of(context).front(), false);
  Lighting lighting(context.device(), shaders, info);
  const auto begin = std::chrono::steady_clock::now();
  while (!is_there() || std::chrono::steady_clock::now() - begin < WAKE_TIME)
    static_cast<void>(renderer.time(lighting, Timing::parts));
}

template <class Result>
bool is_ready(const std::future<Result>& result) {
  return result.wait_for(std::chrono::seconds(0)) == std::future_status::ready;
}

std::list<Timed> candidates_for(Context& context, const ShaderLibrary& shaders, const MeasuredPoint& point,
                                std::vector<std::optional<Lighting>>& compiled) {
  const std::span<const AutoCandidate> all = auto_candidates();
  const bool software = context.software();
  std::list<Timed> timed;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!takes(all[i], point, software)) continue;
    if (!compiled[i]) compiled[i].emplace(context.device(), shaders, lighting_info(all[i], point, software));
    timed.push_back({i, std::move(*compiled[i]), FrameTimes(GPU_FRAMES)});
    compiled[i].reset();
  }
  return timed;
}

/// In turns, so that what changes with time (clocks, other work) meets all alike.
void time_rounds(Renderer& renderer, std::list<Timed>& timed, int frames) {
  for (Timed& one : timed) renderer.warm_up(one.lighting);
  for (int frame = 0; frame < frames; ++frame)
    for (Timed& one : timed) one.times.add(renderer.time(one.lighting, one.times.next()), one.lighting);
}

/// The least of each: what disturbs a frame makes it longer, never shorter.
CostSample sample_of(const Timed& timed, const Workload& workload) {
  const auto least = [&](double FrameTime::* part) { return std::ranges::min(timed.times.frames(), {}, part).*part; };
  return {.workload = workload, .cull_ms = least(&FrameTime::cull_ms), .shade_ms = least(&FrameTime::shade_ms)};
}

}  // namespace

Calibration measure_calibration(Context& context, const ShaderLibrary& shaders) {
  const bool software = context.software();
  const Scene scene = calibration_scene();
  const GpuScene gpu_scene(context, scene);
  auto compiling = std::async(std::launch::async, [&] { return compile_all(context, shaders); });
  const auto pictures = make_pictures(context, shaders, scene, gpu_scene);
  auto loading = std::async(std::launch::async, [&] { return make_loads(context, scene, pictures); });
  const auto is_there = [&] { return is_ready(compiling) && is_ready(loading); };
  if (!software) keep_awake(context, shaders, *pictures.front()->renderer, is_there);
  Compiled compiled = compiling.get();
  const std::vector<LightLoad> loads = loading.get();
  const std::span<const AutoCandidate> candidates = auto_candidates();
  std::vector<std::vector<CostSample>> samples(candidates.size());
  // Kept where there is room: to free memory takes time, in which the GPU falls asleep.
  std::list<std::list<Timed>> timed_all;
  Progress progress;
  for (std::size_t i = 0; i < loads.size(); ++i) {
    progress.show(fmt::format("auto: measure frame {} of {}", i + 1, loads.size()),
                  static_cast<double>(i) / static_cast<double>(loads.size()));
    Renderer& renderer = *pictures[i]->renderer;
    renderer.set_frame(pictures[i]->view, loads[i].lights);
    std::list<Timed>& timed =
        timed_all.emplace_back(candidates_for(context, shaders, points_of(context)[i], compiled.points[i]));
    time_rounds(renderer, timed, software ? SOFTWARE_FRAMES : GPU_FRAMES);
    for (const Timed& one : timed) samples[one.candidate].push_back(sample_of(one, loads[i].workload));
    if (!compiled.all_wait) timed_all.clear();
  }
  progress.clear();
  Calibration calibration{.device = context.row().name, .driver = context.row().driver};
  for (std::size_t i = 0; i < candidates.size(); ++i) calibration.costs.push_back(fit_cost(candidates[i], samples[i]));
  return calibration;
}

}  // namespace lamp::app
