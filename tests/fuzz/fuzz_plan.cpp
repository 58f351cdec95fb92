// Fuzzes planning. Any problem gives a plan or an Error; any plan that plan_check passes, of a method or made of random
// parts, runs on a device that is all assertions: it says no to what Vulkan would say no to.
// Seeds: corpus_plan/. Build with -DLAMPLIGHT_FUZZ=ON. First byte even: a problem; odd: a plan of random parts.
// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <span>
#include <string>

#include "lamplight/method.h"
#include "lamplight/shader_code.h"
#include "lamplight/shared/counters.h"

namespace {

using namespace lamp;

void require(bool holds) {
  if (!holds) std::abort();
}

/// Reads the input from front to back; zeros follow its end.
class Reader {
 public:
  explicit Reader(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}
  template <class T>
  T number() {
    T value{};
    const std::size_t size = std::min(sizeof(T), bytes_.size());
    if (size != 0) std::memcpy(&value, bytes_.data(), size);
    bytes_ = bytes_.subspan(size);
    return value;
  }
  std::uint8_t below(std::uint8_t end) { return static_cast<std::uint8_t>(number<std::uint8_t>() % end); }
  bool flag() { return below(2) == 1; }
  std::string text() {
    const std::size_t size = std::min<std::size_t>(number<std::uint8_t>(), bytes_.size());
    std::string text(reinterpret_cast<const char*>(bytes_.data()), size);
    bytes_ = bytes_.subspan(size);
    return text;
  }

 private:
  std::span<const std::uint8_t> bytes_;
};

/// Runs passes the way the plan runner does, with an eye on what Vulkan forbids.
class StrictDevice {
 public:
  StrictDevice(const Plan& plan, const DeviceTraits& traits) : plan_(plan), traits_(traits) {
    for (const BufferDesc& buffer : plan.buffers) {
      require(buffer.bytes >= 4 && buffer.bytes % 4 == 0 && buffer.bytes <= traits.max_storage_buffer_bytes);
      filled_.push_back(buffer.zeroed);
    }
  }

  /// `counters`: the one buffer that the look-up may write.
  void run(const std::vector<Pass>& passes, const LookUp& lookup, ResourceId counters) {
    for (const Pass& pass : passes) {
      if (pass.kind == PassKind::host) {
        run_host(pass);
      } else {
        gpu_began_ = true;
        if (pass.kind == PassKind::compute) dispatch(pass);
        if (pass.kind == PassKind::raster) draw(pass);
      }
      const bool host = pass.kind == PassKind::host;
      if (!host) count_buffers(pass.bindings);
      for (const Binding& binding : pass.bindings) bind(binding, host, pass.on_projection_change);
      for (const Binding& binding : pass.bindings)
        if (binding.access != Access::read) filled_.at(binding.resource - PLAN_BUFFER) = true;
    }
    for (std::size_t i = 0; i < filled_.size(); ++i) require(filled_[i] || !plan_.buffers[i].zeroed_by_pass);
    require(!lookup.name.empty());
    count_buffers(lookup.bindings);
    for (const Binding& binding : lookup.bindings) {
      require(binding.access == Access::read || (counters != NO_RESOURCE && binding.resource == counters));
      bind(binding, /* by_host= */ false, /* in_kept_pass= */ false);
    }
  }

 private:
  void bind(const Binding& binding, bool by_host, bool in_kept_pass) const {
    if (binding.resource < PLAN_BUFFER) return require(!by_host && binding.access == Access::read);
    const BufferDesc& buffer = plan_.buffers.at(binding.resource - PLAN_BUFFER);
    if (binding.access != Access::write) require(filled_.at(binding.resource - PLAN_BUFFER));
    require(!in_kept_pass || !buffer.begins_at_zero());
    if (by_host || binding.access != Access::read) require(by_host == (buffer.memory == BufferMemory::upload));
  }

  void count_buffers(const std::vector<Binding>& bindings) const {
    std::uint32_t buffers = 0;
    for (const Binding& binding : bindings)
      if (binding.resource != INPUT_DEPTH) ++buffers;
    require(buffers <= traits_.max_storage_buffers);
  }

  void run_host(const Pass& pass) const {
    require(!gpu_began_ && pass.host != nullptr);
    for (const Binding& binding : pass.bindings)
      require(!plan_.buffers.at(binding.resource - PLAN_BUFFER)
                   .begins_at_zero());  // the fill would come after the host's writes
  }

