// A glTF file, read and checked: the model as tinygltf gives it, and the bytes of its buffers.
// Based on: Khronos, glTF 2.0 specification.
// Promise: indices between elements, buffer views and numbers that the loader reads are in range; see gltf_rules.h.
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_document.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string_view>
#include <utility>

#include "files/printable.h"
#include "files/read_json.h"
#include "scene/gltf_clean.h"
#include "scene/gltf_container.h"
#include "scene/gltf_error.h"
#include "scene/gltf_notes.h"
#include "scene/gltf_rules.h"

namespace lamp::app {
namespace {

using nlohmann::json;

constexpr std::size_t MOST_VALUES = MOST_JSON_VALUES / 4;  // they are converted for tinygltf, which keeps its own

void check_version(const json& document, const std::string& file) {
  const auto version = document["asset"]["version"].get<std::string>();
  if (!version.starts_with("2.")) {
    gltf_fail(file, "asset", fmt::format("version is '{}', expected 2.0", version));
  }
}

/// The names in a list ("extensionsUsed") that are not supported.
std::vector<std::string> unsupported(const json& document, const char* list) {
  std::vector<std::string> names = document.value(list, std::vector<std::string>{});
  std::erase_if(names, [](const std::string& name) { return is_supported(name); });
  return names;
}

/// Files may have extensions that they do not name in extensionsUsed: `dropped` are those that were there.
void check_extensions(const json& document, const std::string& file, std::set<std::string> dropped,
                      std::vector<std::string>& notes) {
  if (const auto names = unsupported(document, "extensionsRequired"); !names.empty()) {
    gltf_fail(file, "extensionsRequired",
              fmt::format("{} not supported, expected none but {}", fmt::join(names, ", "),
                          fmt::join(GLTF_EXTENSIONS, ", ")));
  }
  std::vector<std::string> names = unsupported(document, "extensionsUsed");
  for (const std::string& name : names) dropped.erase(name);
  names.insert(names.end(), dropped.begin(), dropped.end());
  if (!names.empty())
    notes.push_back(one_line(fmt::format("extensions that are not supported, left out: {}", fmt::join(names, ", "))));
}

/// Buffers may be parts of one file.
void check_buffer_bytes(const json& document, const std::string& file) {
  constexpr std::size_t MOST = std::size_t{1} << 32;
  std::size_t total = 0;
  for (const json& buffer : gltf_array(document, "buffers")) total += buffer["byteLength"].get<std::size_t>();
  if (total > MOST) gltf_fail(file, "buffers", fmt::format("have {} bytes together, expected at most {}", total, MOST));
}

std::vector<std::vector<std::byte>> read_buffers(const json& document, const GltfOrigin& origin,
                                                 std::optional<std::span<const std::byte>> binary) {
  check_buffer_bytes(document, origin.file);
  std::vector<std::vector<std::byte>> buffers;
  for (const json& buffer : gltf_array(document, "buffers")) {
    const std::string element = fmt::format("buffer {}", buffers.size());
    const auto length = buffer["byteLength"].get<std::size_t>();
    std::vector<std::byte> bytes;
    if (buffer.contains("uri")) {
      bytes = read_uri(buffer["uri"].get_ref<const std::string&>(), origin, element, length);
    } else if (buffers.empty() && binary) {
      const std::span<const std::byte> chunk = binary->first(std::min(length, binary->size()));
      bytes.assign(chunk.begin(), chunk.end());
    } else {
      gltf_fail(origin.file, element, "uri is missing, expected one (or the binary chunk of a .glb for buffer 0)");
    }
    if (bytes.size() < length) {
      gltf_fail(origin.file, element,
                fmt::format("byteLength is {}, expected at most the {} bytes there are", length, bytes.size()));
    }
    buffers.push_back(std::move(bytes));
  }
  return buffers;
}

/// Without those of images, of which only some are used.
std::vector<std::filesystem::path> buffer_files(const json& document, const GltfOrigin& origin) {
  std::vector<std::filesystem::path> files;
  for (const json& buffer : gltf_array(document, "buffers")) {
    if (!buffer.contains("uri")) continue;
    if (auto file = external_file(buffer["uri"].get_ref<const std::string&>(), origin, "buffers"))
      files.push_back(*std::move(file));
  }
  return files;
}

std::vector<GltfImage> read_images(const json& document, const std::string& file) {
  std::vector<GltfImage> images;
  std::map<std::pair<std::string_view, int>, int> sources;
  for (const json& image : gltf_array(document, "images")) {
    if (image.contains("uri") == image.contains("bufferView")) {
      gltf_fail(file, fmt::format("image {}", images.size()), "expected either a uri or a bufferView");
    }
    const auto found = image.find("uri");
    const std::string_view uri = found == image.end() ? std::string_view() : found->get_ref<const std::string&>();
    const int view = image.value("bufferView", -1);
    const int index = static_cast<int>(images.size());
    const std::string fallback = is_data_uri(uri) ? fmt::format("image {}", index) : std::string(uri);
    images.push_back({.name = image.value("name", fallback),
                      .uri = std::string(uri),
                      .buffer_view = view,
                      .first_alike = sources.try_emplace({uri, view}, index).first->second});
  }
  return images;
}

/// Where a primitive's indices are an accessor without a buffer view.
struct ZeroIndices {
  std::size_t mesh = 0;
  std::size_t primitive = 0;
  int accessor = 0;
};

/// Takes these out of the document: tinygltf refuses them, though they stand for zeros as elsewhere.
std::vector<ZeroIndices> take_zero_indices(json& document) {
  std::vector<ZeroIndices> taken;
  if (!document.contains("meshes")) return taken;
  std::size_t mesh = 0;
  for (json& of : document["meshes"]) {
    std::size_t number = 0;
    for (json& primitive : of["primitives"]) {
      const auto indices = primitive.find("indices");
      if (indices != primitive.end() && !document["accessors"][indices->get<std::size_t>()].contains("bufferView")) {
        taken.push_back({mesh, number, indices->get<int>()});
        primitive.erase(indices);
      }
      ++number;
    }
    ++mesh;
  }
  return taken;
}

/// tinygltf fills in defaults. Buffers and images stay out of it: it would read them without our checks.
tinygltf::Model convert(json document, const std::string& file) {
  for (const char* part : {"buffers", "images", "animations"}) document.erase(part);
  const std::vector<ZeroIndices> zero_indices = take_zero_indices(document);
  const std::string text = document.dump();
  tinygltf::TinyGLTF loader;
  tinygltf::Model model;
  std::string error;
  std::string warning;
  if (!loader.LoadASCIIFromString(&model, &error, &warning, text.data(), static_cast<unsigned int>(text.size()), "")) {
    const std::string first_line = error.substr(0, error.find('\n'));
    gltf_fail(file, "", first_line.empty() ? "cannot be read as glTF 2.0" : first_line);
  }
  for (const ZeroIndices& taken : zero_indices)
    model.meshes[taken.mesh].primitives[taken.primitive].indices = taken.accessor;
  return model;
}

void check_buffer_views(const GltfDocument& document) {
  const auto& views = document.model.bufferViews;
  for (std::size_t i = 0; i < views.size(); ++i) {
    const std::size_t size = document.buffers[static_cast<std::size_t>(views[i].buffer)].size();
    if (views[i].byteOffset > size || views[i].byteLength > size - views[i].byteOffset) {
      gltf_fail(document.origin.file, fmt::format("bufferView {}", i),
                fmt::format("{} bytes from byte {}, expected to end within the {} bytes of buffer {}",
                            views[i].byteLength, views[i].byteOffset, size, views[i].buffer));
    }
  }
}

/// Accessors without data stand for zeros; a file of a few bytes must not ask for gigabytes of them.
void check_zero_accessors(const GltfDocument& document) {
  constexpr std::size_t MOST = 1 << 20;
  std::size_t total = 0;
  for (std::size_t i = 0; i < document.model.accessors.size(); ++i) {
    const tinygltf::Accessor& accessor = document.model.accessors[i];
    if (accessor.bufferView >= 0) continue;
    total += accessor.count;
    if (total > MOST) {
      gltf_fail(document.origin.file, fmt::format("accessor {}", i),
                fmt::format("count is {} without a bufferView, expected at most {} of all such accessors together",
                            accessor.count, MOST));
    }
  }
}

}  // namespace

std::span<const std::byte> GltfDocument::view_bytes(int buffer_view) const {
  const tinygltf::BufferView& view = model.bufferViews[static_cast<std::size_t>(buffer_view)];
  return std::span(buffers[static_cast<std::size_t>(view.buffer)]).subspan(view.byteOffset, view.byteLength);
}

GltfDocument read_document(std::span<const std::byte> bytes, GltfOrigin origin) {
  GltfDocument document;
  document.origin = std::move(origin);
  const std::string& file = document.origin.file;

  const GltfContainer container = split_container(bytes, file);
  json parsed = parse_json(container.json, file, MOST_VALUES);
  make_whole(parsed);
  check_gltf(parsed, file);
  check_version(parsed, file);
  check_extensions(parsed, file, drop_unread(parsed), document.notes);
  note_left_out(parsed, document.notes);
  note_allowed(parsed, document.notes);

  document.buffers = read_buffers(parsed, document.origin, container.binary);
  document.files = buffer_files(parsed, document.origin);
  document.images = read_images(parsed, file);
  document.model = convert(std::move(parsed), file);
  check_buffer_views(document);
  check_zero_accessors(document);
  return document;
}

}  // namespace lamp::app
