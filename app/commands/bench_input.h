// What is wrong with the input of `lamp bench` is said before any work.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <string>

#include "bench/groups.h"

namespace lamp::app {

/// Throws Error for what is meant neither as a suite nor as a scene.
void check_bench_name(const std::string& name);

/// Throws Error for a name that no series of the suite has, and where a scene is asked for one.
void check_series(std::span<const std::string> asked, const std::string& scene, const Suite& suite);

/// Checks what a suite's file cannot know by itself to be wrong, and hashes the files of scenes. `suite`: empty where a
/// scene was named.
void check_groups(const std::string& suite, std::span<Group> groups);

}  // namespace lamp::app