  void dispatch(const Pass& pass) const {
    const ShaderCode* shader = find_shader(library_shaders(), pass.shader);
    require(shader->source.ends_with(".comp"));
    require(shared_bytes(shader->spirv, pass.constants) <= traits_.shared_memory_bytes);
    if (pass.extent.indirect != NO_RESOURCE) return read_arguments(pass.extent, 3);
    const auto counts = pass.extent.counts(plan_.width, plan_.height, std::max(1U, plan_.light_capacity));
    for (std::size_t axis = 0; axis < counts.size(); ++axis)
      require(counts[axis] >= 1 && counts[axis] <= traits_.max_groups[axis]);
    if (pass.extent.lights_per_group == 0) return;
    // All lights find a thread: groups * lights_per_group >= lights.
    const std::uint64_t lights = plan_.light_capacity;
    require(std::uint64_t{traits_.max_groups[0]} * pass.extent.lights_per_group >= lights);
  }

  void draw(const Pass& pass) const {
    require(find_shader(library_shaders(), pass.shader)->source.ends_with(".frag"));
    require(find_shader(library_shaders(), pass.raster.vertex_shader)->source.ends_with(".vert"));
    require(pass.raster.pixel != 0);
    const CellGrid viewport{.px = pass.raster.pixel};
    require(viewport.across(plan_.width) - 1 < traits_.max_image_size);
    require(viewport.across(plan_.height) - 1 < traits_.max_image_size);
    require(pass.raster.samples == 1 || pass.raster.samples == 4);
    if (pass.extent.indirect != NO_RESOURCE) read_arguments(pass.extent, 4);
  }

  void read_arguments(const Extent& extent, std::uint64_t words) const {
    const BufferDesc& buffer = plan_.buffers.at(extent.indirect - PLAN_BUFFER);
    require(buffer.indirect && filled_.at(extent.indirect - PLAN_BUFFER) && extent.indirect_offset % 4 == 0);
    require(extent.indirect_offset / 4 <= buffer.bytes / 4 && buffer.bytes / 4 - extent.indirect_offset / 4 >= words);
  }

