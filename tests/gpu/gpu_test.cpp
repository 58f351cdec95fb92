// The context of the test run.
// SPDX-License-Identifier: Apache-2.0
#include "gpu/gpu_test.h"

#include <cstdlib>
#include <optional>

namespace lamp::app {
namespace {

std::optional<Context> the_context;

/// Destroys the context before main returns, while the driver is still whole; its last messages count too.
class ContextEnvironment : public ::testing::Environment {
 public:
  void SetUp() override {
    const char* device = std::getenv("LAMPLIGHT_TEST_DEVICE");
    the_context.emplace(
        ContextInfo{.device = device == nullptr ? "" : device, .validation = ContextInfo::Validation::on});
  }
  void TearDown() override { the_context.reset(); }
};

}  // namespace

Context& test_context() { return *the_context; }

const ShaderLibrary& test_shaders() {
  static const ShaderLibrary shaders;
  return shaders;
}

}  // namespace lamp::app

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  testing::AddGlobalTestEnvironment(new lamp::app::ContextEnvironment);
  return RUN_ALL_TESTS();
}
