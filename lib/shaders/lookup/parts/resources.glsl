// How a look-up says its buffers and specialization constants, in GLSL and in HLSL, and where they lie. A shader may say
// LOOKUP_SET, LOOKUP_FIRST_BINDING and LOOKUP_FIRST_CONSTANT before it includes a look-up; the host adds the same to its
// bindings and ids. The first binding is the frame, of each view one behind the other. Where there are several views, a
// buffer has a part for each; LOOKUP_VIEW says which view is meant where a call does not (gl_ViewIndex, for example).
// Buffers without descriptors, in GLSL: LOOKUP_ADDRESSES is an array of uvec2 in the host's push constants or buffer,
// which holds BoundLookUp::addresses. The shader then requires GL_EXT_buffer_reference_uvec2.
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

#ifndef LOOKUP_VIEW
#define LOOKUP_VIEW 0u
#endif
// From one view's part of the buffer at a place to the next one's, in 32-bit words; 0 where there is one view.
#define LOOKUP_VIEW_WORDS(place, name) LOOKUP_CONSTANT(20 + place, uint, name, 0)

#ifdef LAMP_HLSL
#define LOOKUP_BUFFER(place, block, type, name) \
  [[vk::binding(LOOKUP_FIRST_BINDING + place, LOOKUP_SET)]] StructuredBuffer<type> name
#define LOOKUP_CONSTANT(place, type, name, value) \
  [[vk::constant_id(LOOKUP_FIRST_CONSTANT + place)]] const type name = value
#elif defined(LOOKUP_ADDRESSES)
#define LOOKUP_BUFFER(place, block, type, name)                                                              \
  layout(buffer_reference, scalar, buffer_reference_align = 4) readonly buffer block { type at_address[]; }; \
  const uint name##_PLACE = place
#else
#define LOOKUP_BUFFER(place, block, type, name) \
  layout(set = LOOKUP_SET, binding = LOOKUP_FIRST_BINDING + place, scalar) readonly buffer block { type name[]; }
#endif
#ifndef LAMP_HLSL
#define LOOKUP_CONSTANT(place, type, name, value) \
  layout(constant_id = LOOKUP_FIRST_CONSTANT + place) const type name = value
#endif
#ifdef LOOKUP_ADDRESSES
#include "lookup/parts/addresses.glsl"
#endif
LOOKUP_BUFFER(0, LookupFrame, Frame, lookup_frames);
#define lookup_frame lookup_frames[LOOKUP_VIEW]

// The same in all views.
uint lookup_light_count() { return light_count_of(lookup_frames[0]); }

#endif
