// What a shared library exports: declarations marked LAMPLIGHT_API, and nothing else.
// CMake defines LAMPLIGHT_STATIC for whoever links a static library, which has nothing to export.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#ifdef LAMPLIGHT_STATIC
#define LAMPLIGHT_API
#else
#define LAMPLIGHT_API __attribute__((visibility("default")))
#endif
