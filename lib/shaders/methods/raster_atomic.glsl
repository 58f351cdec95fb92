// Sets a light's bit, one atomic a fragment.
// Needs: `bits`.
// SPDX-License-Identifier: Apache-2.0
void set_bit(uint word, uint bit) { atomicOr(bits[word], bit); }
