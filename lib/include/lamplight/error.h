// How the library reports what can go wrong: values, never exceptions.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cassert>
#include <optional>
#include <string>
#include <utility>
#include <variant>

namespace lamp {

/// One line for a person: what is wrong, where, and what was expected.
/// `source` names the element ("light 3", "option tile", "buffer lists"), `message` says the rest.
struct Error {
  /// Both texts, always: an `Error("...")` that meant another namespace's exception does not compile.
  Error(std::string where, std::string what) : source(std::move(where)), message(std::move(what)) {}

  std::string source;
  std::string message;

  [[nodiscard]] std::string text() const { return source.empty() ? message : source + ": " + message; }
};

/// A value or an Error. Reading the one that is not there is a mistake of the caller and asserts.
template <class T>
class Result {
 public:
  Result(T value) : state_(std::move(value)) {}
  Result(Error error) : state_(std::move(error)) {}

  [[nodiscard]] bool ok() const { return std::holds_alternative<T>(state_); }
  explicit operator bool() const { return ok(); }

  [[nodiscard]] T& value() {
    assert(ok() && "check ok() before value()");
    return std::get<T>(state_);
  }
  [[nodiscard]] const T& value() const {
    assert(ok() && "check ok() before value()");
    return std::get<T>(state_);
  }
  [[nodiscard]] const Error& error() const {
    assert(!ok() && "check ok() before error()");
    return std::get<Error>(state_);
  }

 private:
  std::variant<T, Error> state_;
};

}  // namespace lamp
