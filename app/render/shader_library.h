// Shaders by name: embedded in the binary, or compiled anew from a source tree while somebody works on them.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "error.h"
#include "lamplight/shader_code.h"
#include "lamplight/vulkan.h"

namespace lamp {
/// The renderer's shaders (made by cmake/LamplightShaders.cmake).
[[nodiscard]] std::span<const ShaderCode> render_shaders();
}  // namespace lamp

namespace lamp::app {

/// Of all files that shaders of a checkout may include, and their names.
[[nodiscard]] std::string hash_of_shaders(const std::filesystem::path& source_tree);

/// A shader of a source tree that does not compile: no fault of a device.
class ShaderError : public Error {
 public:
  using Error::Error;
};

class ShaderLibrary {
 public:
  /// `source_tree`: empty, or a checkout of Lamplight whose shaders are compiled with `glslc`, each again when a file
  /// of the checkout's shaders has changed since.
  explicit ShaderLibrary(std::filesystem::path source_tree = {}) : source_tree_(std::move(source_tree)) {}

  /// Throws ShaderError with the compiler's first line when a shader of the source tree does not compile.
  [[nodiscard]] std::vector<std::uint32_t> spirv(std::string_view name) const;

  /// The same as the library's plans want it.
  [[nodiscard]] vulkan::ShaderSource source() const;

 private:
  [[nodiscard]] std::vector<std::uint32_t> compile(const ShaderCode& code) const;
  [[nodiscard]] std::vector<std::uint32_t> compiled(const ShaderCode& code) const;

  /// What was compiled of a state of the source tree. Copies of a library share it.
  struct Compiled {
    std::mutex mutex;
    std::filesystem::file_time_type of = std::filesystem::file_time_type::min();  ///< the last change
    std::map<std::string, std::vector<std::uint32_t>, std::less<>> words;
  };

  std::filesystem::path source_tree_;
  std::shared_ptr<Compiled> compiled_ = std::make_shared<Compiled>();
};

}  // namespace lamp::app
