// Hashes of content: the published values, and files whose bytes, order or borders change.
// SPDX-License-Identifier: Apache-2.0
#include "files/content_hash.h"

#include <gtest/gtest.h>

#include <fstream>
#include <set>
#include <vector>

#include "error.h"
#include "temporary_folder.h"

namespace lamp::app {
namespace {

namespace fs = std::filesystem;

// Landon Curt Noll, "FNV hash", test vectors of FNV-1a of 64 bits: http://www.isthe.com/chongo/src/fnv/test_fnv.c
TEST(ContentHash, HasThePublishedValues) {
  EXPECT_EQ(hash_of(""), 0xCBF29CE484222325ULL);
  EXPECT_EQ(hash_of("a"), 0xAF63DC4C8601EC8CULL);
  EXPECT_EQ(hash_of("foobar"), 0x85944171F73967E8ULL);
  EXPECT_EQ(hash_of("bar", hash_of("foo")), hash_of("foobar"));
  EXPECT_EQ(hash_text(0x12ABU), "00000000000012ab");
}

TEST(ContentHash, OfFilesFollowsWhatTheyHold) {
  const TemporaryFolder folder;
  const auto hash = [&](const std::vector<std::string>& contents) {
    std::vector<fs::path> files;
    for (const std::string& content : contents) {
      files.push_back(folder.path() / std::to_string(files.size()));
      std::ofstream(files.back(), std::ios::binary) << content;
    }
    return hash_of_files(files);
  };
  EXPECT_EQ(hash({}), "");
  EXPECT_EQ(hash({"ab", "c"}), hash({"ab", "c"}));
  const std::set<std::string> all{hash({"ab", "c"}), hash({"c", "ab"}), hash({"a", "bc"}), hash({"abc"}),
                                  hash({"abc", ""}), hash({"ab", "d"}), hash({""})};
  EXPECT_EQ(all.size(), 7U);
  const std::vector<fs::path> nowhere{folder.path() / "nowhere"};
  EXPECT_THROW(static_cast<void>(hash_of_files(nowhere)), Error);
}

}  // namespace
}  // namespace lamp::app
