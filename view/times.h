// The times of the last pictures, pass by pass.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "render/renderer.h"

namespace lamp::app {

class Times {
 public:
  static constexpr std::size_t MOST = 240;  ///< pictures

  struct Row {
    std::string name;  ///< "cull", "shade", "frame", then the passes
    std::vector<float> ms;
    [[nodiscard]] double at(double share) const;  ///< percentile
  };

  /// Begins anew where passes are others than before.
  void add(const Rendered& rendered);
  /// Of the interface, of no picture.
  void add_interface(double ms);
  [[nodiscard]] const Row& interface_row() const { return interface_; }
  [[nodiscard]] const std::vector<Row>& rows() const { return rows_; }

 private:
  std::vector<Row> rows_;
  Row interface_{.name = "interface", .ms = {}};
};

}  // namespace lamp::app
