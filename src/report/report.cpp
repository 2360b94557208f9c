#include "launchsafe/report/report.hpp"

#include "launchsafe/report/study_text.hpp"
#include "launchsafe/study/study_cases.hpp"

namespace launchsafe::report {
namespace {

/// Of a long table on the page and on a terminal.
constexpr std::size_t most_rows = 200;

/// The parts of a report that are tables, or pictures.
template <class Item>
std::vector<const Item*> items_of(const Report& report) {
  std::vector<const Item*> items;
  for (const auto& item : report.items)
    if (const auto* one = std::get_if<Item>(&item)) items.push_back(one);
  return items;
}

/// The first rows of a table; what was cut off is in a file, and a note says so.
Table first_rows(const ReportTable& item) {
  Table table = item.table;
  if (table.rows.size() <= most_rows) return table;
  table.notes.insert(table.notes.begin(), fmt::format("The first {} of {} rows; all are in {}.", most_rows,
                                                      table.rows.size(), item.csv));
  table.rows.resize(most_rows);
  return table;
}

store::SqlValue sql_value(const Cell& cell) {
  if (const double* number = std::get_if<double>(&cell)) return store::to_sql(*number);
  return std::visit([](const auto& value) { return store::SqlValue(value); }, cell);
}

}  // namespace

std::vector<std::string> draw(const std::vector<const Picture*>& pictures, const DrawingLimits& limits,
                              RenderedReport& rendered) {
  std::vector<std::string> missing;
  for (const Picture* picture : pictures) {
    std::string text = picture->svg;
    if (text.empty() && missing.empty()) {
      if (auto svg = to_svg(picture->drawing, limits)) {
        text = std::move(*svg);
      } else {
        rendered.remarks.push_back("no picture: " + svg.error().message);
        ++rendered.pictures_missing;
      }
    }
    if (text.empty())
      missing.push_back(picture->file);
    else
      rendered.files.push_back({picture->file, std::move(text)});
  }
  return missing;
}

std::string to_markdown(const Report& report, const std::vector<std::string>& missing) {
  const std::string launch = report.launch.empty() ? "" : report.launch + "\n\n";
  std::string page =
      fmt::format("# {}\n\n{}{}\n\n    {}\n", report.title, launch, report.answer, report.command);
  for (const auto& item : report.items) {
    const auto* text = std::get_if<std::string>(&item);
    const auto* table = std::get_if<ReportTable>(&item);
    const auto* picture = std::get_if<Picture>(&item);
    if (text != nullptr && !text->empty()) page += "\n" + *text;
    if (table != nullptr && table->shown != Shown::file && !table->table.rows.empty())
      page += "\n" + to_markdown(first_rows(*table));
    if (picture != nullptr && std::ranges::find(missing, picture->file) == missing.end())
      page += fmt::format("\n![{}]({})\n", picture->alternative, picture->file);
  }
  for (const std::string& remark : report.remarks) page += "\n" + remark + "\n";
  if (!missing.empty())
    page +=
        "\nNot all pictures are here: gnuplot was not found, failed or took too long when this page was "
        "made.\n";
  return page;
}

std::string to_text(const Report& report, std::size_t width) {
  std::string text = report.launch.empty() ? "" : report.launch + "\n\n";
  for (const ReportTable* item : items_of<ReportTable>(report))
    if (item->shown == Shown::page_and_terminal && !item->table.rows.empty())
      text += to_text(first_rows(*item), width) + "\n";
  return text + report.answer + "\n";
}

std::string study_json(const study::StudyFile& study, const Report& report,
                       const nlohmann::ordered_json& members) {
  nlohmann::ordered_json head{{"format", "launchsafe study 1"},  {"kind", study.study.kind.name},
                              {"study", study_file_name(study)}, {"title", report.title},
                              {"answer", report.answer},         {"kinetics", kinetics_json(study.scene)}};
  head.update(members);
  for (const Picture* picture : items_of<Picture>(report))
    head["pictures"].push_back({{"file", picture->file}, {"shows", picture->alternative}});
  // What is not UTF-8, such as an odd name of a file, is replaced.
  std::string text = head.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  text.resize(text.rfind("\n}"));  // open the object again
  for (const ReportTable* table : items_of<ReportTable>(report)) {
    if (table->member.empty()) continue;
    text += fmt::format(",\n  \"{}\": [", table->member);
    append_json_rows(text, table->table);
    text += text.ends_with('[') ? "]" : "\n  ]";
  }
  return text + "\n}\n";
}

std::vector<store::PlainTable> plain_tables(const Report& report) {
  std::vector<store::PlainTable> tables;
  for (const ReportTable* item : items_of<ReportTable>(report)) {
    if (item->member.empty() || item->table.columns.empty()) continue;
    const Table table = for_programs(item->table);
    store::PlainTable& plain = tables.emplace_back(store::PlainTable{item->member, {}, {}});
    for (const Column& column : table.columns) plain.columns.push_back(column.name);
    for (const auto& cells : table.rows) plain.rows.push_back(study::of_each(cells, sql_value));
  }
  return tables;
}

RenderedReport render_report(const Report& report, const DrawingLimits& limits) {
  RenderedReport rendered;
  for (const ReportTable* table : items_of<ReportTable>(report))
    if (!table->csv.empty() && !table->table.rows.empty())
      rendered.files.push_back({table->csv, to_csv(table->table)});
  rendered.files.insert(rendered.files.end(), report.files.begin(), report.files.end());
  const std::vector<std::string> missing = draw(items_of<Picture>(report), limits, rendered);
  rendered.remarks.insert(rendered.remarks.end(), report.remarks.begin(), report.remarks.end());
  rendered.files.push_back({"report.md", to_markdown(report, missing)});
  if (!report.json.empty()) rendered.files.push_back({"study.json", report.json});
  return rendered;
}

}  // namespace launchsafe::report
