// A GPU that waited for the host has lowered its clocks: what is timed then says nothing.
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace lamp::app {

class Lighting;
class Renderer;

/// Renders untimed frames for about as long as the GPU waited, so that its clocks are up again; nothing after a wait of
/// less than 5 ms.
void wake(Renderer& renderer, Lighting& lighting, double waited_ms);

}  // namespace lamp::app
