// A work group sorts up to WORLD_PIECE entries of a bucket: into bins by their share of the way from the least entry to
// the greatest, and within a bin by counting smaller ones. Lights of a bucket are any of all lights, so a bin has about one.
// Counted, that is a tenth of the operations of common/sort.glsl, and half of its barriers.
// Based on: Isaac, Singleton, Sorting by Address Calculation, JACM 3:3 (1956).
// Needs: common/group_scan.glsl; s_entries, and s_sorted and s_cells as room, each of WORLD_PIECE words and more.
// SPDX-License-Identifier: Apache-2.0
shared uint s_least;
shared uint s_most;

const uint BINS = WORLD_PIECE;  // in s_cells; each counts its entries, then is the next one's place, then the bin's end

// Never less for a larger entry, as each step is rounded in one way.
uint bin_of(uint entry) {
  precise const float bins_an_entry = float(BINS) / (float(s_most - s_least) + 1.0);
  precise const float bin = float(entry - s_least) * bins_an_entry;
  return min(uint(bin), BINS - 1u);
}

void begin_bins() {
  const uint of_thread = (BINS + gl_WorkGroupSize.x - 1u) / gl_WorkGroupSize.x;
  const uint first = gl_LocalInvocationIndex * of_thread;
  uint sum = 0u;
  for (uint bin = first; bin < min(first + of_thread, BINS); ++bin) sum += s_cells[bin];
  uint total;
  uint place = group_scan(sum, total);
  for (uint bin = first; bin < min(first + of_thread, BINS); ++bin) {
    const uint entries = s_cells[bin];
    s_cells[bin] = place;
    place += entries;
  }
}

uint place_in_bin(uint entry) {
  const uint bin = bin_of(entry);
  const uint begin = bin == 0u ? 0u : s_cells[bin - 1u];
  uint place = begin;
  for (uint k = begin; k < s_cells[bin]; ++k) place += uint(s_sorted[k] < entry);
  return place;
}

// By all threads of the group together. No entry is twice among them. Read s_entries after a barrier.
void sort_entries(uint count) {
  const uint threads = gl_WorkGroupSize.x;
  const uint thread = gl_LocalInvocationIndex;
  if (thread == 0u) {
    s_least = ~0u;
    s_most = 0u;
  }
  for (uint bin = thread; bin < BINS; bin += threads) s_cells[bin] = 0u;
  barrier();  // entries, and zeros, before bins are found
  for (uint i = thread; i < count; i += threads) {
    atomicMin(s_least, s_entries[i]);
    atomicMax(s_most, s_entries[i]);
  }
  barrier();  // the ends before what lies between
  for (uint i = thread; i < count; i += threads) atomicAdd(s_cells[bin_of(s_entries[i])], 1u);
  barrier();  // all counts before places
  begin_bins();
  barrier();  // all places before they are taken
  for (uint i = thread; i < count; i += threads) s_sorted[atomicAdd(s_cells[bin_of(s_entries[i])], 1u)] = s_entries[i];
  barrier();  // bins are full before they are ordered
  for (uint i = thread; i < count; i += threads) s_entries[place_in_bin(s_sorted[i])] = s_sorted[i];
}
