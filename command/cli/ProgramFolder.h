// SPDX-License-Identifier: Zlib
#pragma once

#include <filesystem>
#include <string>

namespace command {

/// The folder that this program is in; empty where the system does not tell.
std::filesystem::path programFolder();

/// A file of the data that go with the command: PREFIX/share/bullet_wetcloth/`name` beside PREFIX/bin, so that an
/// installed tree may be moved. The build tree has the same folders. The file may be missing.
std::string dataFile(const std::string& name);

}  // namespace command
