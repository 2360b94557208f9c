// The pages that ship: what they link to is there, and the README shows of the main job what the walkthrough
// of it says, which walkthrough_test.cpp holds against the program.
#include "store/temporary_folder.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <sstream>

namespace launchsafe::app {
namespace {

namespace fs = std::filesystem;

const fs::path source = LAUNCHSAFE_SOURCE_DIR;

std::string page_of(const fs::path& file) {
  std::ifstream stream(file);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// A page's lines outside of code.
std::vector<std::string> prose_of(const std::string& page) {
  std::istringstream stream(page);
  std::vector<std::string> lines;
  bool in_code = false;
  for (std::string line; std::getline(stream, line);) {
    if (line.starts_with("```"))
      in_code = !in_code;
    else if (!in_code && !line.starts_with("    "))
      lines.push_back(line);
  }
  return lines;
}

/// The anchors of a page's headings, by the rule of the forges that show it: small letters, digits, hyphens
/// for blanks, and a number behind the second of a name.
std::set<std::string> anchors_of(const std::string& page) {
  std::set<std::string> anchors;
  std::map<std::string, int> seen;
  for (const std::string& line : prose_of(page)) {
    const std::size_t begin = line.find_first_not_of('#');
    if (begin == 0 || begin == std::string::npos || line[begin] != ' ') continue;
    std::string anchor;
    for (const char letter : line.substr(begin + 1)) {
      const auto c = static_cast<unsigned char>(letter);
      if (std::isalnum(c) != 0 || c == '-' || c == '_') anchor += static_cast<char>(std::tolower(c));
      if (c == ' ') anchor += '-';
    }
    const int before = seen[anchor]++;
    anchors.insert(before == 0 ? anchor : anchor + "-" + std::to_string(before));
  }
  return anchors;
}

/// The links of a page that lead to nothing in the files here; those to other machines are left out.
std::vector<std::string> broken_links(const fs::path& file) {
  static const std::regex link(R"(\]\(([^)\s]+)\))");
  std::vector<std::string> broken;
  for (const std::string& line : prose_of(page_of(file))) {
    for (std::sregex_iterator each(line.begin(), line.end(), link), end; each != end; ++each) {
      const std::string to = (*each)[1];
      if (to.find("://") != std::string::npos) continue;
      const std::size_t hash = to.find('#');
      const fs::path target = hash == 0 ? file : file.parent_path() / to.substr(0, hash);
      if (!fs::exists(target) ||
          (hash != std::string::npos && !anchors_of(page_of(target)).contains(to.substr(hash + 1))))
        broken.push_back(to);
    }
  }
  return broken;
}

/// Every page below a folder that is written by hand: all but the folders of reports, which come from the
/// program.
std::vector<fs::path> pages_by_hand(const fs::path& root) {
  std::vector<fs::path> pages = {root / "reports" / "README.md"};
  for (const auto& top : fs::directory_iterator(root))
    if (top.path().extension() == ".md") pages.push_back(top.path());
  for (const char* folder : {"include", "src", "studies", "tests"}) {
    if (!fs::exists(root / folder)) continue;
    for (const auto& each : fs::recursive_directory_iterator(root / folder))
      if (each.path().extension() == ".md") pages.push_back(each.path());
  }
  return pages;
}

void expect_no_broken_links(const fs::path& root) {
  const std::vector<fs::path> pages = pages_by_hand(root);
  EXPECT_GT(pages.size(), 10U);
  for (const fs::path& page : pages)
    for (const std::string& link : broken_links(page)) ADD_FAILURE() << page << " links to " << link;
}

TEST(Documents, EveryLinkLeadsSomewhere) { expect_no_broken_links(source); }

using PagesInAFolder = launchsafe::testing::TemporaryFolder;

TEST_F(PagesInAFolder, AreLinkedAfterAnInstallationToo) {
  const std::string install = std::string("'") + LAUNCHSAFE_CMAKE + "' --install '" + LAUNCHSAFE_BUILD_DIR +
                              "' --component program --prefix '" + folder().string() + "' > /dev/null";
  ASSERT_EQ(std::system(install.c_str()), 0) << install;
  expect_no_broken_links(folder() / LAUNCHSAFE_DATA_DIR);
}

/// What stands between two texts.
std::string between(const std::string& page, const std::string& begin, const std::string& end) {
  const std::size_t first = page.find(begin);
  const std::size_t last = page.find(end, first);
  if (first == std::string::npos || last == std::string::npos) return {};
  return page.substr(first + begin.size(), last - first - begin.size());
}

std::set<std::string> lines_of_main_job() {
  std::istringstream page(page_of(source / "studies" / "walkthroughs" / "main_job.md"));
  std::set<std::string> lines;
  for (std::string line; std::getline(page, line);) lines.insert(line);
  return lines;
}

TEST(Documents, TheReadmeShowsLinesThatTheMainJobPrints) {
  const std::set<std::string> printed = lines_of_main_job();
  std::istringstream block(between(page_of(source / "README.md"), "<!-- main-job-output: begin -->\n",
                                   "<!-- main-job-output: end -->"));
  std::size_t lines = 0;
  for (std::string line; std::getline(block, line);) {
    if (line.empty()) continue;
    ASSERT_TRUE(line.starts_with("    ")) << line;
    EXPECT_TRUE(printed.contains(line.substr(4))) << line;
    ++lines;
  }
  EXPECT_GT(lines, 3U);
}

// Every cell of a row of the README's table stands in one row of the printed one, in this order.
TEST(Documents, TheReadmesVerdictsAreThoseOfTheMainJob) {
  const std::set<std::string> printed = lines_of_main_job();
  std::istringstream table(between(page_of(source / "README.md"), "|---:|---:|---:|---:|---|\n", "\n\n") +
                           "\n");
  std::size_t rows = 0;
  for (std::string row; std::getline(table, row); ++rows) {
    static const std::regex cell(R"(\|\s*([^|]+?)\s*(?=\|))");
    std::string facts = "^\\s*";
    for (std::sregex_iterator each(row.begin(), row.end(), cell), end; each != end; ++each)
      facts += std::regex_replace((*each)[1].str(), std::regex(R"(\.)"), "\\.") + "\\s(?:.*\\s)?";
    const std::regex pattern(facts);
    EXPECT_TRUE(std::any_of(printed.begin(), printed.end(), [&](const std::string& line) {
      return std::regex_search(line, pattern);
    })) << row;
  }
  EXPECT_EQ(rows, 6U);
}

/// The rows of a CSV file by the names of its columns; no cell of these has a comma within quotes but the
/// case.
std::vector<std::map<std::string, std::string>> rows_of(const fs::path& file) {
  static const std::regex cell(R"re((?:^|,)(?:"([^"]*)"|([^,]*)))re");
  const auto cells_of = [](const std::string& line) {
    std::vector<std::string> cells;
    for (std::sregex_iterator each(line.begin(), line.end(), cell), end; each != end; ++each)
      cells.push_back((*each)[1].matched ? (*each)[1].str() : (*each)[2].str());
    return cells;
  };
  std::ifstream stream(file);
  std::string line;
  std::getline(stream, line);
  const std::vector<std::string> names = cells_of(line);
  std::vector<std::map<std::string, std::string>> rows;
  while (std::getline(stream, line)) {
    const std::vector<std::string> cells = cells_of(line);
    auto& row = rows.emplace_back();
    for (std::size_t i = 0; i < std::min(names.size(), cells.size()); ++i) row[names[i]] = cells[i];
  }
  return rows;
}

/// cm, of the case of a report that begins with this name.
double critical_gap_in(const std::string& report, const std::string& name) {
  for (auto& row : rows_of(source / "reports" / report / "critical_gaps.csv"))
    if (row["case"].starts_with(name)) return std::stod(row["critical_gap_cm"]);
  return std::numeric_limits<double>::quiet_NaN();
}

// The main job, the row of the sweep at its pressure, the firing of the envelope at its pressure and
// temperature, and what the README says of them are one critical gap.
TEST(Documents, OneCriticalGapStandsInReadmeReportSweepAndSafetyReport) {
  const std::string name = "496 MPa, 30 µm, 1 mm", readme = page_of(source / "README.md");
  const double gap = critical_gap_in("critical_gap_155mm", name);
  const auto in_digits = [](double length) { return fmt::format("{:.4f}", length); };
  EXPECT_NE(readme.find("The critical gap is " + in_digits(gap) + " cm ("), std::string::npos);
  EXPECT_NE(readme.find("| 496 MPa, 300 K, the launch of the main job | " + in_digits(gap) + " |"),
            std::string::npos);
  EXPECT_EQ(in_digits(critical_gap_in("sweep", "496 MPa, 30 µm")), in_digits(gap));
  const auto safety = nlohmann::json::parse(page_of(source / "reports" / "safety_155mm" / "report.json"));
  std::size_t firings = 0;
  for (const auto& firing : safety["answer"]["cases"]) {
    const std::string label = firing["case"];
    if (label == name + ", 300 K") EXPECT_NEAR(firing["critical_gap_cm"], gap, 1e-6);
    const std::regex row(label.substr(0, label.find(" MPa")) + " MPa, " +
                         label.substr(label.rfind(", ") + 2) + ".* \\| " +
                         in_digits(firing["critical_gap_cm"]) + " \\|");
    EXPECT_TRUE(std::regex_search(readme, row)) << label;
    ++firings;
  }
  EXPECT_EQ(firings, 6u);
}

// A dirty tree is one that nobody else can build.
TEST(Documents, NoReportIsOfADirtyTree) {
  std::size_t texts = 0;
  for (const auto& entry : fs::recursive_directory_iterator(source / "reports")) {
    if (!entry.is_regular_file() || entry.path().extension() == ".h5") continue;
    ++texts;
    EXPECT_EQ(page_of(entry.path()).find("-dirty"), std::string::npos) << entry.path();
  }
  EXPECT_GT(texts, 50u);
}

}  // namespace
}  // namespace launchsafe::app
