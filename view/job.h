// What a viewer asks of its stage, and what comes back: performed at once, or by a thread of its own.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>

#include "view/stage.h"

namespace lamp::app {

struct Job {
  enum class Kind : std::uint8_t {
    draw,     ///< onto the screen
    picture,  ///< into a file, as `lamp render` does
    capture,  ///< into a folder, as `lamp capture` does
    prove,    ///< all pixels against the oracle
    ask,      ///< every method what it lists for the picked pixel
  } kind = Kind::draw;
  ViewState state;
  glm::uvec2 size{0};
  std::string file;      ///< or folder
  bool follows = false;  ///< a picture of a flight, behind that of the frame before
};

struct Done {
  Job job;
  std::optional<Shown> shown;
  std::string proof;  ///< in words; or empty
  std::optional<std::vector<OtherList>> others;
  double ms = 0.0;    ///< that it took, all in all
  std::string error;  ///< why it could not be done, one line; or empty
  bool lost = false;  ///< the device is gone
};

/// Throws nothing that is an Error.
[[nodiscard]] Done perform(Stage& stage, Job job);

}  // namespace lamp::app
