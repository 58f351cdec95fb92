// A list of what is to be removed, with one lock around every change of it and of what it names.
// SPDX-License-Identifier: Apache-2.0
#include "system/temporary.h"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <mutex>
#include <random>
#include <ranges>
#include <system_error>
#include <vector>

namespace lamp::app {
namespace {

namespace fs = std::filesystem;

struct Entry {
  fs::path path;
  Temporary::Removal removal;
};

struct Registry {
  std::mutex mutex;
  std::vector<Entry> entries;  ///< in the order in which they were made
};

/// Never destroyed: a signal may come while the program ends by itself.
Registry& registry() {
  static Registry& one = *new Registry;
  return one;
}

void remove(const Entry& entry) {
  std::error_code ignored;
  if (entry.removal == Temporary::Removal::if_empty)
    fs::remove(entry.path, ignored);
  else
    fs::remove_all(entry.path, ignored);
}

auto find(const fs::path& path) { return std::ranges::find(registry().entries, path, &Entry::path); }

}  // namespace

Temporary::Temporary(Removal removal, const std::function<fs::path()>& make) {
  const std::scoped_lock lock(registry().mutex);
  path_ = make();
  registry().entries.push_back({path_, removal});
}

Temporary::~Temporary() {
  const std::scoped_lock lock(registry().mutex);
  const auto entry = find(path_);
  if (entry == registry().entries.end()) return;  // it was kept
  remove(*entry);
  registry().entries.erase(entry);
}

void Temporary::move_to(const fs::path& place) {
  const std::scoped_lock lock(registry().mutex);
  if (!fs::is_directory(fs::symlink_status(place))) {
    fs::rename(path_, place);  // in place of a file, in one step
    registry().entries.erase(find(path_));
    return;
  }
  const fs::path old = temporary_name(place);
  fs::rename(place, old);
  std::error_code error;
  fs::rename(path_, place, error);
  if (error) fs::rename(old, place);
  if (error) throw fs::filesystem_error("rename", place, error);
  find(path_)->path = old;
  path_ = old;
}

void Temporary::keep() {
  const std::scoped_lock lock(registry().mutex);
  registry().entries.erase(find(path_));
}

NewFolders::NewFolders(const fs::path& place) {
  std::vector<fs::path> missing;
  for (fs::path folder = place; !folder.empty() && !fs::exists(folder); folder = folder.parent_path())
    missing.push_back(folder);
  try {
    for (const fs::path& folder : missing | std::views::reverse)
      made_.push_back(std::make_unique<Temporary>(Temporary::Removal::if_empty, [&] {
        fs::create_directory(folder);
        return folder;
      }));
  } catch (...) {
    remove();
    throw;
  }
}

NewFolders::~NewFolders() { remove(); }

void NewFolders::keep() {
  for (const auto& folder : made_) folder->keep();
}

void NewFolders::remove() {
  while (!made_.empty()) made_.pop_back();  // the innermost first
}

std::string unique_name() {
  static const std::uint64_t of_process = [] {
    std::random_device random;
    return std::uint64_t{random()} << 32U | random();
  }();
  static std::atomic<std::uint32_t> number = 0;
  return fmt::format("lamp-{:016x}-{}", of_process, number++);
}

fs::path temporary_name(const fs::path& place) {
  // The length does not depend on that of the place's name, which may be as long as the system takes.
  return place.parent_path() / fmt::format(".{}.tmp", unique_name());
}

void remove_temporaries_for_good() {
  registry().mutex.lock();  // to the end
  // A thread that writes into a folder can bring it back to life for a moment, not for long: without the folder,
  // nothing can be made in it.
  constexpr int ATTEMPTS = 10;
  for (const Entry& entry : registry().entries | std::views::reverse) {
    std::error_code ignored;
    for (int i = 0; i < ATTEMPTS && fs::exists(fs::symlink_status(entry.path, ignored)); ++i) remove(entry);
  }
}

}  // namespace lamp::app
