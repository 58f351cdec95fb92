// A console calls the handler in a thread of its own, where everything may be done.
// Based on: Microsoft, HandlerRoutine callback function.
// SPDX-License-Identifier: Apache-2.0
#include <windows.h>

#include <csignal>
#include <cstdlib>

#include "system/signals.h"
#include "system/temporary.h"

namespace lamp::app {
namespace {

BOOL WINAPI handle(DWORD event) {
  if (event == CTRL_C_EVENT && StopRequest::takes(SIGINT)) return TRUE;
  // A console that closes waits for nobody: it ends the program when this returns, or a few seconds later.
  die_of(event == CTRL_C_EVENT || event == CTRL_BREAK_EVENT ? SIGINT : SIGTERM);
}

}  // namespace

void watch_signals() { SetConsoleCtrlHandler(handle, TRUE); }

void die_of(int signal) {
  remove_temporaries_for_good();
  // As the system does it: shells show that the program was interrupted.
  constexpr UINT INTERRUPTED = 0xC000013A;  // STATUS_CONTROL_C_EXIT
  const UINT code = signal == SIGINT ? INTERRUPTED : static_cast<UINT>(128 + signal);
  TerminateProcess(GetCurrentProcess(), code);  // without the ends of DLLs, which other threads may be in
  std::_Exit(static_cast<int>(code));
}

void die_of_broken_pipe() {}

}  // namespace lamp::app
