// SPDX-License-Identifier: Zlib
#include "command/cli/CommandLine.h"
#include "command/cli/Errors.h"

#include <cstdio>
#include <exception>

int main(int count, char** arguments) {
  try {
    return command::runCommandLine(count, arguments);
  } catch (const command::InputError& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "%s\n", command::onOneLine(error.what()).c_str());
    return 1;
  }
}
