// SPDX-License-Identifier: Zlib
// libFuzzer's entry to one of the targets, which the build names.

#include "tests/fuzz/Targets.h"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::WETCLOTH_FUZZ_TARGET(std::string(reinterpret_cast<const char*>(data), size));
  return 0;
}
