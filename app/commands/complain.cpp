// From exceptions to lines.
// SPDX-License-Identifier: Apache-2.0
#include "commands/complain.h"

#include <exception>
#include <filesystem>
#include <new>

#include "files/printable.h"
#include "system/print.h"

namespace lamp::app {

Exit complain(std::string_view program, std::string_view why, Exit exit) {
  print_error("{}: {}\n", program, one_line(why));
  return exit;
}

Exit run_or_complain(std::string_view program, const std::function<Exit()>& run) {
  try {
    return run();
  } catch (const Error& error) {
    return complain(program, error.what(), error.exit());
  } catch (const std::bad_alloc&) {
    return complain(program, "out of memory: try fewer lights or a smaller picture", Exit::bad_input);
  } catch (const std::filesystem::filesystem_error& error) {
    return complain(program, error.path1().string() + ": " + error.code().message(), Exit::bad_input);
  } catch (const std::exception& error) {
    return complain(program, error.what(), Exit::bad_input);
  }
}

}  // namespace lamp::app
