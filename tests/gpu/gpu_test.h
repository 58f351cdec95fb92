// What every test on a device shares: one context with core and synchronization validation on, and a fixture that fails
// the test in which a message came.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <functional>

#include "gpu/check.h"
#include "render/renderer.h"

namespace lamp {
/// The tests' own shaders, below tests/gpu/shaders.
[[nodiscard]] std::span<const ShaderCode> test_shaders();
}  // namespace lamp

namespace lamp::app {

/// The device of the test run: LAMPLIGHT_TEST_DEVICE (number or part of a name), else the best. It is made without push
/// descriptors where it has none, or where LAMPLIGHT_TEST_DESCRIPTORS is "sets".
[[nodiscard]] Context& test_context();
[[nodiscard]] const ShaderLibrary& shader_library();

/// A shader of the tests' own, by name.
[[nodiscard]] std::span<const std::uint32_t> test_shader(std::string_view name);

/// Calls `release` before the context goes: for what tests keep between each other. Last come, first released.
void at_context_end(std::function<void()> release);

/// At the beginning of a test, or of a fixture's SetUp.
#define LAMP_SKIP_WITHOUT_DOUBLES() \
  if (!test_context().has_doubles()) GTEST_SKIP() << "the device lacks the feature shaderFloat64"

class GpuTest : public ::testing::Test {
 protected:
  void TearDown() override {
    for (const std::string& message : test_context().take_messages()) ADD_FAILURE() << message;
  }
};

}  // namespace lamp::app
