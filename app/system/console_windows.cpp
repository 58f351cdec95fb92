// Makes the console take UTF-8 and the escapes that progress is drawn with.
// SPDX-License-Identifier: Apache-2.0
#include <fcntl.h>
#include <io.h>
#include <windows.h>

#include <cstdio>
#include <cstdlib>

#include "system/console.h"

namespace lamp::app {
namespace {

UINT code_page_before = 0;  // set by the first call, when there is one thread

void restore_code_page() { SetConsoleOutputCP(code_page_before); }

}  // namespace

void open_standard_streams() {
  for (std::FILE* stream : {stdin, stdout, stderr}) static_cast<void>(_setmode(_fileno(stream), _O_BINARY));
  // The code page is the console's and stays with it when the program is gone.
  code_page_before = GetConsoleOutputCP();
  if (code_page_before != 0 && SetConsoleOutputCP(CP_UTF8) != 0) std::atexit(restore_code_page);
  for (const DWORD stream : {STD_OUTPUT_HANDLE, STD_ERROR_HANDLE}) {
    DWORD mode = 0;
    if (GetConsoleMode(GetStdHandle(stream), &mode) != 0)
      SetConsoleMode(GetStdHandle(stream), mode | ENABLE_VIRTUAL_TERMINAL_PROCESSING);
  }
}

std::optional<std::size_t> terminal_width() {
  CONSOLE_SCREEN_BUFFER_INFO console{};
  if (GetConsoleScreenBufferInfo(GetStdHandle(STD_OUTPUT_HANDLE), &console) == 0) return std::nullopt;
  const int letters = console.srWindow.Right - console.srWindow.Left + 1;
  return letters > 0 ? std::optional(static_cast<std::size_t>(letters)) : std::nullopt;
}

bool stderr_is_terminal() {
  DWORD mode = 0;
  return GetConsoleMode(GetStdHandle(STD_ERROR_HANDLE), &mode) != 0;
}

}  // namespace lamp::app
