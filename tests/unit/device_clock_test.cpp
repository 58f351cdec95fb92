// Clocks of GPUs as Linux's drivers write them: what the files say, and nothing where they say nothing.
// SPDX-License-Identifier: Apache-2.0
#include "gpu/device_clock.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "gpu/nvml.h"
#include "temporary_folder.h"

namespace lamp::app {
namespace {

namespace fs = std::filesystem;

class DeviceClockFiles : public ::testing::Test {
 protected:
  void write(const fs::path& name, const std::string& text) const {
    fs::create_directories((folder_.path() / name).parent_path());
    std::ofstream(folder_.path() / name) << text;
  }
  [[nodiscard]] std::string words() const {
    const std::optional<Clock> clock = clock_in(folder_.path());
    return clock ? words_of(*clock) : "nothing";
  }

 private:
  TemporaryFolder folder_;
};

TEST_F(DeviceClockFiles, SayNothingWhereThereAreNone) {
  EXPECT_EQ(words(), "nothing");
  EXPECT_FALSE(clock_in("/nonexistent").has_value());
}

TEST_F(DeviceClockFiles, OfAmdHaveAStarAtTheLevelInUse) {
  write("pp_dpm_sclk", "0: 500Mhz \n1: 1256Mhz *\n2: 2660Mhz \n");
  EXPECT_EQ(words(), "1256 of at most 2660 MHz (amdgpu)");
}

TEST_F(DeviceClockFiles, OfAmdMayHaveALevelOfSleep) {
  write("pp_dpm_sclk", "S: 19Mhz *\n0: 615Mhz \n1: 800Mhz \n2: 888Mhz \n");
  EXPECT_EQ(words(), "19 of at most 888 MHz (amdgpu)");
}

TEST_F(DeviceClockFiles, OfAmdMayBeEmptyOrOfAnotherForm) {
  for (const char* text :
       {"", "\n", "0: 500Mhz\n1: 900Mhz\n", "0: fastMhz *\n", "1200Mhz *\n", "0: 99999999999Mhz *\n"}) {
    write("pp_dpm_sclk", text);
    EXPECT_EQ(words(), "nothing") << text;
  }
}

TEST_F(DeviceClockFiles, OfIntelAreBelowItsCard) {
  write("drm/renderD128/dev", "226:128\n");
  write("drm/card1/gt_cur_freq_mhz", "350\n");
  EXPECT_EQ(words(), "350 MHz (i915)");
  write("drm/card1/gt_RP0_freq_mhz", "1150\n");
  EXPECT_EQ(words(), "350 of at most 1150 MHz (i915)");
  write("drm/card1/gt/gt0/rps_cur_freq_mhz", "700\n");
  write("drm/card1/gt/gt0/rps_RP0_freq_mhz", "2400\n");
  EXPECT_EQ(words(), "700 of at most 2400 MHz (i915)");
}

TEST_F(DeviceClockFiles, OfIntelsNewDriverAreBelowTheDevice) {
  write("tile0/gt0/freq0/cur_freq", "1900\n");
  write("tile0/gt0/freq0/rp0_freq", "2400\n");
  EXPECT_EQ(words(), "1900 of at most 2400 MHz (xe)");
}

TEST(DeviceClockWords, SayPlainlyWhereNothingTells) { EXPECT_EQ(words_of(Clock()), "this driver does not tell"); }

/// Whether NVIDIA's library is there or not.
TEST(DeviceClockOfNvidia, IsNothingForADeviceThatThereIsNot) {
  EXPECT_FALSE(Nvml("ffff:ff:1f.7", "GPU-00000000-0000-0000-0000-000000000000").clock().has_value());
}

}  // namespace
}  // namespace lamp::app
