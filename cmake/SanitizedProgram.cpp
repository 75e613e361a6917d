// SPDX-License-Identifier: Zlib
// In each program of a sanitized build: what is known of other people's libraries.

extern "C" {

/// Nothing is unloaded. What a driver of OpenGL keeps until the end of the process would be a leak else, and from a place
/// whose name is gone.
int dlclose(void*) { return 0; }

/// assimp does not give back all that it has read of a file that it then refuses.
const char* __lsan_default_suppressions() { return "leak:libassimp\n"; }
const char* __lsan_default_options() { return "print_suppressions=0"; }

/// Mesa's drawing by the processor has threads of its own, whose locks the sanitizer does not see.
const char* __tsan_default_suppressions() { return "race:swrast_dri\nrace:libgallium\nrace:libLLVM\n"; }
}
