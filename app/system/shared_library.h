// A library that is loaded where it is there.
// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace lamp::app {

class SharedLibrary {
 public:
  struct Names {
    const char* posix;
    const char* windows;  ///< of the system's folder
  };
  explicit SharedLibrary(const Names& names);
  ~SharedLibrary();
  SharedLibrary(const SharedLibrary&) = delete;
  SharedLibrary& operator=(const SharedLibrary&) = delete;

  /// Null where the library is not there, or has no such function.
  template <class Function>
  [[nodiscard]] Function function(const char* name) const {
    return reinterpret_cast<Function>(find(name));
  }

 private:
  using Any = void (*)();
  [[nodiscard]] Any find(const char* name) const;

  void* handle_;
};

}  // namespace lamp::app
