// Walks a document and changes it in place.
// SPDX-License-Identifier: Apache-2.0
#include "scene/gltf_clean.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <utility>

#include "scene/gltf_document.h"

namespace lamp::app {
namespace {

using nlohmann::json;

/// Of an object's extras nothing but a probe. tinygltf drops what is empty, and an empty probe is a mistake to be
/// named, as is one of its members: an object gets a member that says what it says without, anything else becomes what
/// no member may be.
void keep_probe(json& value) {
  const auto extras = value.find("extras");
  if (extras == value.end()) return;
  if (!extras->is_object() || !extras->contains(PROBE_KEY)) {
    value.erase(extras);
    return;
  }
  json probe = extras->at(PROBE_KEY);
  if (probe.is_object())
    for (json& member : probe)
      if (member.empty()) member = false;  // null, {} and []
  if (probe.empty()) probe = probe.is_object() ? json{{"shape", "box"}} : json(false);
  *extras = json{{PROBE_KEY, std::move(probe)}};
}

/// tinygltf keeps 32 bits of integers in extensions and extras.
void make_reals(json& value) {
  if (value.is_number_integer()) value = value.get<double>();
  if (!value.is_structured()) return;
  for (json& member : value) make_reals(member);
}

void drop_unread(json& value, std::set<std::string>& dropped) {
  if (value.is_array()) {
    for (json& element : value) drop_unread(element, dropped);
  }
  if (!value.is_object()) return;
  keep_probe(value);
  for (auto& [key, member] : value.items()) {
    if (key == "extensions" && member.is_object()) {
      for (auto it = member.begin(); it != member.end();) {
        if (!is_supported(it.key())) dropped.insert(it.key());
        it = is_supported(it.key()) ? std::next(it) : member.erase(it);
      }
    }
    drop_unread(member, dropped);
    if (key == "extensions" || key == "extras") make_reals(member);
  }
}

}  // namespace

bool is_supported(std::string_view extension) {
  return std::ranges::find(GLTF_EXTENSIONS, extension) != GLTF_EXTENSIONS.end();
}

void make_whole(json& value) {
  constexpr double END = 0x1p53;  // from here on, not every integer is a double
  if (value.is_structured())
    for (json& member : value) make_whole(member);
  if (!value.is_number_float()) return;
  const auto number = value.get<double>();
  if (!std::signbit(number) && number < END && std::trunc(number) == number) value = static_cast<std::uint64_t>(number);
}

std::set<std::string> drop_unread(json& document) {
  std::set<std::string> dropped;
  drop_unread(document, dropped);
  return dropped;
}

}  // namespace lamp::app
