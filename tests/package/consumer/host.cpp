// SPDX-License-Identifier: Zlib
// An application that knows of no wet cloth and loads a plugin that does: argument 1.
#include <dlfcn.h>

#include <cstdio>

int main(int count, char** arguments) {
  void* const plugin = count == 2 ? dlopen(arguments[1], RTLD_NOW | RTLD_LOCAL) : nullptr;
  if (plugin == nullptr) {
    std::printf("%s\n", count == 2 ? dlerror() : "usage: host PLUGIN");
    return 1;
  }
  const auto useWetCloth = reinterpret_cast<int (*)()>(dlsym(plugin, "useWetCloth"));
  return useWetCloth != nullptr ? useWetCloth() : 1;
}
