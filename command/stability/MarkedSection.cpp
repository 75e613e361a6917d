// SPDX-License-Identifier: Zlib
#include "command/stability/MarkedSection.h"

#include "command/cli/Errors.h"

#include <fstream>
#include <sstream>
#include <utility>

namespace stability {

MarkedSection::MarkedSection(std::string file, const std::string& name) : m_file(std::move(file)) {
  std::ifstream stream(m_file, std::ios::binary);
  std::ostringstream read;
  read << stream.rdbuf();
  if (!stream) throw command::InputError(m_file + ": cannot be read");
  const std::string text = read.str();
  const std::string first = "<!-- " + name + " -->\n";
  const std::string last = "<!-- end of " + name + " -->";
  const std::size_t begin = text.find(first);
  const std::size_t end = begin == std::string::npos ? begin : text.find(last, begin);
  if (end == std::string::npos) {
    throw command::InputError(m_file + ": must have the lines \"<!-- " + name + " -->\" and \"" + last +
                              "\", between which the table is written");
  }
  m_before = text.substr(0, begin + first.size());
  m_after = text.substr(end);
}

void MarkedSection::write(const std::string& text) const {
  std::ofstream stream(m_file, std::ios::binary);
  stream << m_before << text << m_after;
  stream.close();
  if (!stream) throw command::RunError(m_file + ": cannot be written");
}

}  // namespace stability
