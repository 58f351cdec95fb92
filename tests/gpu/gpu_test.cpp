// The context of the test run.
// SPDX-License-Identifier: Apache-2.0
#include "gpu/gpu_test.h"

#include <cstdlib>
#include <optional>
#include <vector>

namespace lamp::app {
namespace {

std::optional<Context> the_context;
std::vector<std::function<void()>> releases;

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

/// Destroys the context before main returns, while the driver is still whole; its last messages count too.
class ContextEnvironment : public ::testing::Environment {
 public:
  void SetUp() override {
    the_context.emplace(ContextInfo{.device = environment("LAMPLIGHT_TEST_DEVICE"),
                                    .validation = ContextInfo::Validation::on,
                                    .push_descriptors = environment("LAMPLIGHT_TEST_DESCRIPTORS") != "sets"});
  }
  void TearDown() override {
    for (; !releases.empty(); releases.pop_back()) releases.back()();
    for (const std::string& message : the_context->take_messages()) ADD_FAILURE() << message;
    the_context.reset();
  }
};

}  // namespace

Context& test_context() { return *the_context; }

const ShaderLibrary& shader_library() {
  static const ShaderLibrary shaders;
  return shaders;
}

std::span<const std::uint32_t> test_shader(std::string_view name) {
  const ShaderCode* code = find_shader(test_shaders(), name);
  if (code == nullptr) throw Error("there is no test shader named " + std::string(name));
  return code->spirv;
}

void at_context_end(std::function<void()> release) { releases.push_back(std::move(release)); }

}  // namespace lamp::app

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  testing::AddGlobalTestEnvironment(new lamp::app::ContextEnvironment);
  return RUN_ALL_TESTS();
}
