// By dlopen.
// SPDX-License-Identifier: Apache-2.0
#include <dlfcn.h>

#include "system/shared_library.h"

namespace lamp::app {

SharedLibrary::SharedLibrary(const Names& names) : handle_(dlopen(names.posix, RTLD_NOW | RTLD_LOCAL)) {}

SharedLibrary::~SharedLibrary() {
  if (handle_ != nullptr) dlclose(handle_);
}

SharedLibrary::Any SharedLibrary::find(const char* name) const {
  return handle_ == nullptr ? nullptr : reinterpret_cast<Any>(dlsym(handle_, name));
}

}  // namespace lamp::app
