// Shaders by name: embedded in the binary, or compiled anew from a source tree while somebody works on them.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "lamplight/shader_code.h"
#include "lamplight/vulkan.h"

namespace lamp {
/// The renderer's shaders (made by cmake/LamplightShaders.cmake).
[[nodiscard]] std::span<const ShaderCode> render_shaders();
}  // namespace lamp

namespace lamp::app {

class ShaderLibrary {
 public:
  /// `source_tree`: empty, or a checkout of Lamplight whose shaders are compiled with `glslc` at every use.
  explicit ShaderLibrary(std::filesystem::path source_tree = {}) : source_tree_(std::move(source_tree)) {}

  /// Throws Error with the compiler's first line when a shader of the source tree does not compile.
  [[nodiscard]] std::vector<std::uint32_t> spirv(std::string_view name) const;

  /// The same as the library's plans want it.
  [[nodiscard]] vulkan::ShaderSource source() const;

 private:
  [[nodiscard]] std::vector<std::uint32_t> compile(const ShaderCode& code) const;

  std::filesystem::path source_tree_;
};

}  // namespace lamp::app
