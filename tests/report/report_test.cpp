// A report made by hand: its page, its text for a terminal, and its files.
#include "launchsafe/report/report.hpp"

#include "facts_in_text.hpp"
#include "launchsafe/report/study_text.hpp"
#include "report_folder.hpp"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <fstream>

namespace {

using namespace launchsafe::report;

Table table_of(std::size_t rows, const std::string& title) {
  Table table;
  table.title = title;
  table.columns = {{"gap", "gap", launchsafe::keys::fixed(1, centimetre)}};
  for (std::size_t i = 0; i < rows; ++i) table.rows.push_back({static_cast<double>(i)});
  return table;
}

Report made_report() {
  Report report{"A study", "The answer.", "launchsafe study study.toml -o DIR"};
  report.items = {std::string("## First\n"),
                  ReportTable{table_of(3, "Everywhere"), "everywhere.csv"},
                  std::string(),
                  ReportTable{.table = table_of(3, "On the page"), .shown = Shown::page},
                  ReportTable{table_of(3, "In a file"), "file.csv", "", Shown::file},
                  ReportTable{table_of(0, "Without rows"), "none.csv"},
                  Picture{"curve.svg", {}, "a curve"},
                  ReportTable{table_of(300, "Long"), "long.csv"}};
  report.files = {{"record.json", "{}\n"}};
  report.json = "{\"kind\": \"made\"}\n";
  return report;
}

bool says(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

TEST(Report, ThePageHasItsPartsInOrderWithOneEmptyLineBetween) {
  const std::string page = to_markdown(made_report());
  EXPECT_TRUE(
      page.starts_with("# A study\n\nThe answer.\n\n    launchsafe study study.toml -o DIR\n\n## First\n\n"));
  EXPECT_LT(page.find("Everywhere"), page.find("On the page"));
  EXPECT_FALSE(says(page, "\n\n\n"));
  EXPECT_FALSE(says(page, "In a file"));
  EXPECT_FALSE(says(page, "Without rows"));
  EXPECT_TRUE(says(page, "![a curve](curve.svg)"));
  EXPECT_TRUE(launchsafe::testing::in_order(page, {"200 of 300 rows", "long.csv"}));
}

TEST(Report, TheLaunchStandsFirst) {
  Report report = made_report();
  report.launch = "The shot leaves the barrel with 796 m/s.";
  EXPECT_TRUE(to_markdown(report).starts_with("# A study\n\n" + report.launch + "\n\nThe answer.\n"));
  EXPECT_TRUE(to_text(report).starts_with(report.launch + "\n\n"));
}

TEST(Report, AMissingPictureIsNotLinkedAndIsTold) {
  const std::string page = to_markdown(made_report(), {"curve.svg"});
  EXPECT_FALSE(says(page, "curve.svg"));
  EXPECT_TRUE(says(page, "gnuplot"));
}

TEST(Report, TheTerminalGetsTablesThenTheAnswer) {
  const std::string text = to_text(made_report());
  EXPECT_TRUE(says(text, "Everywhere"));
  EXPECT_FALSE(says(text, "On the page"));
  EXPECT_FALSE(says(text, "In a file"));
  EXPECT_TRUE(launchsafe::testing::in_order(text, {"200 of 300 rows", "long.csv"}));
  EXPECT_TRUE(text.ends_with("The answer.\n"));
}

TEST(Report, EveryFileIsThere) {
  Report report = made_report();
  std::erase_if(report.items, [](const auto& item) { return std::holds_alternative<Picture>(item); });
  const RenderedReport rendered = render_report(report);
  std::vector<std::string> names;
  for (const TextFile& file : rendered.files) names.push_back(file.name);
  EXPECT_EQ(names, (std::vector<std::string>{"everywhere.csv", "file.csv", "long.csv", "record.json",
                                             "report.md", "study.json"}));
  const std::string csv = text_in(rendered, "long.csv");
  EXPECT_EQ(std::ranges::count(csv, '\n'), 301) << "all rows, and the header";
}

}  // namespace
