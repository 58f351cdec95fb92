// Looks shaders up; runs glslc for `--shader-dir`.
// SPDX-License-Identifier: Apache-2.0
#include "render/shader_library.h"

#include <fmt/format.h>

#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>

#include "error.h"
#include "temporary_folder.h"

namespace lamp::app {
namespace {

namespace fs = std::filesystem;

std::string quoted(const fs::path& path) {
  std::string text = "'";
  for (const char c : path.string()) text += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return text + "'";
}

std::string read_file(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// "methods/tiled.comp" becomes TREE/lib/shaders/methods/tiled.comp.
fs::path source_in(const fs::path& tree, const ShaderCode& code) {
  for (const char* root : {"lib/shaders", "app/render/shaders"}) {
    fs::path candidate = tree / root / code.source;
    if (fs::exists(candidate)) return candidate;
  }
  throw Error(fmt::format("--shader-dir {}: has no source for the shader {}; expected a checkout of Lamplight",
                          tree.string(), code.name));
}

}  // namespace

std::vector<std::uint32_t> ShaderLibrary::compile(const ShaderCode& code) const {
  const fs::path source = source_in(source_tree_, code);
  const TemporaryFolder folder;
  if (!code.lookup.empty()) {
    const fs::path shaders = source_tree_ / "lib/shaders";
    fs::path lookup = fmt::format("lookup/{}.glsl", code.lookup);
    if (!fs::exists(shaders / lookup)) lookup = fmt::format("lookup/fused/{}.glsl", code.lookup);
    std::ofstream(folder.path() / "lookup.glsl") << fmt::format("#include \"{}\"\n", lookup.string());
  }
  const fs::path out = folder.path() / "out.spv";
  const fs::path log = folder.path() / "log.txt";
  const std::string command =
      fmt::format("glslc --target-env=vulkan1.3 -O -I{} -I{} -I{} -I{} {} -o {} 2> {}", quoted(folder.path()),
                  quoted(source_tree_ / "lib/shaders"), quoted(source_tree_ / "lib/include"),
                  quoted(source_tree_ / "app/render/shaders"), quoted(source), quoted(out), quoted(log));
  if (std::system(command.c_str()) != 0) {
    const std::string text = read_file(log);
    throw Error(fmt::format("{}: {}", source.string(), text.substr(0, text.find('\n'))));
  }
  const std::string bytes = read_file(out);
  std::vector<std::uint32_t> words(bytes.size() / sizeof(std::uint32_t));
  std::memcpy(words.data(), bytes.data(), words.size() * sizeof(std::uint32_t));
  return words;
}

std::vector<std::uint32_t> ShaderLibrary::spirv(std::string_view name) const {
  const ShaderCode* code = find_shader(library_shaders(), name);
  if (code == nullptr) code = find_shader(render_shaders(), name);
  if (code == nullptr) throw Error(fmt::format("shader {}: is not among the embedded shaders", name));
  if (!source_tree_.empty()) return compile(*code);
  return {code->spirv.begin(), code->spirv.end()};
}

vulkan::ShaderSource ShaderLibrary::source() const {
  return [this](std::string_view name) -> Result<std::vector<std::uint32_t>> { return spirv(name); };
}

}  // namespace lamp::app
