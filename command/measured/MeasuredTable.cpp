// SPDX-License-Identifier: Zlib
#include "command/measured/MeasuredTable.h"

#include "command/measured/CsvCells.h"

#include "command/cli/Errors.h"
#include "command/cli/NearestWord.h"
#include "command/cli/ProgramFolder.h"
#include "command/cli/ShownField.h"
#include "command/cli/TextFile.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numeric>
#include <stdexcept>
#include <string_view>

namespace command {
namespace {

constexpr std::string_view byteOrderMark = "\xEF\xBB\xBF";
constexpr const char* const howCellsGo = "; cells go with commas between, numbers have a point";

// Squares of these, and of quotients of them, are finite and not 0.
constexpr double leastMeasured = 1e-20, mostMeasured = 1e20;

std::string placeOf(const std::string& file, std::size_t line) { return file + ": line " + std::to_string(line); }

bool hasControls(const std::string& text) {
  return std::any_of(text.begin(), text.end(), [](unsigned char byte) { return byte < 0x20 || byte == 0x7f; });
}

const char* textOf(MeasuredTable::Allowed allowed) {
  switch (allowed) {
    case MeasuredTable::Allowed::notNegative: return "must be a finite number >= 0, with a point";
    case MeasuredTable::Allowed::positive: return "must be a finite number > 0, with a point";
    case MeasuredTable::Allowed::any: break;
  }
  return "must be a finite number, with a point";
}

/// Of digits, as people write it: no "inf", no hexadecimal one. NaN when it is none.
double numberIn(const std::string& cell) {
  const bool isDecimal = !cell.empty() && cell.find_first_not_of("+-.0123456789eE") == std::string::npos;
  char* end = nullptr;
  const double number = isDecimal ? std::strtod(cell.c_str(), &end) : 0;
  return isDecimal && *end == '\0' ? number : std::nan("");
}

bool isMeasurable(double number) {
  return number == 0 || (std::fabs(number) >= leastMeasured && std::fabs(number) <= mostMeasured);
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
  m_headerLine = row.line;
  for (std::size_t i = 0; i < row.cells.size(); ++i) {
    const std::string place = placeOf(m_file, row.line) + ", column " + std::to_string(i + 1);
    if (row.cells[i].empty()) throw InputError(place + ": must have a name");
    if (hasControls(row.cells[i])) {
      throw InputError(place + " = " + shownField(row.cells[i]) +
                       ": has control characters; a table is text in UTF-8, its lines end in LF or CR LF" + howCellsGo);
    }
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
                     shownField(row.cells[column]) + ": is one too many" + howCellsGo);
  }
}

bool MeasuredTable::has(const std::string& column) const {
  return std::find(m_columns.begin(), m_columns.end(), column) != m_columns.end();
}

std::size_t MeasuredTable::indexOf(const std::string& column) const {
  const auto found = std::find(m_columns.begin(), m_columns.end(), column);
  if (found != m_columns.end()) return static_cast<std::size_t>(found - m_columns.begin());
  std::vector<std::string> shown;
  for (const std::string& name : m_columns) shown.push_back(shownField(name));
  throw InputError(placeOf(m_file, m_headerLine) + ": must have a column " + shownField(column) + "; its columns are " +
                   joined(shown) + (shown.size() == 1 ? howCellsGo : ""));
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
    const double number = numberIn(cells[i]);
    if (!isAllowedNumber(number, allowed)) reject(i, column, textOf(allowed));
    if (!isMeasurable(number)) reject(i, column, "nobody measures that; must be 0 or from 1e-20 to 1e20 in size");
    numbers.push_back(number);
  }
  return numbers;
}

std::vector<double> MeasuredTable::increasing(const std::string& column, Allowed allowed) const {
  std::vector<double> values = numbers(column, allowed);
  for (std::size_t i = 1; i < values.size(); ++i) {
    if (values[i] > values[i - 1]) continue;
    const Row& before = m_rows[i - 1];
    reject(i, column,
           "must be greater than the " + before.cells[indexOf(column)] + " of line " + std::to_string(before.line));
  }
  return values;
}

std::vector<std::string> MeasuredTable::distinct(const std::string& column) const {
  std::vector<std::string> seen;
  for (const std::string& word : words(column)) {
    if (std::find(seen.begin(), seen.end(), word) == seen.end()) seen.push_back(word);
  }
  return seen;
}

MeasuredTable MeasuredTable::where(const std::string& column, const std::string& word) const {
  const std::size_t index = indexOf(column);
  MeasuredTable some = *this;
  const auto isOther = [&](const Row& row) { return row.cells[index] != word; };
  some.m_rows.erase(std::remove_if(some.m_rows.begin(), some.m_rows.end(), isOther), some.m_rows.end());
  some.m_keys += (m_keys.empty() ? " with " : ", ") + column + " = " + shownField(word);
  return some;
}

MeasuredTable MeasuredTable::sortedBy(const std::string& column) const {
  const std::vector<double> values = numbers(column);
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), std::size_t(0));
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return values[a] < values[b]; });
  MeasuredTable sorted = *this;
  for (std::size_t i = 0; i < order.size(); ++i) sorted.m_rows[i] = m_rows[order[i]];
  return sorted;
}

void MeasuredTable::requireRows(std::size_t least, const std::string& why) const {
  if (rows() >= least) return;
  const std::string count = rows() == 0 ? "no rows" : rows() == 1 ? "1 row" : std::to_string(rows()) + " rows";
  throw InputError(m_file + ": has " + count + " of readings" + m_keys + ", must have at least " +
                   std::to_string(least) + " " + why);
}

}  // namespace command
