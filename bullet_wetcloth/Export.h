// SPDX-License-Identifier: Zlib
#pragma once

#if __cplusplus < 201703L && !(defined(_MSVC_LANG) && _MSVC_LANG >= 201703L)
#error "bullet_wetcloth needs C++17: compile with -std=c++17 (/std:c++17) or later"
#endif

// What users of a shared library may call; the rest of it stays inside. WETCLOTH_SHARED is defined for users of the
// shared libraries, WETCLOTH_EXPORTS and WETCLOTH_COLLISION_EXPORTS while the one or the other is compiled: CMake sees
// to it, as do the pkg-config files. In the static libraries there is nothing to show: who links them into a plugin
// shows none of them.
#ifndef WETCLOTH_SHARED
#define WETCLOTH_EXPORT
#define WETCLOTH_COLLISION_EXPORT
#elif defined(_WIN32)
#ifdef WETCLOTH_EXPORTS
#define WETCLOTH_EXPORT __declspec(dllexport)
#else
#define WETCLOTH_EXPORT __declspec(dllimport)
#endif
#ifdef WETCLOTH_COLLISION_EXPORTS
#define WETCLOTH_COLLISION_EXPORT __declspec(dllexport)
#else
#define WETCLOTH_COLLISION_EXPORT __declspec(dllimport)
#endif
#else
#define WETCLOTH_EXPORT __attribute__((visibility("default")))
#define WETCLOTH_COLLISION_EXPORT __attribute__((visibility("default")))
#endif
