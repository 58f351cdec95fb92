// Makes the device once.
// SPDX-License-Identifier: Apache-2.0
#include "view/view_test.h"

#include <fstream>
#include <iterator>

namespace lamp::app {

Context& view_context() {
  static Context context({.validation = ContextInfo::Validation::on});
  return context;
}

HeadlessInfo small_viewer() {
  HeadlessInfo info{.state = {}, .screen = {720, 480}};
  Request& request = info.state.request;
  request.scene = "plane";
  request.size = "96x54";
  request.size_given = true;
  request.lights = 32;
  request.lights_given = true;
  request.method = "tiled";
  info.state.paused = true;
  return info;
}

std::string bytes_of_file(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

}  // namespace lamp::app
