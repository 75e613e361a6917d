// SPDX-License-Identifier: Zlib
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace command {

/// Measurements from a CSV file in UTF-8: lines that begin with # say where they are from, the first other line names
/// the columns, each further one is a reading. Cells may stand in quotes, in which "" is one. Lines may end in CR LF,
/// and the file may begin with a byte order mark.
///
/// Complaints are InputErrors of one line that names file, line, column, cell and what is allowed. Lines and columns
/// count from 1.
class MeasuredTable {
 public:
  /// What the numbers of a column may be; never NaN, infinite, or further from 1 than anybody measures.
  enum class Allowed { any, notNegative, positive };

  /// Throws InputError when the file cannot be read, has no columns, two of the same name, or a row of another length.
  explicit MeasuredTable(const std::string& file);

  const std::string& file() const { return m_file; }
  std::size_t rows() const { return m_rows.size(); }
  const std::vector<std::string>& columns() const { return m_columns; }
  bool has(const std::string& column) const;

  /// A column's cells as they are. Throws InputError, with the columns that there are, when there is none of that name.
  std::vector<std::string> words(const std::string& column) const;
  /// A column's cells as numbers with a point: 0, or from 1e-20 to 1e20 in size. Throws InputError when one is empty,
  /// no such number, or not allowed.
  std::vector<double> numbers(const std::string& column, Allowed allowed = Allowed::any) const;
  /// The same, each greater than the one before: of times.
  std::vector<double> increasing(const std::string& column, Allowed allowed = Allowed::notNegative) const;

  /// A column's words, each once, in the order in which they first come.
  std::vector<std::string> distinct(const std::string& column) const;

  /// The rows whose cell in this column is that word.
  MeasuredTable where(const std::string& column, const std::string& word) const;
  /// The rows in the order of this column's numbers, least first. Throws InputError as numbers() does.
  MeasuredTable sortedBy(const std::string& column) const;
  /// Throws InputError when there are fewer rows. @param why  "to fit 2 numbers"
  void requireRows(std::size_t least, const std::string& why) const;
  /// Throws InputError that complains of one cell. @param row  counted from 0
  [[noreturn]] void reject(std::size_t row, const std::string& column, const std::string& complaint) const;

 private:
  struct Row {
    std::size_t line;
    std::vector<std::string> cells;
  };

  void read(const std::string& text);
  void addHeader(const Row& row);
  void requireLength(const Row& row) const;
  std::size_t indexOf(const std::string& column) const;

  std::string m_file;
  std::string m_keys;  ///< by which the rows were chosen, for complaints
  std::size_t m_headerLine = 0;
  std::vector<std::string> m_columns;
  std::vector<Row> m_rows;
};

/// A file of measurements that goes with the command, by its name without ".csv".
std::string measuredFile(const std::string& name);

}  // namespace command
