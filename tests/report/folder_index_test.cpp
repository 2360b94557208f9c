// The page that leads to all reports of a folder.
#include "launchsafe/report/report.hpp"
#include "launchsafe/scene/toml_reader.hpp"
#include "report_folder.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <set>

namespace launchsafe::report {
namespace {

namespace fs = std::filesystem;

const fs::path shipped_reports = LAUNCHSAFE_SOURCE_DIR "/reports";

std::string shipped_index() { return *scene::read_text_file((shipped_reports / "index.html").string()); }

/// The places that a page links to.
std::set<std::string> links_of(const std::string& page) {
  std::set<std::string> links;
  const std::regex link("(?:href|src)=\"([^\"]*)\"");
  for (std::sregex_iterator each(page.begin(), page.end(), link), end; each != end; ++each)
    links.insert((*each)[1]);
  return links;
}

TEST(FolderIndex, ShippedOneLinksEveryPageAndPictureThatShipsAndNothingElse) {
  std::set<std::string> there;
  for (const auto& each : fs::recursive_directory_iterator(shipped_reports)) {
    const std::string name = each.path().lexically_relative(shipped_reports).generic_string();
    const std::string extension = each.path().extension().string();
    const bool shown = extension == ".html" || extension == ".md" || extension == ".svg";
    if (shown && name.find('/') != std::string::npos) there.insert(name);
  }
  EXPECT_EQ(links_of(shipped_index()), there);
}

// reports/README.md leaves it out.
TEST(FolderIndex, NoReportShipsTwice) {
  for (const auto& each : fs::directory_iterator(shipped_reports))
    EXPECT_FALSE(fs::exists(each.path() / "report.html") && fs::exists(each.path() / "report.md"))
        << each.path();
}

TEST(FolderIndex, ShippedOneIsWhatTheProgramMakes) {
  EXPECT_TRUE(shipped_index() == index_page(shipped_reports)) << "launchsafe report --index reports";
}

TEST(FolderIndex, TellsTitleAndFirstLinesOfAnAnswerAndEscapesThem) {
  const Folder folder;
  fs::create_directories(folder.path / "study" / "part");
  std::ofstream(folder.path / "study" / "report.md") << "# not this\n";
  std::ofstream(folder.path / "study" / "study.json")
      << R"({"title": "gaps <b>", "answer": "one\ntwo\nthree\nfour\nfive"})";
  std::ofstream(folder.path / "study" / "part" / "summary.md") << "# of a part\n";
  fs::create_directory(folder.path / "without");
  const std::string page = index_page(folder.path);
  EXPECT_TRUE(page.starts_with(index_begin));
  for (const char* told : {"gaps &lt;b&gt;", "<p>one</p>", "<p>four</p>", "of a part"})
    EXPECT_NE(page.find(told), std::string::npos) << told;
  for (const char* left_out : {"not this", "five", "without"})
    EXPECT_EQ(page.find(left_out), std::string::npos) << left_out;
  EXPECT_EQ(links_of(page), (std::set<std::string>{"study/report.md", "study/part/summary.md"}));
}

// A safety report has the title of the study that it tells of.
TEST(FolderIndex, TellsASafetyReportFromItsStudy) {
  const Folder folder;
  for (const char* name : {"safety", "study"}) {
    fs::create_directories(folder.path / name);
    std::ofstream(folder.path / name / "report.md") << "# gaps\n";
  }
  std::ofstream(folder.path / "safety" / "report.json") << R"({"report": "Safety report", "title": "gaps"})";
  const std::string page = index_page(folder.path);
  EXPECT_NE(page.find("<h2>gaps</h2>"), std::string::npos) << page;
  EXPECT_NE(page.find("<h2>Safety report: gaps</h2>"), std::string::npos) << page;
}

TEST(FolderIndex, IsEmptyWithoutReports) {
  const Folder folder;
  EXPECT_EQ(index_page(folder.path), "");
}

}  // namespace
}  // namespace launchsafe::report