  const Plan& plan_;
  const DeviceTraits& traits_;
  std::vector<bool> filled_;
  bool gpu_began_ = false;
};

void run_everything(const Plan& plan, const DeviceTraits& traits) {
  require(plan.light_layout.light_bytes(plan.light_capacity) <= traits.max_storage_buffer_bytes);
  require(plan.light_layout.cone_bytes(plan.light_capacity) <= traits.max_storage_buffer_bytes);
  require(plan.cells >= 1);
  if (plan.counters != NO_RESOURCE) {
    const BufferDesc& counters = plan.buffers.at(plan.counters - PLAN_BUFFER);
    require(counters.begins_at_zero() && counters.bytes >= sizeof(shared::Counters));
  }
  StrictDevice(plan, traits).run(plan.passes, plan.lookup, NO_RESOURCE);
  if (!plan.fused) return;
  require(plan.fused->group_width >= 1 && plan.fused->group_height >= 1);
  require(plan.fused->group_width <= traits.max_group_invocations / plan.fused->group_height);
  StrictDevice(plan, traits).run(plan.fused->passes, plan.fused->lookup, plan.counters);
}

/// Any limits that a Vulkan 1.3 device could report.
DeviceTraits read_traits(Reader& in) {
  DeviceTraits traits;
  traits.max_storage_buffer_bytes = in.number<std::uint32_t>();
  for (std::uint32_t& groups : traits.max_groups) groups = in.number<std::uint32_t>();
  traits.max_group_invocations = std::max(in.number<std::uint32_t>(), traits.max_group_invocations);
  traits.shared_memory_bytes = std::max(in.number<std::uint32_t>(), traits.shared_memory_bytes);
  traits.max_image_size = in.number<std::uint32_t>();
  return traits;
}

/// Often without a fault.
RecordPlaces read_places(Reader& in) {
  if (in.flag()) return {.offset = in.number<std::uint32_t>(), .stride = in.number<std::uint32_t>()};
  return {.offset = in.number<std::uint8_t>() * 16U, .stride = in.number<std::uint8_t>() * 16U};
}

/// Often a key of the method with a value that it might take, else any text.
std::string read_setting(Reader& in, const Method& method) {
  if (method.options.empty() || in.below(4) == 0) return in.text();
  const OptionSpec& spec = method.options[in.number<std::uint8_t>() % method.options.size()];
  const std::string key = std::string(spec.key) + "=";
  if (in.below(4) == 0) return key + in.text();
  if (!spec.choices.empty()) return key + std::string(spec.choices[in.number<std::uint8_t>() % spec.choices.size()]);
  return key + std::to_string(spec.min + in.number<std::uint32_t>() % (spec.max - spec.min + 1));
}

/// With the method's defaults: a row names the look-up of the plain walk.
std::string default_lookup(const Method& method, const Problem& problem) {
  const auto walk = problem.options.all().find("walk");
  const bool scalar = walk != problem.options.all().end() && walk->second != "plain";
  return std::string(method.result) + (scalar && problem.traits.compute_subgroups.ballot ? "_scalar" : "");
}

void plan_a_problem(Reader& in) {
  const Method& method = methods()[in.number<std::uint8_t>() % methods().size()];
  Problem problem{.width = in.number<std::uint32_t>(),
                  .height = in.number<std::uint32_t>(),
                  .light_capacity = in.number<std::uint32_t>(),
                  .traits = read_traits(in)};
  std::vector<std::string> settings(in.below(6));
  for (std::string& setting : settings) setting = read_setting(in, method);
  Result<Options> options = resolve_options(method, settings);
  if (!options) return require(!options.error().text().empty());
  require(options.value().all().size() == method.options.size());
  problem.options = std::move(options.value());

  if (in.flag()) problem.traits.compute_subgroups = problem.traits.fragment_subgroups = {};

  problem.light_layout = {
      .form = static_cast<LightForm>(in.below(4)), .lights = read_places(in), .cones = read_places(in)};
  problem.own_spheres = in.flag();

  const Result<Plan> plan = make_plan(method, problem);
  if (!plan) return require(!plan.error().text().empty());
  run_everything(plan.value(), problem.traits);
  require(plan.value().light_capacity == problem.light_capacity);
  require(!settings.empty() || plan.value().lookup.name == default_lookup(method, problem));
}

ResourceId read_resource(Reader& in) {
  const std::uint8_t id = in.below(12);
  return id == 10 ? NO_RESOURCE : id == 11 ? in.number<ResourceId>() : id;
}

std::vector<Binding> read_bindings(Reader& in) {
  std::vector<Binding> bindings(in.below(5));
  for (Binding& binding : bindings) binding = {read_resource(in), static_cast<Access>(in.below(3))};
  return bindings;
}

std::string read_shader(Reader& in) {
  const std::uint8_t index = in.number<std::uint8_t>();
  return index == 0 ? in.text() : std::string(library_shaders()[index % library_shaders().size()].name);
}

std::vector<Pass> read_passes(Reader& in) {
  std::vector<Pass> passes(in.below(5));
  for (Pass& pass : passes) {
    pass.kind = static_cast<PassKind>(in.below(3));
    pass.bindings = read_bindings(in);
    if (in.flag()) pass.host = [](const HostContext&) {};
    pass.on_projection_change = in.below(4) == 1;
    if (pass.kind == PassKind::host) continue;
    if (in.flag()) pass.constants.assign(1 + in.below(12), in.number<std::uint32_t>());
    pass.shader = read_shader(in);
    if (in.flag())
      pass.extent = {.x = in.number<std::uint32_t>(),
                     .y = in.number<std::uint32_t>(),
                     .z = in.number<std::uint32_t>(),
                     .lights_per_group = in.number<std::uint32_t>()};
    if (in.flag()) {
      pass.extent.cells = {.px = in.number<std::uint8_t>(), .layers = in.number<std::uint8_t>()};
      pass.extent.cells_per_group = in.number<std::uint8_t>();
    }
    if (in.flag()) {
      pass.extent.indirect = read_resource(in);
      pass.extent.indirect_offset = in.flag() ? in.number<std::uint64_t>() : in.number<std::uint8_t>();
    }
    if (pass.kind == PassKind::raster)
      pass.raster = {
          .vertex_shader = read_shader(in), .pixel = in.number<std::uint8_t>(), .samples = in.number<std::uint32_t>()};
  }
  return passes;
}

LookUp read_lookup(Reader& in) { return {.name = in.flag() ? in.text() : "lists", .bindings = read_bindings(in)}; }

void check_a_random_plan(Reader& in) {
  const DeviceTraits traits = in.flag() ? read_traits(in) : DeviceTraits{};
  Plan plan;
  plan.buffers.resize(in.below(7));
  for (BufferDesc& buffer : plan.buffers)
    buffer = {.name = "buffer",
              .bytes = in.flag() ? in.number<std::uint64_t>() : in.number<std::uint8_t>() * 4U,
              .memory = static_cast<BufferMemory>(in.below(3)),
              .zeroed = in.flag(),
              .zeroed_by_pass = in.flag(),
              .indirect = in.flag()};
  plan.light_capacity = in.flag() ? in.number<std::uint32_t>() : 100;
  plan.cells = in.number<std::uint8_t>();
  plan.counters = in.flag() ? read_resource(in) : NO_RESOURCE;
  plan.passes = read_passes(in);
  plan.lookup = read_lookup(in);
  if (in.flag())
    plan.fused = FusedLookUp{.lookup = read_lookup(in),
                             .passes = read_passes(in),
                             .group_width = in.number<std::uint32_t>(),
                             .group_height = in.number<std::uint32_t>()};
  if (const auto error = plan_check(plan, traits)) return require(!error->message.empty());
  run_everything(plan, traits);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Reader in(std::span(data, size));
  if (in.flag())
    check_a_random_plan(in);
  else
    plan_a_problem(in);
  return 0;
}
