// What a shared library exports: declarations marked LAMPLIGHT_API, and nothing else.
// CMake defines LAMPLIGHT_STATIC for whoever links a static library, which has nothing to export, and lamplight_EXPORTS
// while the shared library itself is compiled; only Windows distinguishes it from programs that use it.
// SPDX-License-Identifier: Apache-2.0
#pragma once

#if defined(LAMPLIGHT_STATIC)
#define LAMPLIGHT_API
#elif defined(_WIN32) && defined(lamplight_EXPORTS)
#define LAMPLIGHT_API __declspec(dllexport)
#elif defined(_WIN32)
#define LAMPLIGHT_API __declspec(dllimport)
#else
#define LAMPLIGHT_API __attribute__((visibility("default")))
#endif
