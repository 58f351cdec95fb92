// Nothing: depth is all that is drawn. There is a shader because SwiftShader clips by clip distances only before one.
// SPDX-License-Identifier: Apache-2.0
#version 460

void main() {}
