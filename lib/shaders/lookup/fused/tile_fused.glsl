// Look-up: cull and shade in one dispatch, depth bounds by atomics or from their own pass.
// SPDX-License-Identifier: Apache-2.0
#include "common/reduce_atomic.glsl"
#include "lookup/parts/tile_shared.glsl"
