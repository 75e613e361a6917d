// SPDX-License-Identifier: Zlib
#include "command/measured/MeasuredTable.h"

#include "command/cli/Errors.h"
#include "command/cli/NearestWord.h"
#include "command/cli/ProgramFolder.h"
#include "command/cli/ShownField.h"
#include "command/cli/TextFile.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <string_view>

namespace command {
namespace {

constexpr std::string_view byteOrderMark = "\xEF\xBB\xBF";

std::string placeOf(const std::string& file, std::size_t line) { return file + ": line " + std::to_string(line); }

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

std::vector<std::string> cellsOf(std::string_view rest, const std::string& place) {
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

const char* textOf(MeasuredTable::Allowed allowed) {
  switch (allowed) {
    case MeasuredTable::Allowed::notNegative: return "must be finite and >= 0";
    case MeasuredTable::Allowed::positive: return "must be finite and > 0";
    case MeasuredTable::Allowed::any: break;
  }
  return "must be a finite number";
}

bool isAllowedNumber(double number, MeasuredTable::Allowed allowed) {
  if (!std::isfinite(number)) return false;
  if (allowed == MeasuredTable::Allowed::positive) return number > 0;
  return allowed == MeasuredTable::Allowed::any || number >= 0;
}

}  // namespace

std::string measuredFile(const std::string& name) { return dataFile("measured/" + name + ".csv"); }

MeasuredTable::MeasuredTable(const std::string& file) : m_file(file) {
  try {
    read(readTextFile(file));
  } catch (const std::invalid_argument& error) {
    throw InputError(file + ": " + error.what());
  }
}

void MeasuredTable::read(const std::string& text) {
  std::string_view rest = text;
  if (rest.substr(0, byteOrderMark.size()) == byteOrderMark) rest.remove_prefix(byteOrderMark.size());
  for (std::size_t number = 1; !rest.empty(); ++number) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    if (line.find_first_not_of(" \t") == std::string_view::npos || line.front() == '#') continue;
    const Row row{number, cellsOf(line, placeOf(m_file, number))};
    if (m_columns.empty()) {
      addHeader(row);
    } else {
      requireLength(row);
      m_rows.push_back(row);
    }
  }
  if (m_columns.empty()) throw InputError(m_file + ": must have a line that names the columns");
}

void MeasuredTable::addHeader(const Row& row) {
  for (std::size_t i = 0; i < row.cells.size(); ++i) {
    const std::string place = placeOf(m_file, row.line) + ", column " + std::to_string(i + 1);
    if (row.cells[i].empty()) throw InputError(place + ": must have a name");
    if (has(row.cells[i])) throw InputError(place + " = " + shownField(row.cells[i]) + ": is the name of two columns");
    m_columns.push_back(row.cells[i]);
  }
}

void MeasuredTable::requireLength(const Row& row) const {
  if (row.cells.size() < m_columns.size()) {
    const std::size_t column = row.cells.size();
    throw InputError(placeOf(m_file, row.line) + ", column " + std::to_string(column + 1) + " (" + m_columns[column] +
                     "): is missing");
  }
  if (row.cells.size() > m_columns.size()) {
    const std::size_t column = m_columns.size();
    throw InputError(placeOf(m_file, row.line) + ", column " + std::to_string(column + 1) + " = " +
                     shownField(row.cells[column]) +
                     ": is one too many; cells go with commas between, numbers have a point");
  }
}

bool MeasuredTable::has(const std::string& column) const {
  return std::find(m_columns.begin(), m_columns.end(), column) != m_columns.end();
}

std::size_t MeasuredTable::indexOf(const std::string& column) const {
  const auto found = std::find(m_columns.begin(), m_columns.end(), column);
  if (found != m_columns.end()) return static_cast<std::size_t>(found - m_columns.begin());
  throw InputError(m_file + ": must have a column " + shownField(column) + "; its columns are " + joined(m_columns));
}

void MeasuredTable::reject(std::size_t row, const std::string& column, const std::string& complaint) const {
  const std::size_t index = indexOf(column);
  const Row& at = m_rows.at(row);
  throw InputError(placeOf(m_file, at.line) + ", column " + std::to_string(index + 1) + " (" + column +
                   ") = " + shownField(at.cells[index]) + ": " + complaint);
}

std::vector<std::string> MeasuredTable::words(const std::string& column) const {
  const std::size_t index = indexOf(column);
  std::vector<std::string> cells;
  for (const Row& row : m_rows) cells.push_back(row.cells[index]);
  return cells;
}

std::vector<double> MeasuredTable::numbers(const std::string& column, Allowed allowed) const {
  const std::vector<std::string> cells = words(column);
  std::vector<double> numbers;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    char* end = nullptr;
    const double number = std::strtod(cells[i].c_str(), &end);
    const bool isNumber = !cells[i].empty() && end == cells[i].c_str() + cells[i].size();
    if (!isNumber || !isAllowedNumber(number, allowed)) reject(i, column, textOf(allowed));
    numbers.push_back(number);
  }
  return numbers;
}

std::vector<double> MeasuredTable::increasing(const std::string& column, Allowed allowed) const {
  std::vector<double> values = numbers(column, allowed);
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (!(values[i] > values[i - 1])) reject(i, column, "must be greater than in the row before");
  }
  return values;
}

MeasuredTable MeasuredTable::where(const std::string& column, const std::string& word) const {
  const std::size_t index = indexOf(column);
  MeasuredTable some = *this;
  const auto isOther = [&](const Row& row) { return row.cells[index] != word; };
  some.m_rows.erase(std::remove_if(some.m_rows.begin(), some.m_rows.end(), isOther), some.m_rows.end());
  return some;
}

void MeasuredTable::requireRows(std::size_t least, const std::string& why) const {
  if (rows() >= least) return;
  throw InputError(m_file + ": has " + std::to_string(rows()) + " rows of readings, must have at least " +
                   std::to_string(least) + " " + why);
}

}  // namespace command
