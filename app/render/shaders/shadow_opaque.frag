// Fragments of opaque shadow casters, for devices that clip nothing without a fragment shader (shadow_draws.cpp).
// SPDX-License-Identifier: Apache-2.0
#version 460

void main() {}
