// By LoadLibraryEx, from the system's folder alone: drivers put theirs there.
// SPDX-License-Identifier: Apache-2.0
#include <windows.h>

#include "system/shared_library.h"

namespace lamp::app {

SharedLibrary::SharedLibrary(const Names& names)
    : handle_(LoadLibraryExA(names.windows, nullptr, LOAD_LIBRARY_SEARCH_SYSTEM32)) {}

SharedLibrary::~SharedLibrary() {
  if (handle_ != nullptr) FreeLibrary(static_cast<HMODULE>(handle_));
}

SharedLibrary::Any SharedLibrary::find(const char* name) const {
  return handle_ == nullptr ? nullptr : reinterpret_cast<Any>(GetProcAddress(static_cast<HMODULE>(handle_), name));
}

}  // namespace lamp::app
