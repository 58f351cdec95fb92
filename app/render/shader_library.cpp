// Looks shaders up; runs glslc for `--shader-dir`.
// SPDX-License-Identifier: Apache-2.0
#include "render/shader_library.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "error.h"
#include "files/content_hash.h"
#include "image/write_file.h"
#include "system/run_program.h"
#include "temporary_folder.h"

namespace lamp::app {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t SPIRV_MAGIC = 0x07230203;  // the first word of every module

/// "methods/light_bounds.comp" becomes TREE/lib/shaders/methods/light_bounds.comp.
fs::path source_in(const fs::path& tree, const ShaderCode& code) {
  for (const char* root : {"lib/shaders", "app/render/shaders"}) {
    fs::path candidate = tree / root / code.source;
    if (fs::exists(candidate)) return candidate;
  }
  throw Error(fmt::format("--shader-dir {}: has no source for the shader {}; expected a checkout of Lamplight",
                          tree.string(), code.name));
}

/// All that a shader of the tree may include, files and folders.
std::vector<fs::directory_entry> entries_of(const fs::path& tree) {
  std::vector<fs::directory_entry> entries;
  for (const char* root : {"lib/shaders", "lib/include", "app/render/shaders"}) {
    std::error_code none;  // what is not there is said where it is looked for
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(tree / root, none))
      entries.push_back(entry);
  }
  return entries;
}

fs::file_time_type last_change(const fs::path& tree) {
  fs::file_time_type last = fs::file_time_type::min();
  std::error_code none;
  for (const fs::directory_entry& entry : entries_of(tree)) last = std::max(last, entry.last_write_time(none));
  return last;
}

}  // namespace

std::string hash_of_shaders(const fs::path& source_tree) {
  std::vector<fs::path> files;
  for (const fs::directory_entry& entry : entries_of(source_tree))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::ranges::sort(files);
  std::uint64_t hash = HASH_FIRST;
  for (const fs::path& file : files) hash = hash_of(file.lexically_relative(source_tree).generic_string() + "\n", hash);
  return hash_text(hash_of(hash_of_files(files), hash));
}

std::vector<std::uint32_t> ShaderLibrary::compile(const ShaderCode& code) const {
  const fs::path source = source_in(source_tree_, code);
  const TemporaryFolder folder;
  if (!code.lookup.empty()) {
    const fs::path shaders = source_tree_ / "lib/shaders";
    fs::path lookup = fmt::format("lookup/{}.glsl", code.lookup);
    if (!fs::exists(shaders / lookup)) lookup = fmt::format("lookup/fused/{}.glsl", code.lookup);
    write_file(folder.path() / "lookup.glsl", fmt::format("#include \"{}\"\n", lookup.generic_string()));
  }
  const auto from = [](const fs::path& included) { return "-I" + included.string(); };
  std::vector<std::string> command{"glslc",
                                   "--target-env=vulkan1.3",
                                   "-O",
                                   from(folder.path()),
                                   from(source_tree_ / "lib/shaders"),
                                   from(source_tree_ / "lib/include"),
                                   from(source_tree_ / "app/render/shaders"),
                                   source.string(),
                                   "-o",
                                   "-"};
  if (code.multisampled) command.emplace_back("-DMULTISAMPLED");
  const ProgramResult compiled = run_program(command);
  std::vector<std::uint32_t> words(compiled.out.size() / sizeof(std::uint32_t));
  if (!words.empty()) std::memcpy(words.data(), compiled.out.data(), words.size() * sizeof(std::uint32_t));
  if (compiled.succeeded && !words.empty() && words.front() == SPIRV_MAGIC) return words;
  const std::string line = compiled.err.substr(0, compiled.err.find('\n'));
  throw Error(fmt::format("{}: {}", source.string(), line.empty() ? "glslc gave no SPIR-V and no reason" : line));
}

std::vector<std::uint32_t> ShaderLibrary::compiled(const ShaderCode& code) const {
  const fs::file_time_type last = last_change(source_tree_);
  {
    const std::scoped_lock lock(compiled_->mutex);
    if (compiled_->of != last) compiled_->words.clear();
    compiled_->of = last;
    if (const auto found = compiled_->words.find(code.name); found != compiled_->words.end()) return found->second;
  }
  std::vector<std::uint32_t> words;
  try {
    words = compile(code);
  } catch (const Error& error) {
    throw ShaderError(error.what());
  }
  const std::scoped_lock lock(compiled_->mutex);
  if (compiled_->of == last) compiled_->words.emplace(code.name, words);
  return words;
}

std::vector<std::uint32_t> ShaderLibrary::spirv(std::string_view name) const {
  const ShaderCode* code = find_shader(library_shaders(), name);
  if (code == nullptr) code = find_shader(render_shaders(), name);
  if (code == nullptr) throw Error(fmt::format("shader {}: is not among the embedded shaders", name));
  if (!source_tree_.empty()) return compiled(*code);
  return {code->spirv.begin(), code->spirv.end()};
}

vulkan::ShaderSource ShaderLibrary::source() const {
  return [this](std::string_view name) -> Result<std::vector<std::uint32_t>> { return spirv(name); };
}

}  // namespace lamp::app
