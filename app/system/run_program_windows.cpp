// Starts a process whose output goes into files of a temporary folder.
// Based on: Microsoft, CreateProcessW; "Parsing C command-line arguments" for the quotes.
// SPDX-License-Identifier: Apache-2.0
#include <windows.h>

#include <array>
#include <filesystem>
#include <string_view>
#include <system_error>

#include "error.h"
#include "files/utf8_path.h"
#include "system/run_program.h"
#include "temporary_folder.h"

namespace lamp::app {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void fail(const std::string& program) {
  const auto why = static_cast<int>(GetLastError());
  throw Error(program + ": cannot be started: " + std::system_category().message(why));
}

class Handle {
 public:
  Handle(const std::string& program, HANDLE handle) : handle_(handle) {
    if (handle_ == INVALID_HANDLE_VALUE) fail(program);
  }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  ~Handle() { CloseHandle(handle_); }
  [[nodiscard]] HANDLE get() const { return handle_; }

 private:
  HANDLE handle_;
};

/// For a child to inherit.
HANDLE open_stream(const fs::path& file, DWORD access, DWORD creation, DWORD flags) {
  SECURITY_ATTRIBUTES inherited{.nLength = sizeof(inherited), .lpSecurityDescriptor = nullptr, .bInheritHandle = TRUE};
  return CreateFileW(file.c_str(), access, FILE_SHARE_READ | FILE_SHARE_WRITE | FILE_SHARE_DELETE, &inherited, creation,
                     flags, nullptr);
}

HANDLE open_output(const fs::path& file) {
  return open_stream(file, GENERIC_READ | GENERIC_WRITE, CREATE_NEW, FILE_ATTRIBUTE_TEMPORARY);
}

std::string text_in(const Handle& file) {
  std::string text;
  std::array<char, 4096> block{};
  SetFilePointer(file.get(), 0, nullptr, FILE_BEGIN);
  for (DWORD count = 0; ReadFile(file.get(), block.data(), block.size(), &count, nullptr) != 0 && count > 0;)
    text.append(block.data(), count);
  return text;
}

/// In quotes, as the C library of a program takes a command line apart: backslashes count double before a quote.
std::wstring quoted(const std::wstring& word) {
  std::wstring text = L"\"";
  std::size_t backslashes = 0;
  for (const wchar_t letter : word) {
    if (letter == L'"') text.append(backslashes + 1, L'\\');
    backslashes = letter == L'\\' ? backslashes + 1 : 0;
    text += letter;
  }
  return text.append(backslashes, L'\\') + L'"';
}

}  // namespace

ProgramResult run_program(std::vector<std::string> words) {
  const std::string& program = words.front();
  const TemporaryFolder folder;
  const Handle in(program, open_stream(L"NUL", GENERIC_READ, OPEN_EXISTING, 0));
  const Handle out(program, open_output(folder.path() / "out"));
  const Handle err(program, open_output(folder.path() / "err"));
  STARTUPINFOW start{};
  start.cb = sizeof(start);
  start.dwFlags = STARTF_USESTDHANDLES;
  start.hStdInput = in.get();
  start.hStdOutput = out.get();
  start.hStdError = err.get();
  std::wstring line;
  for (const std::string& word : words) line += (line.empty() ? L"" : L" ") + quoted(utf8_path(word).wstring());
  PROCESS_INFORMATION child{};
  if (CreateProcessW(nullptr, line.data(), nullptr, nullptr, /* inherits= */ TRUE, 0, nullptr, nullptr, &start,
                     &child) == 0)
    fail(program);
  const Handle thread(program, child.hThread);
  const Handle process(program, child.hProcess);
  WaitForSingleObject(process.get(), INFINITE);
  DWORD code = 1;
  GetExitCodeProcess(process.get(), &code);
  return {.succeeded = code == 0, .out = text_in(out), .err = text_in(err)};
}

}  // namespace lamp::app
