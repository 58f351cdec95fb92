// The cells' bits of a bucket of several pieces, whose entries are in order by now: a work group for each piece.
// SPDX-License-Identifier: Apache-2.0
#version 460
#extension GL_GOOGLE_include_directive : require
#extension GL_EXT_scalar_block_layout : require
#extension GL_EXT_control_flow_attributes : require
#include "lamplight/shared/world.h"

layout(local_size_x_id = 2) in;
layout(constant_id = 1) const uint HALVES = 4;  // of a word, for an entry's bits
#include "methods/world_entry.glsl"

const uint PIECE_WORDS = WORLD_PIECE * HALVES / 2u;

layout(set = 0, binding = 3, scalar) readonly buffer TotalBuffer { WorldTotals totals; };
layout(set = 0, binding = 4, scalar) readonly buffer BucketBuffer { WorldBucket buckets[]; };
layout(set = 0, binding = 5, scalar) readonly buffer PieceBuffer { WorldPiece bucket_pieces[]; };
layout(set = 0, binding = 6, scalar) readonly buffer EntryBuffer { uint entries[]; };
layout(set = 0, binding = 7, scalar) writeonly buffer BitBuffer { uint bits[]; };

shared uint s_cells[2u * WORLD_PIECE + 16u];
shared uint s_bits[PIECE_WORDS];
#include "methods/world_octet.glsl"

void main() {
  if (group_number() >= totals.pieces) return;
  const uint thread = gl_LocalInvocationIndex;
  const WorldPiece piece = bucket_pieces[group_number()];
  const WorldBucket bucket = buckets[piece.bucket];
  if (bucket.count <= WORLD_PIECE) return;  // world_order.comp has made them
  const uint count = min(bucket.count - piece.begin, WORLD_PIECE);
  for (uint i = thread; i < count; i += gl_WorkGroupSize.x) {
    const uvec2 cells = cells_of_entry(entries[bucket.first + piece.begin + i]);
    [[unroll]] for (uint word = 0u; word < 2u; ++word) s_cells[2u * i + word] = cells[word];
  }
  for (uint i = thread; i < PIECE_WORDS; i += gl_WorkGroupSize.x) s_bits[i] = 0u;
  barrier();  // all cells before bits are made of them
  const uint blocks = (count + BLOCK - 1u) / BLOCK;
  for (uint i = thread; i < OCTETS * blocks; i += gl_WorkGroupSize.x) {
    const uint begin = i / OCTETS * BLOCK;
    write_octet(begin, min(count - begin, BLOCK), i % OCTETS);
  }
  barrier();  // all bits before they are written
  const uint first = first_word(bucket.first + piece.begin);
  for (uint i = thread; i < words_of(count); i += gl_WorkGroupSize.x) bits[first + i] = s_bits[i];
}
