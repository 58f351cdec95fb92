// What the names of a look-up's buffers mean where the host gives addresses: LOOKUP_BUFFER declares a block and the
// place of its address, and a macro cannot define another. Behind ## a name stays a name.
// Needs: LOOKUP_ADDRESSES.
// SPDX-License-Identifier: Apache-2.0
#define lookup_frames LookupFrame(LOOKUP_ADDRESSES[lookup_frames_PLACE]).at_address
#define lookup_bits LookupBits(LOOKUP_ADDRESSES[lookup_bits_PLACE]).at_address
#define lookup_piece_lists LookupPieceLists(LOOKUP_ADDRESSES[lookup_piece_lists_PLACE]).at_address
#define lookup_spans LookupSpans(LOOKUP_ADDRESSES[lookup_spans_PLACE]).at_address
#define lookup_lists LookupLists(LOOKUP_ADDRESSES[lookup_lists_PLACE]).at_address
#define lookup_ranges LookupRanges(LOOKUP_ADDRESSES[lookup_ranges_PLACE]).at_address
#define lookup_cells LookupCells(LOOKUP_ADDRESSES[lookup_cells_PLACE]).at_address
#define lookup_splits LookupSplits(LOOKUP_ADDRESSES[lookup_splits_PLACE]).at_address
#define lookup_bins LookupBins(LOOKUP_ADDRESSES[lookup_bins_PLACE]).at_address
#define lookup_order LookupOrder(LOOKUP_ADDRESSES[lookup_order_PLACE]).at_address
#define lookup_headers LookupHeaders(LOOKUP_ADDRESSES[lookup_headers_PLACE]).at_address
#define lookup_buckets LookupBuckets(LOOKUP_ADDRESSES[lookup_buckets_PLACE]).at_address
#define lookup_entries LookupEntries(LOOKUP_ADDRESSES[lookup_entries_PLACE]).at_address
#define lookup_tree LookupTree(LOOKUP_ADDRESSES[lookup_tree_PLACE]).at_address
#define lookup_level_bits LookupLevels(LOOKUP_ADDRESSES[lookup_level_bits_PLACE]).at_address
#define lookup_grids LookupGrids(LOOKUP_ADDRESSES[lookup_grids_PLACE]).at_address
#define lookup_block_words LookupBlockWords(LOOKUP_ADDRESSES[lookup_block_words_PLACE]).at_address
