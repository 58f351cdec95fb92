// Fuzzes what a capture says: any bytes give lights (.npy) or a manifest (frame.json) or an Error, without crash, leak
// or undefined behaviour; a manifest that is written out says the same when it is read again.
// Seeds: corpus_capture/. Build with -DLAMPLIGHT_FUZZ=ON; no file is opened.
// SPDX-License-Identifier: Apache-2.0
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <span>
#include <string_view>

#include "error.h"
#include "scene/capture_json.h"

namespace {

constexpr std::string_view NPY = "\x93NUMPY";

void expect(bool holds) {
  if (!holds) std::abort();
}

void check_lights_file(std::string_view bytes) {
  const std::vector<lamp::Light> lights = lamp::app::read_npy_lights(std::as_bytes(std::span(bytes)), "fuzz.npy");
  expect(!lamp::check_lights(lights));
  const std::string written = lamp::app::npy_lights(lights);
  const auto again = lamp::app::read_npy_lights(std::as_bytes(std::span(written)), "again.npy");
  expect(again.size() == lights.size());
}

void check_manifest(std::string_view text) {
  lamp::app::Manifest manifest = lamp::app::parse_manifest(text, "fuzz.json");
  expect(!lamp::check_lights(manifest.lights));
  expect(manifest.view.width() >= 1 && manifest.view.height() >= 1);
  manifest.depth_kind = lamp::app::DepthKind::reversed;  // the view is, whatever the file was
  const lamp::app::Manifest again = lamp::app::parse_manifest(manifest_text(manifest), "again.json");
  expect(again.view.clip_from_view() == manifest.view.clip_from_view());
  expect(again.view.view_from_world() == manifest.view.view_from_world());
  expect(again.lights.size() == manifest.lights.size() && again.depth == manifest.depth);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  try {
    text.starts_with(NPY) ? check_lights_file(text) : check_manifest(text);
  } catch (const lamp::app::Error&) {
    return 0;
  }
  return 0;
}
