// SPDX-License-Identifier: Zlib
// Says what it was started with, one word a line. Tests put it where the command expects its sibling.

#include <cstdio>

int main(int count, char** arguments) {
  for (int i = 1; i < count; ++i) std::puts(arguments[i]);
  return 7;
}
