// What `lamp verify` asks of shadows.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

#include "commands/request.h"
#include "render/shadow_truth.h"

namespace lamp::app {

/// Whether a method's lights are cut by what their shadow maps hold.
[[nodiscard]] bool is_cut(Session& session, const Lighting& lighting);

/// Held against rays, in all the frame's pictures. Without shadows nothing.
[[nodiscard]] std::optional<ShadowFindings> shadow_findings(Session& session, const Setup& setup);

}  // namespace lamp::app
