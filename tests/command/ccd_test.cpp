// SPDX-License-Identifier: Zlib
#include "tests/command/Command.h"

#include <bullet_wetcloth/collision/ContinuousCheck.h>

#include <gtest/gtest.h>
#include <zlib.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <ostream>
#include <string>
#include <vector>

namespace wetcloth_test::ccd_test {
namespace {

using namespace cli;

std::string dataFile(const std::string& collection) {
  return WETCLOTH_SOURCE_DIR "/tests/data/ccd/" + collection + "_queries.csv.gz";
}

using Fields = std::vector<std::string>;

std::string joined(const Fields& fields) {
  std::string line;
  for (const std::string& field : fields) line += (line.empty() ? "" : ",") + field;
  return line;
}

Fields heading() {
  Fields fields{"id", "scene", "type", "truth"};
  for (const char* time : {"_t0", "_t1"}) {
    for (const char* point : {"0", "1", "2", "3"}) {
      for (const char* axis : {"x", "y", "z"}) fields.push_back(std::string(axis) + point + time);
    }
  }
  return fields;
}

/// A vertex that falls through the middle of a triangle at rest.
Fields falling() {
  return {"falling", "made", "vf",   "1",    "0.25", "0.25", "1", "0", "0", "0", "1", "0", "0", "0",
          "1",       "0",    "0.25", "0.25", "-1",   "0",    "0", "0", "1", "0", "0", "0", "1", "0"};
}

/// Two edges that stay apart.
Fields apart() {
  return {"apart", "made", "ee", "0", "0", "0", "0", "1", "0", "0", "0", "0", "5", "0",
          "1",     "5",    "0",  "0", "0", "1", "0", "0", "0", "0", "4", "0", "1", "4"};
}

std::string fileOf(const std::vector<Fields>& lines, const std::string& lineEnd = "\n") {
  std::string text;
  for (const Fields& line : lines) text += joined(line) + lineEnd;
  return text;
}

std::string goodText() { return fileOf({heading(), falling(), apart()}); }

std::string compressed(const TemporaryDirectory& directory, const std::string& text) {
  const std::string path = directory.path("made.gz");
  const gzFile file = gzopen(path.c_str(), "wb");
  gzwrite(file, text.data(), static_cast<unsigned>(text.size()));
  gzclose(file);
  std::ifstream stream(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

Outcome ccd(std::vector<std::string> more) {
  more.insert(more.begin(), "ccd");
  more.insert(more.end(), {"--passes", "1"});
  return runWetcloth(more);
}

Json resultOf(const std::string& file, const std::string& method, std::vector<std::string> more = {}) {
  more.insert(more.begin(), {file, "--method", method, "--json", "-"});
  const Outcome outcome = ccd(more);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return outcome.status == 0 ? Json::parse(outcome.out) : Json();
}

struct BadLine {
  std::string name;
  std::function<void(Fields&)> spoil;
  std::string complaint;  ///< behind the file and its third line
};

std::ostream& operator<<(std::ostream& stream, const BadLine& bad) { return stream << bad.name; }

/// @param column counted from 1
BadLine at(const std::string& name, std::size_t column, const std::string& value, const std::string& complaint) {
  return {name, [=](Fields& fields) { fields[column - 1] = value; },
          "column " + std::to_string(column) + " (" + heading()[column - 1] + "): \"" + value + "\": " + complaint};
}

std::vector<BadLine> badLines() {
  return {
      at("Type", 3, "vv", "must be vf or ee"),
      at("TypeInCapitals", 3, "VF", "must be vf or ee"),
      at("Truth", 4, "2", "must be 0 or 1"),
      at("TruthEmpty", 4, "", "must be 0 or 1"),
      at("Word", 5, "abc", "must be a number"),
      at("Empty", 16, "", "must be a number"),
      at("Space", 5, " 1", "must be a number"),
      at("RubbishBehindANumber", 28, "1.5m", "must be a number"),
      at("DecimalComma", 5, "1;5", "must be a number"),
      at("NotANumber", 17, "nan", "must be finite"),
      at("Infinite", 17, "-inf", "must be finite"),
      at("TooLarge", 17, "1e999", "must be in the range of a double"),
      {"TooFew", [](Fields& fields) { fields.pop_back(); }, "column 28 (z3_t1) is missing: must have 28 fields"},
      {"TooMany", [](Fields& fields) { fields.emplace_back("0"); }, "column 29 is one too many: must have 28 fields"},
      {"Blank", [](Fields& fields) { fields = {}; }, "column 2 (scene) is missing: must have 28 fields"},
  };
}

using CcdBadLine = testing::TestWithParam<BadLine>;

struct Expected {
  std::string collection;
  std::string method;
};

std::ostream& operator<<(std::ostream& stream, const Expected& tested) {
  return stream << tested.collection << "_" << tested.method;
}

using CcdTier = testing::TestWithParam<Expected>;

TEST_P(CcdBadLine, IsRefusedWithItsPlace) {
  const TemporaryDirectory directory;
  Fields fields = apart();
  GetParam().spoil(fields);
  const std::string file = directory.write("queries.csv", fileOf({heading(), falling(), fields, apart()}));
  expectRefusal(ccd({file}), {file + ":3: " + GetParam().complaint});
}

INSTANTIATE_TEST_SUITE_P(Lines, CcdBadLine, testing::ValuesIn(badLines()),
                         [](const auto& tested) { return tested.param.name; });

TEST(Ccd, FilesThatHoldNoQueries) {
  const TemporaryDirectory directory;
  expectRefusal(ccd({directory.path("none.csv")}), {directory.path("none.csv"), "no such file"});
  expectRefusal(ccd({directory.path("")}), {"directory"});
  expectRefusal(ccd({directory.write("empty.csv", "")}), {"empty.csv", "is empty"});
  expectRefusal(ccd({directory.write("empty.csv.gz", compressed(directory, ""))}), {"empty.csv.gz", "is empty"});
  expectRefusal(ccd({directory.write("heading.csv", fileOf({heading()}))}), {"no queries"});
  Fields other = heading();
  other[2] = "kind";
  expectRefusal(ccd({directory.write("other.csv", fileOf({other, apart()}))}),
                {"other.csv:1: column 3 (type): \"kind\": must be the heading \"type\""});
  expectRefusal(ccd({directory.write("bare.csv", fileOf({apart()}))}), {"bare.csv:1: column 1 (id)"});
  expectRefusal(ccd({directory.write("binary.csv", std::string("\0\x01\n\xff", 4))}), {"binary.csv:1: "});
}

TEST(Ccd, DamagedGzip) {
  const TemporaryDirectory directory;
  const std::string good = compressed(directory, goodText());
  for (const std::size_t kept : {std::size_t(5), good.size() / 2, good.size() - 8, good.size() - 1}) {
    expectRefusal(ccd({directory.write("short.csv.gz", good.substr(0, kept))}), {"short.csv.gz", "cut short"});
  }
  std::string checksum = good;
  checksum[good.size() - 7] = static_cast<char>(~checksum[good.size() - 7]);
  expectRefusal(ccd({directory.write("checksum.csv.gz", checksum)}), {"checksum.csv.gz", "damaged"});
  expectRefusal(ccd({directory.write("more.csv.gz", good + "rubbish")}), {"more.csv.gz", "7 bytes behind its end"});
}

TEST(Ccd, EveryWayToWriteTheSameFile) {
  const TemporaryDirectory directory;
  const std::string gz = compressed(directory, goodText());
  std::string noLastLineEnd = goodText();
  noLastLineEnd.pop_back();
  const std::string secondMember = compressed(directory, fileOf({falling()}));
  const std::vector<std::string> files{directory.write("plain.csv", goodText()),
                                       directory.write("windows.csv", fileOf({heading(), falling(), apart()}, "\r\n")),
                                       directory.write("no_end.csv", noLastLineEnd),
                                       directory.write("blank_lines_at_the_end.csv", goodText() + "\r\n\n"),
                                       directory.write("with_a_byte_order_mark.csv", "\xEF\xBB\xBF" + goodText()),
                                       directory.write("gzip_by_content.csv", gz),
                                       directory.write("plain_by_content.gz", goodText())};
  for (const std::string& file : files) {
    const Json result = resultOf(file, "textbook");
    EXPECT_EQ(result.at("queries"), 2) << file;
    EXPECT_EQ(result.at("vf").at("contacts"), 1);
    EXPECT_EQ(result.at("ee").at("contacts"), 0);
    EXPECT_EQ(result.at("false_negatives"), 0);
    EXPECT_EQ(result.at("false_positives"), 0);
  }
  EXPECT_EQ(resultOf(directory.write("two.csv.gz", gz + secondMember), "textbook").at("queries"), 3);
}

TEST(Ccd, Usage) {
  const TemporaryDirectory directory;
  const std::string file = directory.write("queries.csv", goodText());
  expectRefusal(ccd({}), {"queries"});
  expectRefusal(ccd({file, "--method", "exakt"}), {"--method", "\"exakt\"", "\"exact\""});
  for (const char* tolerance : {"0", "-1", "2", "nan"}) {
    expectRefusal(ccd({file, "--method", "fast", "--tolerance", tolerance}), {"--tolerance", tolerance, "[1e-12, 1]"});
  }
  expectRefusal(ccd({file, "--method", "newton", "--tolerance", "-1"}), {"--tolerance", "-1", "[0, 1]"});
  expectRefusal(ccd({file, "--method", "bullet", "--tolerance", "nan"}), {"--tolerance = nan", "bullet has none"});
  expectRefusal(ccd({file, "--tolerance", "small"}), {"--tolerance", "small"});
  expectRefusal(ccd({file, "--precision", "float16"}), {"--precision", "float16"});
  expectRefusal(ccd({file, "--json", "/dev/null/result.json"}), {"--json"});
  expectRefusal(runWetcloth({"ccd", file, "--passes", "0"}), {"--passes", "0", "1 to 100"});
  EXPECT_EQ(runWetcloth({"ccd", "--help"}).status, 0);
}

TEST(Ccd, TableAndDisagreements) {
  const TemporaryDirectory directory;
  Fields wrong = falling();
  wrong[0] = "said to pass";
  wrong[3] = "0";
  const std::string file = directory.write("queries.csv", fileOf({heading(), falling(), wrong, apart()}));
  const Outcome quiet = ccd({file, "--method", "newton"});
  EXPECT_EQ(quiet.status, 0) << quiet.err;
  EXPECT_NE(quiet.out.find("misses contacts"), std::string::npos);
  EXPECT_EQ(quiet.out.find("said to pass"), std::string::npos);
  const Outcome named = ccd({file, "--method", "newton", "--disagreements"});
  EXPECT_NE(named.out.find("false alarm said to pass\n"), std::string::npos) << named.out;
  const Json result = resultOf(file, "newton", {"--disagreements"});
  EXPECT_EQ(result.at("disagreements").at("false_positives"), Json::array({"said to pass"}));
  EXPECT_EQ(result.at("disagreements").at("false_negatives"), Json::array());
}

TEST(Ccd, JsonFileHoldsWhatStandardOutputDoes) {
  const TemporaryDirectory directory;
  const std::string file = directory.write("queries.csv", goodText());
  const Outcome outcome = ccd({file, "--method", "newton", "--json", directory.path("result.json")});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.out.find("newton"), std::string::npos);
  const Json result = readJson(directory.path("result.json"));
  EXPECT_EQ(result.at("method"), "newton");
  EXPECT_EQ(result.at("tolerance"), 1e-6);
  for (const char* type : {"vf", "ee"}) {
    EXPECT_EQ(result.at(type).at("queries"), 1);
    const Json& times = result.at(type).at("ns_per_query");
    EXPECT_GT(times.at("mean").get<double>(), 0);
    EXPECT_LE(times.at("median"), times.at("p99"));
    EXPECT_LE(times.at("p99"), times.at("worst"));
  }
}

TEST(Ccd, BulletHasNoEdgeEdgeCheck) {
  const Json result = resultOf(dataFile("real"), "bullet");
  EXPECT_EQ(result.at("queries"), result.at("vf").at("queries"));
  EXPECT_EQ(result.at("not_answered"), result.at("ee").at("queries"));
  EXPECT_GT(result.at("vf").at("false_negatives"), 10);
  for (const char* key : {"false_negatives", "false_positives", "ns_per_query"}) {
    EXPECT_TRUE(result.at("ee").at(key).is_null()) << key;
  }
  EXPECT_NE(ccd({dataFile("real"), "--method", "bullet"}).out.find("none"), std::string::npos);
}

TEST(Ccd, MethodsForComparisonMissContactsAtMargins) {
  for (const char* method : {"textbook", "newton"}) {
    const Json real = resultOf(dataFile("real"), method);
    EXPECT_EQ(real.at("queries"), 3648);
    EXPECT_GE(real.at("false_negatives"), 1) << method;
    EXPECT_LE(real.at("false_negatives"), 15) << method;
    EXPECT_GE(real.at("false_positives"), 50) << method;
    const Json cloth = resultOf(dataFile("cloth"), method);
    EXPECT_EQ(cloth.at("queries"), 3259);
    EXPECT_EQ(cloth.at("false_negatives"), 0) << method;
    EXPECT_EQ(cloth.at("false_positives"), 0) << method;
  }
}

TEST_P(CcdTier, NeverMisses) {
  const auto& [collection, method] = GetParam();
  if (method == "exact" && !wetcloth::collision::ContinuousCheck::hasExact()) {
    expectRefusal(ccd({dataFile(collection), "--method", method}), {"--method", "exact", "not in this build"});
    return;
  }
  const Json result = resultOf(dataFile(collection), method);
  for (const char* type : {"vf", "ee"}) {
    EXPECT_EQ(result.at(type).at("false_negatives"), 0) << type;
    if (method == "exact") {
      EXPECT_EQ(result.at(type).at("false_positives"), 0) << type;
    }
  }
  const int together = result.at("vf").at("ns_per_query").at("queries_timed_together");
  EXPECT_EQ(together, method == "fast" ? 64 : 1);
}

INSTANTIATE_TEST_SUITE_P(Collections, CcdTier,
                         testing::Values(Expected{"real", "fast"}, Expected{"real", "conservative"},
                                         Expected{"real", "exact"}, Expected{"cloth", "fast"},
                                         Expected{"cloth", "conservative"}, Expected{"cloth", "exact"}),
                         [](const auto& tested) { return tested.param.collection + "_" + tested.param.method; });

}  // namespace
}  // namespace wetcloth_test::ccd_test
