// SPDX-License-Identifier: Zlib
#pragma once

#include <string>

namespace stability {

/// The part of a text file between the lines `<!-- NAME -->` and `<!-- end of NAME -->`, which a program writes while
/// people write the rest.
class MarkedSection {
 public:
  /// Throws command::InputError when the file cannot be read or has not both lines, in this order.
  MarkedSection(std::string file, const std::string& name);

  /// Replaces what is between. Throws command::RunError when the file cannot be written.
  void write(const std::string& text) const;

 private:
  std::string m_file;
  std::string m_before;
  std::string m_after;
};

}  // namespace stability
