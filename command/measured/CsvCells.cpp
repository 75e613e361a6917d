// SPDX-License-Identifier: Zlib
#include "command/measured/CsvCells.h"

#include "command/cli/Errors.h"
#include "command/cli/ShownField.h"

#include <algorithm>

namespace command {
namespace {

std::string trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(" \t") + 1 - first));
}

/// Takes the cell in quotes that the rest of a line begins with.
std::string takeQuoted(std::string_view& rest, const std::string& place) {
  std::string cell;
  for (std::size_t i = 1; i < rest.size(); ++i) {
    if (rest[i] != '"') {
      cell += rest[i];
    } else if (i + 1 < rest.size() && rest[i + 1] == '"') {
      cell += rest[i++];
    } else {
      rest.remove_prefix(i + 1);
      const std::size_t next = rest.find_first_not_of(" \t");
      if (next != std::string_view::npos && rest[next] != ',') {
        throw InputError(place + ": after a quote that closes " + shownField(cell) + " there must be a comma");
      }
      rest.remove_prefix(next == std::string_view::npos ? rest.size() : next);
      return cell;
    }
  }
  throw InputError(place + ": a quote is not closed on its line");
}

}  // namespace

std::vector<std::string> cellsOf(std::string_view line, const std::string& place) {
  std::string_view rest = line;
  std::vector<std::string> cells;
  while (true) {
    rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
    if (!rest.empty() && rest.front() == '"') {
      cells.push_back(takeQuoted(rest, place));
    } else {
      const std::size_t end = std::min(rest.find(','), rest.size());
      cells.push_back(trimmed(rest.substr(0, end)));
      rest.remove_prefix(end);
    }
    if (rest.empty()) return cells;
    rest.remove_prefix(1);
  }
}

}  // namespace command
