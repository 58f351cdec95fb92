// Asks the system about its descriptors.
// Based on: GNU gnulib, stdopen, for closed streams.
// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <cerrno>

#include "system/console.h"

namespace lamp::app {

void open_standard_streams() {
  for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (fcntl(stream, F_GETFD) != -1 || errno != EBADF) continue;
    // For the wrong direction: reading stdin and writing the others fail with EBADF, as they do while closed. The
    // lowest free number is this stream's, since those below are open.
    static_cast<void>(open("/dev/null", stream == STDIN_FILENO ? O_WRONLY : O_RDONLY));
  }
}

std::optional<std::size_t> terminal_width() {
  winsize size{};
  if (isatty(STDOUT_FILENO) == 0 || ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) != 0 || size.ws_col == 0)
    return std::nullopt;
  return size.ws_col;
}

bool stderr_is_terminal() { return isatty(STDERR_FILENO) != 0; }

}  // namespace lamp::app
