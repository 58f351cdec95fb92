// Waits for signals in a thread, where everything may be done that a signal handler must not do.
// Based on: POSIX.1-2017, sigwait; signal actions (2.4.3).
// SPDX-License-Identifier: Apache-2.0
#include "system/signals_posix.h"

#include <unistd.h>

#include <csignal>
#include <thread>

#include "system/signals.h"
#include "system/temporary.h"

namespace lamp::app {
namespace {

sigset_t watched{};  // set before the thread begins, then read alone
bool broken_pipe_kills = true;

bool is_ignored(int signal) {
  struct sigaction action{};
  return sigaction(signal, nullptr, &action) == 0 && action.sa_handler == SIG_IGN;
}

void set_handler(int signal, void (*handler)(int)) {
  struct sigaction action{};
  action.sa_handler = handler;
  sigaction(signal, &action, nullptr);
}

void wait_for_signals() {
  for (;;) {
    int signal = 0;
    if (sigwait(&watched, &signal) != 0) continue;
    if (signal == SIGQUIT || !StopRequest::takes(signal)) die_of(signal);
  }
}

}  // namespace

void watch_signals() {
  sigemptyset(&watched);
  for (const int signal : {SIGHUP, SIGINT, SIGQUIT, SIGTERM})
    if (!is_ignored(signal)) sigaddset(&watched, signal);
  broken_pipe_kills = !is_ignored(SIGPIPE);
  for (const int signal : {SIGPIPE, SIGXFSZ}) set_handler(signal, SIG_IGN);
  pthread_sigmask(SIG_BLOCK, &watched, nullptr);  // every thread to come has this mask
  std::thread(wait_for_signals).detach();
}

void restore_signals(posix_spawnattr_t& attributes) {
  sigset_t mask{};
  pthread_sigmask(SIG_BLOCK, nullptr, &mask);
  sigset_t defaults{};
  sigemptyset(&defaults);
  for (const int signal : {SIGHUP, SIGINT, SIGQUIT, SIGTERM})
    if (sigismember(&watched, signal) == 1) sigdelset(&mask, signal);
  if (broken_pipe_kills) sigaddset(&defaults, SIGPIPE);
  sigaddset(&defaults, SIGXFSZ);
  posix_spawnattr_setsigmask(&attributes, &mask);
  posix_spawnattr_setsigdefault(&attributes, &defaults);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
}

void die_of(int signal) {
  remove_temporaries_for_good();
  set_handler(signal, SIG_DFL);
  sigset_t one{};
  sigemptyset(&one);
  sigaddset(&one, signal);
  pthread_sigmask(SIG_UNBLOCK, &one, nullptr);
  raise(signal);
  _exit(128 + signal);  // the first process of a container does not die of signals
}

void die_of_broken_pipe() {
  if (broken_pipe_kills) die_of(SIGPIPE);
}

}  // namespace lamp::app
