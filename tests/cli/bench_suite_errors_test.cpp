// What a suite asks for in vain is said in the suite's own words before any work: its file, series and key.
// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "cli/cli_test.h"

namespace lamp::cli {
namespace {

struct Fault {
  std::string members;  ///< of a series
  std::string says;
};

class SuiteErrors : public CliTest {
 protected:
  void expect_faults(const std::string& scene, const std::vector<Fault>& faults) const {
    for (const Fault& fault : faults) {
      SCOPED_TRACE(fault.members);
      const std::string methods =
          fault.members.find("\"methods\"") == std::string::npos ? R"("methods": ["tiled"], )" : "";
      write("mine.json", fmt::format(R"({{"version": 1, "name": "mine", "series": [{{"name": "one", "scenes": ["{}"],
        {} {}}}]}})",
                                     scene, methods, fault.members));
      const Outcome outcome = lamp({"bench", "mine.json", "--out", "out"});
      EXPECT_EQ(outcome.exit_code, BAD_INPUT) << outcome.out;
      EXPECT_TRUE(outcome.err.starts_with("lamp: mine.json: series 'one': " + fault.says)) << outcome.err;
      EXPECT_EQ(outcome.err.find("--"), std::string::npos) << "a suite has no options: " << outcome.err;
    }
  }
};

TEST_F(SuiteErrors, NameKeys) {
  expect_faults(
      "plane",
      {{R"("sizes": ["8"])", "sizes '8': expected WIDTHxHEIGHT"},
       {R"("ranges": ["5:1"])", "ranges '5:1': expected MIN:MAX"},
       {R"("paths": ["defered"])", "paths 'defered': there is none of that name"},
       {R"("projections": ["flat"])", "projections 'flat': there is none of that name"},
       {R"("methods": [{"name": "tiled", "path": "defered"}])", "methods: path: expected "},
       {R"("depth_samples": 3)", "depth_samples 3: expected 1, 2, 4 or 8"},
       {R"("shadows": "soft")", "shadows 'soft': there is none of that name"},
       {R"("stereo": 0.06, "sizes": ["9x8"])", "sizes 9x8: with stereo expected an even width"},
       {R"("methods": [{"name": "tiled", "still_occlusion": 8}])", "still_occlusion 8: there are no lists"},
       {R"("methods": [{"name": "tiled", "still_bytes": 8}])", "still_bytes 8: there are no lists"},
       {R"("methods": [{"name": "tiled", "still_lists": "world-tree"}], "still": 1, "paths": ["standard-deferred"])",
        "paths standard-deferred: walks no lists"},
       {R"("methods": [{"name": "tiled", "still_lists": "world-tree"}], "still": 1, "mirror": 0.5)",
        "mirror: with still_lists world-tree "},
       {R"("methods": ["auto"], "options": {"tile": ["8"]})", "options: belongs to one method"},
       {R"("methods": [{"name": "tiled", "options": ["occlusion=radial"]}])",
        "options occlusion=radial: cuts lights by their shadow maps; expected shadows FILTER too"}});
}

// As the command line refuses it.
TEST_F(SuiteErrors, SayWhatACaptureCannotHave) {
  (void)output_of({"capture", "plane", "--size", "48x27", "--lights", "8", "--out", "frame"});
  const std::string size = R"("sizes": ["48x27"], )";
  expect_faults("frame",
                {{R"("sizes": ["8x8"])", "sizes '8x8': the capture frame has 48x27 pixels"},
                 {size + R"("cameras": ["nowhere"])", "frame: camera 'nowhere'"},
                 {size + R"("projections": ["infinite"])", "projections 'infinite': the capture frame has its own"},
                 {size + R"("frame": 3)", "frame, frames: the capture frame is one frame"},
                 {size + R"("depth": "standard")", "depth standard: the capture frame is kept with reversed depth"},
                 {size + R"("depth_samples": 4)", "depth_samples 4: the capture frame has one sample a pixel"},
                 {size + R"("stereo": 0.06)", "stereo: the capture frame is one view"},
                 {size + R"("shadows": "pcf")", "shadows pcf: the capture frame has no triangles"},
                 {size + R"("mirror": 0.5)", "mirror: the capture frame has no triangles"},
                 {size + R"("probes": [4])", "scene 'frame': a captured frame has no surfaces that probes"},
                 {size + R"("decals": [4])", "decals 4: the capture frame has its decals"},
                 {size + R"("still": 1, "methods": [{"name": "tiled", "still_lists": "world-tree"}])",
                  "still_lists world-tree: the capture frame has no triangles"}});
}

}  // namespace
}  // namespace lamp::cli
