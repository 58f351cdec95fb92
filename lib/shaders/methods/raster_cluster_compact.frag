// Rasterised culling of clusters, one atomic a word and subgroup.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#include "methods/raster_inputs.glsl"

layout(set = 0, binding = 5, scalar) buffer BitBuffer { uint bits[]; };
#include "methods/raster_compact.glsl"
#include "methods/raster_cluster_main.glsl"
