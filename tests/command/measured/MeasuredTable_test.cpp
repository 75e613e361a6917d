// SPDX-License-Identifier: Zlib
#include "command/measured/MeasuredTable.h"

#include "command/cli/Errors.h"

#include "tests/command/Command.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>

namespace wetcloth_test::measured_table_test {
namespace {

using command::MeasuredTable;
using Allowed = MeasuredTable::Allowed;

MeasuredTable tableOf(const std::string& text) {
  const cli::TemporaryDirectory directory;
  return MeasuredTable(directory.write("data.csv", text));
}

/// The one line of an InputError, which must name the file.
std::string complaintOf(const std::function<void()>& action) {
  try {
    action();
  } catch (const command::InputError& error) {
    std::string text = error.what();
    EXPECT_EQ(text.find('\n'), std::string::npos) << text;
    EXPECT_NE(text.find(".csv"), std::string::npos) << text;
    return text;
  }
  ADD_FAILURE() << "was taken";
  return "";
}

void expectWords(const std::string& text, const std::vector<std::string>& words) {
  for (const std::string& word : words) EXPECT_NE(text.find(word), std::string::npos) << word << " is not in " << text;
}

TEST(MeasuredTable, ReadsCommentsNamesAndRows) {
  const MeasuredTable table = tableOf("# from a laboratory\ntime_s,height_m\n0,0.5\n# later\n\n10,0.75\n");
  EXPECT_EQ(table.rows(), 2u);
  EXPECT_EQ(table.increasing("time_s"), (std::vector<double>{0, 10}));
  EXPECT_EQ(table.numbers("height_m"), (std::vector<double>{0.5, 0.75}));
  EXPECT_TRUE(table.has("height_m"));
  EXPECT_FALSE(table.has("width_m"));
}

TEST(MeasuredTable, TakesWhatSpreadsheetsWrite) {
  const MeasuredTable table =
      tableOf("\xEF\xBB\xBF\"time_s\",\"cloth, and its weave\"\r\n1, \"say \"\"wool\"\"\" \r\n 2 ,plain\r\n3,\"\"");
  EXPECT_EQ(table.numbers("time_s"), (std::vector<double>{1, 2, 3}));
  EXPECT_EQ(table.words("cloth, and its weave"), (std::vector<std::string>{"say \"wool\"", "plain", ""}));
}

TEST(MeasuredTable, KeepsTheRowsOfOneWord) {
  const MeasuredTable table = tableOf("cloth,x\nwool,1\ncotton,2\nwool,3\n");
  EXPECT_EQ(table.where("cloth", "wool").numbers("x"), (std::vector<double>{1, 3}));
  EXPECT_EQ(table.where("cloth", "silk").rows(), 0u);
}

TEST(MeasuredTable, SaysWhatFileCannotBeHad) {
  expectWords(complaintOf([] { MeasuredTable("/nowhere/data.csv"); }), {"/nowhere/data.csv", "no such file"});
  expectWords(complaintOf([] { tableOf(" \n"); }), {"is empty"});
  expectWords(complaintOf([] { tableOf("# only where it is from\n"); }), {"must have a line that names the columns"});
}

TEST(MeasuredTable, SaysWhichColumnIsMissingAndWhichThereAre) {
  const MeasuredTable table = tableOf("time_s,height_mm\n1,2\n");
  expectWords(complaintOf([&] { table.numbers("height_m"); }),
              {"line 1: ", "\"height_m\"", "\"time_s\"", "\"height_mm\""});
  // Of semicolons, tabs, lines that end in CR alone, and UTF-16.
  expectWords(complaintOf([] { tableOf("# x\na;b\n1;2\n").numbers("a"); }), {"line 2: ", "\"a;b\"", "commas between"});
  for (const std::string& text : {std::string("a\tb\n1\t2\n"), std::string("a,b\r1,2\r"),
                                  std::string("\xff\xfe"
                                              "a\0\n\0",
                                              6)}) {
    expectWords(complaintOf([&] { tableOf(text); }), {"line 1, column ", "UTF-8", "commas between"});
  }
}

TEST(MeasuredTable, NamesLineAndColumnOfABadCell) {
  const auto at = [](const std::string& cell, Allowed allowed = Allowed::any) {
    return complaintOf(
        [&] { tableOf("# comment\ntime_s,height_m\n1,2\n3," + cell + "\n").numbers("height_m", allowed); });
  };
  for (const char* const cell : {"wet", "nan", "inf", "-inf", "", "1.5x", "1 2", "1e999", "0x1p3", "1d5"}) {
    expectWords(at(cell), {"line 4, column 2 (height_m) = \"" + std::string(cell) + "\"", "must be a finite number"});
  }
  expectWords(at("-1", Allowed::notNegative), {"line 4, column 2", "must be a finite number >= 0, with a point"});
  expectWords(at("0", Allowed::positive), {"line 4, column 2", "must be a finite number > 0, with a point"});
  expectWords(at("\x01\xff"), {"\\x01\\xff"});
}

// Squares of what is fitted, and of quotients of it, must be finite.
TEST(MeasuredTable, RefusesNumbersThatNobodyMeasures) {
  for (const char* const cell : {"1e308", "-1e21", "1e-21", "-5e-324"}) {
    expectWords(complaintOf([&] { tableOf("x\n" + std::string(cell) + "\n").numbers("x"); }),
                {"line 2, column 1 (x) = \"" + std::string(cell) + "\"", "1e-20", "1e20"});
  }
  EXPECT_EQ(tableOf("x\n1e20\n-1e-20\n0\n1e-400\n").numbers("x"), (std::vector<double>{1e20, -1e-20, 0, 0}));
}

TEST(MeasuredTable, NamesLineAndColumnOfARowOfAnotherLength) {
  expectWords(complaintOf([] { tableOf("a,b,c\n1,2,3\n1,2\n"); }), {"line 3, column 3 (c)", "is missing"});
  expectWords(complaintOf([] { tableOf("a,b\n0,5,1,5\n"); }), {"line 2, column 3", "\"1\"", "one too many", "point"});
}

TEST(MeasuredTable, RefusesNamesThatDoNotTellColumnsApart) {
  expectWords(complaintOf([] { tableOf("a,b,a\n1,2,3\n"); }), {"line 1, column 3", "\"a\"", "two columns"});
  expectWords(complaintOf([] { tableOf("a,,b\n1,2,3\n"); }), {"line 1, column 2", "must have a name"});
}

TEST(MeasuredTable, RefusesQuotesThatDoNotEnd) {
  expectWords(complaintOf([] { tableOf("a,b\n1,\"x\n2,y\"\n"); }), {"line 2", "quote is not closed"});
  expectWords(complaintOf([] { tableOf("a,b\n\"x\"y,1\n"); }), {"line 2", "\"x\"", "comma"});
}

TEST(MeasuredTable, RefusesTimesThatDoNotGrow) {
  for (const char* const time : {"1", "0.5"}) {
    const MeasuredTable table = tableOf("time_s\n0\n1\n" + std::string(time) + "\n2\n");
    expectWords(complaintOf([&] { table.increasing("time_s"); }),
                {"line 4, column 1 (time_s)", "must be greater than the 1 of line 3"});
  }
}

TEST(MeasuredTable, FindsRowsByTheirKeys) {
  const MeasuredTable table = tableOf("cloth,x\nwool,10\ncotton,9\nwool,-1\nsilk,9\n");
  EXPECT_EQ(table.distinct("cloth"), (std::vector<std::string>{"wool", "cotton", "silk"}));
  const MeasuredTable sorted = table.sortedBy("x");
  EXPECT_EQ(sorted.numbers("x"), (std::vector<double>{-1, 9, 9, 10}));
  EXPECT_EQ(sorted.words("cloth"), (std::vector<std::string>{"wool", "cotton", "silk", "wool"}))
      << "equal ones keep their order";
  expectWords(complaintOf([&] { sorted.increasing("x", Allowed::any); }), {"line 5, column 2 (x)", "the 9 of line 3"});
  expectWords(complaintOf([] { tableOf("x\n1\ntwo\n").sortedBy("x"); }), {"line 3, column 1 (x)"});
}

TEST(MeasuredTable, RefusesTooFewRows) {
  const MeasuredTable table = tableOf("a\n1\n2\n");
  table.requireRows(2, "for nothing");
  expectWords(complaintOf([&] { table.requireRows(3, "to fit 2 numbers"); }),
              {"2 rows", "at least 3", "to fit 2 numbers"});
  expectWords(complaintOf([] { tableOf("a\n1\n").requireRows(2, "to fit 1 number"); }), {"has 1 row of readings,"});
  expectWords(complaintOf([] { tableOf("a\n").requireRows(2, "to fit 1 number"); }), {"has no rows of readings,"});
}

TEST(MeasuredTable, NamesTheKeysOfRowsThatAreTooFew) {
  const MeasuredTable table = tableOf("fibre,knit,x\nwool,flat,1\nwool,terry,2\n");
  expectWords(complaintOf([&] { table.where("fibre", "wool").where("knit", "flat").requireRows(2, "for nothing"); }),
              {"has 1 row of readings with fibre = \"wool\", knit = \"flat\", must have at least 2"});
}

TEST(MeasuredTable, EveryFileOfMeasurementsIsThereAndReads) {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(WETCLOTH_SOURCE_DIR "/tests/data/measured")) {
    ++files;
    EXPECT_GT(MeasuredTable(entry.path().string()).rows(), 0u) << entry.path();
  }
  EXPECT_GT(files, 10);
}

}  // namespace
}  // namespace wetcloth_test::measured_table_test
