// Draws progress, listens for signals.
// SPDX-License-Identifier: Apache-2.0
#include "commands/bench_progress.h"
#include "system/print.h"

#include <fmt/format.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <ctime>

namespace lamp::app {
namespace {

volatile std::sig_atomic_t stop_raised = 0;
volatile std::sig_atomic_t stop_second = 0;  // when it was raised

void handle(int signal, void (*handler)(int)) {
  struct sigaction action{};
  action.sa_handler = handler;
  sigaction(signal, &action, nullptr);
}

/// Shells and `timeout` may send one signal twice, to the process and to its group: only a later one is impatience.
extern "C" void remember_stop(int signal) {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  const auto second = static_cast<std::sig_atomic_t>(now.tv_sec);
  if (stop_raised == 0) {
    stop_raised = 1;
    stop_second = second;
  } else if (second - stop_second > 1) {
    handle(signal, SIG_DFL);
    raise(signal);
  }
}

}  // namespace

Progress::Progress() : terminal_(isatty(STDERR_FILENO) != 0), start_(Clock::now()), drawn_(start_) {}

void Progress::show(const std::string& text, double done) {
  const Clock::time_point now = Clock::now();
  if (!terminal_ || now - drawn_ < std::chrono::milliseconds(100)) return;
  drawn_ = now;
  const double elapsed = std::chrono::duration<double>(now - start_).count();
  const std::string left = done > 0.02 ? about(elapsed * (1.0 - done) / done) + " left" : "";
  print_error("\r\033[K{:3.0f} %  {}  {}", 100.0 * done, text, left);
  std::fflush(stderr);
}

void Progress::clear() const {
  if (terminal_) print_error("\r\033[K");
}

std::string about(double seconds) {
  if (seconds < 90.0) return fmt::format("about {:.0f} s", seconds);
  if (seconds < 5400.0) return fmt::format("about {:.0f} min", seconds / 60.0);
  return fmt::format("about {:.0f} h", seconds / 3600.0);
}

StopSignal::StopSignal() {
  stop_raised = 0;
  for (const int signal : {SIGINT, SIGTERM}) handle(signal, remember_stop);
}

StopSignal::~StopSignal() {
  for (const int signal : {SIGINT, SIGTERM}) handle(signal, SIG_DFL);
}

bool StopSignal::raised() { return stop_raised != 0; }

}  // namespace lamp::app
