// Writes to the standard streams, and remembers the first failure of each.
// Based on: GNU gnulib, closeout, for errors that only a flush shows.
// SPDX-License-Identifier: Apache-2.0
#include "system/print.h"

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>

#include "system/console.h"

namespace lamp::app {
namespace {

std::atomic<int> out_errno = 0;
std::atomic<int> error_errno = 0;
bool progress_is_hidden = false;  // set while the command line is read, by the only thread

/// UTF-8: what is no byte of a letter behind its first.
bool begins_letter(char byte) { return (static_cast<unsigned char>(byte) & 0xC0U) != 0x80U; }

void remember(std::atomic<int>& first, bool written) {
  int none = 0;
  if (!written) first.compare_exchange_strong(none, errno != 0 ? errno : EIO);
}

void write_to(std::FILE* stream, std::string_view text, std::atomic<int>& first) {
  errno = 0;
  remember(first, std::fwrite(text.data(), 1, text.size(), stream) == text.size());
}

}  // namespace

void write_out(std::string_view text) { write_to(stdout, text, out_errno); }

void write_error(std::string_view text) { write_to(stderr, text, error_errno); }

std::string wrapped(std::string_view text, std::size_t width, std::size_t indent) {
  std::string lines;
  std::size_t column = 0;
  while (!text.empty()) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(word.size() + 1, text.size()));
    const auto letters = static_cast<std::size_t>(std::ranges::count_if(word, begins_letter));
    if (column > indent && column + 1 + letters > width) {
      lines += "\n" + std::string(indent, ' ');
      column = indent;
    } else if (!lines.empty()) {
      lines += ' ';
      ++column;
    }
    lines += word;
    column += letters;
  }
  return lines;
}

bool shows_progress() { return !progress_is_hidden && stderr_is_terminal(); }

void hide_progress() { progress_is_hidden = true; }

int output_problem() {
  errno = 0;
  remember(out_errno, std::fflush(stdout) == 0);
  return out_errno;
}

int error_output_problem() {
  errno = 0;
  remember(error_errno, std::fflush(stderr) == 0);
  return error_errno;
}

}  // namespace lamp::app
