// lamp verify: mirror rays against a reference, and the lists of what they meet.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "commands/mirror_stats.h"
#include "commands/request.h"

namespace lamp::app {

/// Renders a frame of the session, of one view with one sample a pixel. Nothing where nothing mirrors, or there are
/// more.
[[nodiscard]] std::optional<MirrorStats> verify_mirror(Session& session, const Setup& setup, Lighting& lighting);

void print_mirror(const MirrorStats& stats);

}  // namespace lamp::app
