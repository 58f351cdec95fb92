// A number whose every bit depends on every bit of another.
// Based on: Ellis, lowbias32, Prospecting for Hash Functions (2018).
// SPDX-License-Identifier: Apache-2.0
#ifndef LAMP_MIXED
#define LAMP_MIXED

uint mixed(uint x) {
  x = (x ^ (x >> 16)) * 0x7feb352du;
  x = (x ^ (x >> 15)) * 0x846ca68bu;
  return x ^ (x >> 16);
}

#endif
