// The signals of child processes.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <spawn.h>

namespace lamp::app {

/// Lets a child process begin with the signals as they were before watch_signals().
void restore_signals(posix_spawnattr_t& attributes);

}  // namespace lamp::app
