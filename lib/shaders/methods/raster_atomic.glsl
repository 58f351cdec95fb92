// Sets a light's bit, one atomic a fragment. Returns the word as it was.
// Needs: `bits`.
// SPDX-License-Identifier: Apache-2.0
uint set_bit(uint word, uint bit) { return atomicOr(bits[word], bit); }
