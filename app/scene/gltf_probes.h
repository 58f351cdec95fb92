// The reflection probes that nodes of a glTF file carry in their extras.
// Promise: every probe has finite numbers, and extents > 0.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "scene/gltf_document.h"
#include "scene/gltf_nodes.h"
#include "scene/probe.h"

namespace lamp::app {

/// In the order of the nodes: those with an object `lamplight_probe` among their extras (docs/methods/probes.md). Notes
/// of the document say what of it is not read, and how many a scale of 0 hides. Throws Error.
[[nodiscard]] std::vector<Probe> read_probes(GltfDocument& document, std::span<const PlacedNode> nodes);

}  // namespace lamp::app
