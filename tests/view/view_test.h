// What tests of the window's parts share: one device with validation on, and a viewer of a picture that takes no time.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>

#include "temporary_folder.h"
#include "view/headless.h"

namespace lamp::app {

[[nodiscard]] Context& view_context();

/// A plane of 96 x 54 pixels with 32 lights, tiled, that stands still, on a screen of 720 x 480.
[[nodiscard]] HeadlessInfo small_viewer();

/// In an empty folder, which goes with it.
class InFolder : public ::testing::Test {
 protected:
  InFolder() { std::filesystem::current_path(folder_.path()); }
  ~InFolder() override { std::filesystem::current_path(was_); }

 private:
  std::filesystem::path was_ = std::filesystem::current_path();
  TemporaryFolder folder_;
};

[[nodiscard]] std::string bytes_of_file(const std::filesystem::path& file);

}  // namespace lamp::app
