#include "common/csv_table.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/places.hpp"

namespace dipper {
namespace {

using testing::ElementsAre;

struct Read {
  std::vector<CsvRow> rows;
  std::vector<std::string> faults;
};

Read read(std::string_view text) {
  std::vector<Finding> findings;
  Read out{parse_csv(text, "t.csv", {"x_m", "z_m"}, findings), {}};
  for (const Finding& f : findings) out.faults.push_back(to_string(f));
  return out;
}

TEST(CsvTable, MarksCommentsBlanksAndCarriageReturnsAreNoPartOfIt) {
  const Read r = read("\xEF\xBB\xBF# scan\r\n\r\n x_m , z_m\r\n1,+2\r\n  # more\r\n\t3 ,\t-4e0 ");
  EXPECT_THAT(r.faults, ElementsAre());
  ASSERT_EQ(r.rows.size(), 2U);
  EXPECT_EQ(r.rows[0].line, 4);
  EXPECT_THAT(r.rows[0].values, ElementsAre(1, 2));
  EXPECT_EQ(r.rows[1].line, 6);
  EXPECT_THAT(r.rows[1].values, ElementsAre(3, -4));
}

TEST(CsvTable, EveryFaultHasItsLineAndColumn) {
  const Read r = read("x_m,z_m\n1,2\n1,\n1;2\n1,2,3\n5,nan\n7,8\n");
  EXPECT_THAT(r.faults, ElementsAre("t.csv:3:3: z_m is \"\"; it must be a finite number",
                                    "t.csv:4:4: 1 columns; each row has 2: x_m,z_m",
                                    "t.csv:5:6: 3 columns; each row has 2: x_m,z_m; with decimal "
                                    "commas, separate the columns by semicolons",
                                    "t.csv:6:3: z_m is \"nan\"; it must be a finite number"));
  ASSERT_EQ(r.rows.size(), 2U);
  EXPECT_EQ(r.rows[1].line, 7);
}

TEST(CsvTable, SemicolonsOrTabsPartColumnsToo) {
  const Read r = read("\"x_m\" ; \"z_m\"\r\n1;\"2\"\r\n-3.5;4e1\r\n");
  EXPECT_THAT(r.faults, ElementsAre());
  ASSERT_EQ(r.rows.size(), 2U);
  EXPECT_THAT(r.rows[0].values, ElementsAre(1, 2));
  EXPECT_THAT(r.rows[1].values, ElementsAre(-3.5, 40));
  EXPECT_THAT(read("x_m\tz_m\n0,5\t2\n").rows.at(0).values, ElementsAre(0.5, 2));
}

TEST(CsvTable, DecimalCommasWhereNoCommaPartsColumns) {
  const Read r = read("x_m;z_m\n1;2\n-0,25;4,5e1\n");
  EXPECT_THAT(r.faults, ElementsAre());
  EXPECT_THAT(r.rows.at(1).values, ElementsAre(-0.25, 45));
  EXPECT_THAT(read("x_m;z_m\n0,5;2.5\n1,234.5;1\n").faults,
              ElementsAre("t.csv:2:5: z_m is \"2.5\"; it must be a finite number, with a decimal "
                          "comma as elsewhere in the file",
                          "t.csv:3:1: x_m is \"1,234.5\"; it must be a finite number, with a "
                          "decimal comma as elsewhere in the file"));
  EXPECT_EQ(read("x_m;z_m\n0.5;2,5\n").faults.size(), 1U);
}

/// The lines of tests/common/number_marks.txt that are no comment: verdict, then cells.
std::vector<std::vector<std::string>> marks() {
  std::ifstream in(test::source() / "tests/common/number_marks.txt");
  std::vector<std::vector<std::string>> out;
  for (std::string line; std::getline(in, line);) {
    if (line[0] == '#') continue;
    std::istringstream words(line);
    out.emplace_back(std::istream_iterator<std::string>(words),
                     std::istream_iterator<std::string>());
  }
  return out;
}

TEST(CsvTable, MarksOfNumbersAreReadAsImportReadsThem) {
  int tried = 0;
  for (const auto& words : marks()) {
    SCOPED_TRACE(words.at(0) + ' ' + words.at(1));
    std::string table = "x_m;z_m\n";
    for (std::size_t k = 1; k < words.size(); ++k)
      table += words[k].substr(0, words[k].find('=')) + ";1\n";
    const Read r = read(table);
    ++tried;
    if (words[0] == "none" || words[0] == "open") {
      ASSERT_EQ(r.faults.size(), 1U);
      EXPECT_EQ(r.faults[0].find("may separate thousands") != std::string::npos,
                words[0] == "open");
      continue;
    }
    EXPECT_THAT(r.faults, ElementsAre());
    ASSERT_EQ(r.rows.size(), words.size() - 1);
    for (std::size_t k = 1; k < words.size(); ++k)
      EXPECT_EQ(r.rows[k - 1].values[0], std::stod(words[k].substr(words[k].find('=') + 1)));
  }
  EXPECT_GT(tried, 15);
}

/// The bytes of a table: its text in UTF-8, or those written in hexadecimal.
std::string bytes_of(const nlohmann::json& table) {
  if (table.contains("text")) return table["text"];
  const std::string hex = table["hex"];
  std::string bytes;
  for (std::size_t i = 0; i < hex.size(); i += 2)
    bytes += static_cast<char>(std::stoi(hex.substr(i, 2), nullptr, 16));
  return bytes;
}

/// tests/analysis/logs/log_file_test.py reads the same tables.
TEST(CsvTable, TablesOfTheFieldAreReadAsImportReadsThem) {
  std::ifstream in(test::source() / "tests/common/tables.jsonl");
  int read_tables = 0, refused = 0;
  for (std::string line; std::getline(in, line);) {
    const nlohmann::json table = nlohmann::json::parse(line);
    SCOPED_TRACE(table["kind"]);
    std::vector<Finding> findings;
    const std::vector<CsvRow> rows =
        parse_csv(bytes_of(table), "t.csv", {"t_s", "h_m", "c_m", "s_deg", "d_deg"}, findings);
    if (!table.contains("rows")) {
      ASSERT_FALSE(findings.empty());
      EXPECT_THAT(to_string(findings[0]), testing::HasSubstr(table["says"].get<std::string>()));
      ++refused;
      continue;
    }
    EXPECT_THAT(findings, ElementsAre());
    std::vector<std::vector<double>> values;
    for (const CsvRow& row : rows) values.push_back(row.values);
    EXPECT_EQ(values, table["rows"].get<std::vector<std::vector<double>>>());
    ++read_tables;
  }
  EXPECT_GT(read_tables, 30);
  EXPECT_GT(refused, 10);
}

TEST(CsvTable, CommasThatMayPartThousandsAreRefusedWithTheirPlace) {
  EXPECT_THAT(read("x_m;z_m\n1;943,981\n2;944,012\n").faults,
              ElementsAre("t.csv:2:3: z_m is \"943,981\": every comma in the file has three digits "
                          "after it, and may separate thousands; write decimals with a point, and "
                          "nothing between thousands"));
  EXPECT_THAT(read("x_m,z_m\n1,\"943,981\"\n").faults.size(), 1U);
  EXPECT_THAT(read("x_m;z_m\n0,5;943,981\n").faults, ElementsAre());
}

TEST(CsvTable, OneCauseIsOneLine) {
  std::string commas = "x_m,z_m\n", stamps = "x_m,z_m\n";
  for (int i = 0; i < 114; ++i) {
    commas += "0,5,1,5\n";
    stamps += "2026-03-14T06:12:00.5Z,1\n";
  }
  EXPECT_THAT(read(commas).faults,
              ElementsAre("t.csv:2:8: 4 columns, and the same in 113 more lines; each row has 2: "
                          "x_m,z_m; with decimal commas, separate the columns by semicolons"));
  EXPECT_THAT(read(stamps).faults,
              ElementsAre("t.csv:2:1: x_m is \"2026-03-14T06:12:00.5Z\", and the same in 113 more "
                          "lines; it must be a finite number; dipper import reads time stamps"));
  EXPECT_THAT(read(std::string_view("x\0_\0m\0", 6)).faults,
              ElementsAre("t.csv: is UTF-16, or no text; save it as plain text in UTF-8"));
}

TEST(CsvTable, WhatSpreadsheetsLeaveIsNoPartOfIt) {
  for (const char* text :
       {"sep=,\nx_m,z_m,,\n1,-2,,\n,,,\n3,4,,\n,\n", "x_m|z_m\r1|\u22122\r3|4\r",
        "x_m,z_m\r\r\n1,\u20132\r\r\n3,4", "\"x_m\",\"z_m\"\n\"1,0\",\"-2\"\n\"3\",4\n",
        "x_m;\u00A0z_m\n1 m;\u00A0-2m\n3;4\n", "z_m,x_m\n-2,1\n4,3\n"}) {
    const Read r = read(text);
    EXPECT_THAT(r.faults, ElementsAre()) << text;
    ASSERT_EQ(r.rows.size(), 2U) << text;
    EXPECT_THAT(r.rows[0].values, ElementsAre(1, -2)) << text;
    EXPECT_THAT(r.rows[1].values, ElementsAre(3, 4)) << text;
  }
}

TEST(CsvTable, AnotherUnitBehindANumberIsAFault) {
  EXPECT_THAT(read("x_m,z_m\n1 mm,2\n").faults,
              ElementsAre("t.csv:2:1: x_m is \"1 mm\"; it must be a finite number"));
}

TEST(CsvTable, AfterAWrongHeaderNothingIsRead) {
  EXPECT_THAT(read("x_m z_m\n1 2\n").faults,
              ElementsAre("t.csv:1:1: header is \"x_m z_m\"; it must be \"x_m,z_m\""));
  EXPECT_THAT(read("x_m,z_m,y_m\n").faults,
              ElementsAre("t.csv:1:1: header is \"x_m,z_m,y_m\"; it must be \"x_m,z_m\""));
  EXPECT_THAT(read("# nothing\n").faults,
              ElementsAre("t.csv:2:1: no header; it must be \"x_m,z_m\""));
  std::vector<Finding> findings;
  EXPECT_TRUE(read_csv("/no/such.csv", {"x_m"}, findings).empty());
  ASSERT_EQ(findings.size(), 1U);
  EXPECT_EQ(to_string(findings[0]), "/no/such.csv: cannot be opened");
}

}  // namespace
}  // namespace dipper
