// One page that leads to all reports of a folder.
#include "launchsafe/report/page_texts.hpp"
#include "launchsafe/store/atomic_file.hpp"

#include <kainjow/mustache.hpp>

#include <sstream>

namespace launchsafe::report {
namespace {

using std::filesystem::path;

/// The first lines of what a study answers, or what leads the first section of a safety report.
Row findings_of(const Row& told) {
  Row findings = Row::array();
  std::istringstream lines(text_of(told, "answer"));
  for (std::string line; std::getline(lines, line);) findings.push_back(line);
  if (const Row& sections = found_in(told, "sections"); !sections.empty())
    for (const Row& block : found_in(sections.front(), "blocks"))
      if (text_of(block, "kind") == "lead") findings.push_back(text_of(block, "text"));
  constexpr std::size_t most = 4;
  if (findings.size() > most) findings.erase(findings.begin() + most, findings.end());
  return findings;
}

/// What a folder holds, as the index names it; null where that is neither a page nor a picture.
Row entry_of(const path& folder, const std::string& place) {
  Row entry{{"place", place}, {"title", ""}, {"findings", Row::array()}};
  for (const std::string& name : store::list_folder(folder))
    for (const auto& [ending, list] : {std::pair{".svg", "pictures"}, {".html", "pages"}, {".md", "pages"}})
      if (name.ends_with(ending)) entry[list].push_back({{"file", place + "/" + name}, {"name", name}});
  if (!entry.contains("pages") && !entry.contains("pictures")) return {};
  // Those of a safety report first, then the study's own.
  if (entry.contains("pages"))
    std::ranges::stable_partition(
        entry["pages"], [](const Row& page) { return text_of(page, "name").starts_with("report."); });
  for (const char* results : {"report.json", "study.json"})
    if (const auto text = store::read_file(folder / results)) {
      const Row told = Row::parse(*text, nullptr, false);
      // A safety report has the title of the study that it tells of.
      const std::string kind = text_of(told, "report");
      entry["title"] = (kind.empty() ? "" : kind + ": ") + text_of(told, "title");
      entry["findings"] = findings_of(told);
    }
  if (entry["title"] == "" && entry.contains("pages"))
    if (const auto page = store::read_file(folder / text_of(entry["pages"][0], "name"));
        page && page->starts_with("# "))
      entry["title"] = page->substr(2, page->find('\n') - 2);
  if (entry["title"] == "") entry["title"] = place;
  return entry;
}

void add_parts(const path& root, const std::string& place, Row& parts) {
  for (const std::string& name : store::list_folder(root / place)) {
    const std::string part = place + "/" + name;
    if (!std::filesystem::is_directory(root / part)) continue;
    if (Row entry = entry_of(root / part, part); !entry.is_null()) parts.push_back(std::move(entry));
    add_parts(root, part, parts);
  }
}

}  // namespace

std::string index_page(const path& folder) {
  Row entries = Row::array();
  for (const std::string& name : store::list_folder(folder)) {
    if (!std::filesystem::is_directory(folder / name)) continue;
    Row entry = entry_of(folder / name, name);
    if (entry.is_null()) continue;
    add_parts(folder, name, entry["parts"]);
    entries.push_back(std::move(entry));
  }
  if (entries.empty()) return {};
  // A board reads safety reports.
  std::ranges::stable_partition(entries, [&](const Row& entry) {
    return std::filesystem::exists(folder / text_of(entry, "place") / "report.html");
  });
  const Row facts{{"entries", std::move(entries)}};
  return index_begin + filled(index_template, {&facts}, kainjow::mustache::html_escape<std::string>);
}

}  // namespace launchsafe::report
