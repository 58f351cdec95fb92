// What every test on a device shares: one context with core and synchronization validation on, and a fixture that fails
// the test in which a message came.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include "gpu/check.h"
#include "render/renderer.h"

namespace lamp::app {

/// The device of the test run: LAMPLIGHT_TEST_DEVICE (number or part of a name), else the best.
[[nodiscard]] Context& test_context();
[[nodiscard]] const ShaderLibrary& test_shaders();

class GpuTest : public ::testing::Test {
 protected:
  void TearDown() override {
    for (const std::string& message : test_context().take_messages()) ADD_FAILURE() << message;
  }
};

}  // namespace lamp::app
