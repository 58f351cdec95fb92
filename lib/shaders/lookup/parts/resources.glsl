// How a look-up says its buffers and specialization constants, in GLSL and in HLSL, and where they lie. A shader may say
// LOOKUP_SET, LOOKUP_FIRST_BINDING and LOOKUP_FIRST_CONSTANT before it includes a look-up; the host adds the same to its
// bindings and ids. The first binding is the frame.
// SPDX-License-Identifier: Apache-2.0
#ifndef LOOKUP_RESOURCES
#define LOOKUP_RESOURCES
#include "common/frame.glsl"
#include "common/language.glsl"

#ifndef LOOKUP_SET
#define LOOKUP_SET 0
#endif
#ifndef LOOKUP_FIRST_BINDING
#define LOOKUP_FIRST_BINDING 16
#endif
#ifndef LOOKUP_FIRST_CONSTANT
#define LOOKUP_FIRST_CONSTANT 100
#endif

#ifdef LAMP_HLSL
#define LOOKUP_BUFFER(place, block, type, name) \
  [[vk::binding(LOOKUP_FIRST_BINDING + place, LOOKUP_SET)]] StructuredBuffer<type> name
#define LOOKUP_CONSTANT(place, type, name, value) \
  [[vk::constant_id(LOOKUP_FIRST_CONSTANT + place)]] const type name = value
LOOKUP_BUFFER(0, LookupFrame, Frame, lookup_frames);
#define lookup_frame lookup_frames[0]
#else
#define LOOKUP_BUFFER(place, block, type, name) \
  layout(set = LOOKUP_SET, binding = LOOKUP_FIRST_BINDING + place, scalar) readonly buffer block { type name[]; }
#define LOOKUP_CONSTANT(place, type, name, value) \
  layout(constant_id = LOOKUP_FIRST_CONSTANT + place) const type name = value
layout(set = LOOKUP_SET, binding = LOOKUP_FIRST_BINDING, scalar) readonly buffer LookupFrame { Frame lookup_frame; };
#endif

#endif
