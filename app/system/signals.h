// Signals that end the program: temporaries go first, then it dies of the signal, as shells and `timeout` expect.
// On Windows: what a console sends; a closed console is SIGTERM.
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace lamp::app {

/// From here on, a thread of its own waits for SIGHUP, SIGINT, SIGQUIT and SIGTERM, unless they were ignored already
/// (`nohup`). A pipe that nobody reads and a file that may not grow become errors of the write. To be called once,
/// while there is one thread.
void watch_signals();

/// Removes temporaries and ends the program by this signal.
[[noreturn]] void die_of(int signal);

/// A pipe that is written to has no reader: ends the program by SIGPIPE, where there is one and the program was not
/// started with that signal ignored.
void die_of_broken_pipe();

/// Thrown where work stops because a signal asked for it. `main` then ends the program by that signal.
struct Interrupted {
  int signal = 0;
};

/// While one exists, the first SIGHUP, SIGINT or SIGTERM is remembered instead of ending the program, and one that
/// comes more than a second later ends it. There is at most one at a time.
class StopRequest {
 public:
  StopRequest();
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;
  /// The signal that came, or 0.
  [[nodiscard]] static int signal();
  /// For the thread that a signal came to: whether one exists, and takes it.
  [[nodiscard]] static bool takes(int signal);
};

}  // namespace lamp::app
