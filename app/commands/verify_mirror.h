// lamp verify: mirror rays against a reference, and the lists of what they meet.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "commands/mirror_stats.h"
#include "commands/request.h"

namespace lamp::app {

/// Renders all pictures of the session's frame. Nothing where nothing mirrors.
[[nodiscard]] std::optional<MirrorStats> verify_mirror(Session& session, const Setup& setup, Lighting& lighting);

void print_mirror(const MirrorStats& stats);

}  // namespace lamp::app
