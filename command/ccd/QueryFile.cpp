// SPDX-License-Identifier: Zlib
#include "command/ccd/QueryFile.h"

#include "command/ccd/Gunzip.h"
#include "command/cli/Errors.h"
#include "command/cli/ShownField.h"
#include "command/cli/TextFile.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

namespace command {
namespace {

const std::vector<std::string>& columnNames() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all{"id", "scene", "type", "truth"};
    for (const char* time : {"_t0", "_t1"}) {
      for (const char* point : {"0", "1", "2", "3"}) {
        for (const char* axis : {"x", "y", "z"}) all.push_back(std::string(axis) + point + time);
      }
    }
    return all;
  }();
  return names;
}

/// The lines of a file one after the other, and complaints about where in them something is wrong.
class Lines {
 public:
  Lines(const std::string& file, std::string_view text) : m_file(file), m_rest(text) {}

  /// Lines with nothing in them at the end are none.
  bool next(std::vector<std::string_view>& fields) {
    if (m_rest.find_first_not_of("\r\n") == std::string_view::npos) return false;
    ++m_number;
    const std::size_t end = m_rest.find('\n');
    std::string_view line = m_rest.substr(0, end);
    m_rest.remove_prefix(end == std::string_view::npos ? m_rest.size() : end + 1);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    fields.clear();
    for (std::size_t comma = 0; comma != std::string_view::npos;) {
      comma = line.find(',');
      fields.push_back(line.substr(0, comma));
      line.remove_prefix(comma == std::string_view::npos ? 0 : comma + 1);
    }
    requireCount(fields);
    return true;
  }

  /// @param column counted from 0
  [[noreturn]] void reject(std::size_t column, std::string_view field, const std::string& complaint) const {
    throw InputError(m_file + ":" + std::to_string(m_number) + ": column " + std::to_string(column + 1) + " (" +
                     columnNames()[column] + "): " + shownField(field) + ": " + complaint);
  }

 private:
  void requireCount(const std::vector<std::string_view>& fields) const {
    const std::size_t wanted = columnNames().size();
    if (fields.size() == wanted) return;
    const std::size_t column = std::min(fields.size(), wanted);
    throw InputError(m_file + ":" + std::to_string(m_number) + ": column " + std::to_string(column + 1) +
                     (column < wanted ? " (" + columnNames()[column] + ") is missing" : " is one too many") +
                     ": must have " + std::to_string(wanted) + " fields");
  }

  const std::string& m_file;
  std::string_view m_rest;
  std::size_t m_number = 0;
};

double numberIn(const Lines& lines, std::size_t column, std::string_view field) {
  // Some standard libraries have no std::from_chars for floating point. This stops where a field ends: at a comma, the
  // end of a line or of the text.
  char* stopped = nullptr;
  errno = 0;
  const double number = std::strtod(field.data(), &stopped);
  const bool isPlain = !field.empty() && field.find_first_of(" \t\v\f\r\nxX") == std::string_view::npos;
  if (!isPlain || stopped != field.data() + field.size()) lines.reject(column, field, "must be a number");
  if (errno == ERANGE && std::isinf(number)) lines.reject(column, field, "must be in the range of a double");
  if (!std::isfinite(number)) lines.reject(column, field, "must be finite");
  return number;
}

/// Which of the two words the field is: true for the second.
bool isSecond(const Lines& lines, std::size_t column, std::string_view field, const char* first, const char* second) {
  if (field == second) return true;
  if (field != first) lines.reject(column, field, std::string("must be ") + first + " or " + second);
  return false;
}

KnownQuery queryIn(const Lines& lines, const std::vector<std::string_view>& fields) {
  using wetcloth::collision::Pair;
  KnownQuery query;
  query.id = fields[0];
  query.pair = isSecond(lines, 2, fields[2], "vf", "ee") ? Pair::edgeEdge : Pair::vertexFace;
  query.meets = isSecond(lines, 3, fields[3], "0", "1");
  std::size_t column = 4;
  for (auto* points : {&query.points.start, &query.points.end}) {
    for (auto& point : *points) {
      for (double& coordinate : point) {
        coordinate = numberIn(lines, column, fields[column]);
        ++column;
      }
    }
  }
  return query;
}

std::string textOf(const std::string& file) {
  try {
    return gunzipped(readTextFile(file));
  } catch (const std::invalid_argument& error) {
    throw InputError(onOneLine(file) + ": " + error.what());
  }
}

}  // namespace

std::vector<KnownQuery> readQueries(const std::string& file) {
  const std::string text = textOf(file);
  constexpr std::string_view byteOrderMark = "\xEF\xBB\xBF";
  const std::size_t start = text.compare(0, byteOrderMark.size(), byteOrderMark) == 0 ? byteOrderMark.size() : 0;
  const std::string name = onOneLine(file);
  Lines lines(name, std::string_view(text).substr(start));
  std::vector<std::string_view> fields;
  if (!lines.next(fields)) throw InputError(name + ": is empty");
  for (std::size_t column = 0; column < fields.size(); ++column) {
    const std::string& wanted = columnNames()[column];
    if (fields[column] != wanted) lines.reject(column, fields[column], "must be the heading \"" + wanted + "\"");
  }
  std::vector<KnownQuery> queries;
  while (lines.next(fields)) queries.push_back(queryIn(lines, fields));
  if (queries.empty()) throw InputError(name + ": has a heading but no queries, must have at least one");
  return queries;
}

}  // namespace command
