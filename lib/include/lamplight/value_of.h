// Results for programs that use exceptions.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <utility>

#include "lamplight/error.h"

namespace lamp {

/// What a result holds. Throws std::runtime_error, whose text is Error::text(), if that is an error. May be called for
/// that alone.
template <class T>
T value_of(Result<T> result) {
  if (!result) throw std::runtime_error(result.error().text());
  return std::move(result.value());
}

}  // namespace lamp
