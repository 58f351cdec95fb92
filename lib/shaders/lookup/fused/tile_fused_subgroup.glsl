// Look-up: cull and shade in one dispatch, depth bounds by subgroup operations.
// SPDX-License-Identifier: Apache-2.0
#include "common/reduce_subgroup.glsl"
#include "lookup/parts/tile_shared.glsl"
