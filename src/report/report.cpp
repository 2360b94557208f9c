#include "launchsafe/report/report.hpp"

#include "launchsafe/report/study_text.hpp"
#include "launchsafe/study/study_cases.hpp"

namespace launchsafe::report {
namespace {

/// Of a long table on a terminal.
constexpr std::size_t most_printed_rows = 60;

/// The parts of a report that are tables, or pictures.
template <class Item>
std::vector<const Item*> items_of(const Report& report) {
  std::vector<const Item*> items;
  for (const auto& item : report.items)
    if (const auto* one = std::get_if<Item>(&item)) items.push_back(one);
  return items;
}

/// Whether a table stands on the page, or on the terminal.
bool stands_on(Shown place, const ReportTable& item) {
  return !item.table.rows.empty() && (item.shown == place || item.shown == Shown::page_and_terminal);
}

/// The first rows of a table; what was cut off is in a file, and a note says so.
Table first_rows(const ReportTable& item) {
  Table table = item.table;
  if (table.rows.size() <= item.most_rows) return table;
  table.notes.insert(table.notes.begin(), fmt::format("The first {} of {} rows; all are in {}.",
                                                      item.most_rows, table.rows.size(), item.csv));
  table.rows.resize(item.most_rows);
  return table;
}

/// Draws the pictures, until gnuplot is missing, fails or takes too long at one, which is a remark. The names
/// of those that are not there.
std::vector<std::string> draw(const Report& report, const DrawingLimits& limits, RenderedReport& rendered) {
  std::vector<std::string> missing;
  for (const Picture* picture : items_of<Picture>(report)) {
    if (missing.empty()) {
      auto svg = to_svg(picture->plot, limits);
      if (svg) {
        rendered.files.push_back({picture->file, std::move(*svg)});
        continue;
      }
      rendered.remarks.push_back("no picture: " + svg.error().message);
      ++rendered.pictures_missing;
    }
    missing.push_back(picture->file);
  }
  return missing;
}

/// Stated spreads (two standard deviations), numerics and other constants.
void add_uncertainties(const study::Study& study, nlohmann::ordered_json& head) {
  head["spreads"] = {{"peak_pressure", study.spreads.peak_pressure},
                     {"pulse_length", study.spreads.pulse_length},
                     {"initial_temperature_K", study.spreads.initial_temperature}};
  head["numerics"] = nullptr;
  if (study.numerics.is_stated())
    head["numerics"] = {{"K", study.numerics.error}, {"because", study.numerics.because}};
  head["models"] = nlohmann::ordered_json::array();
  for (const auto& model : study.models) head["models"].push_back(study::name_of_model(*model));
}

store::SqlValue sql_value(const Cell& cell) {
  if (const double* number = std::get_if<double>(&cell)) return store::to_sql(*number);
  return std::visit([](const auto& value) { return store::SqlValue(value); }, cell);
}

/// Adds the rows of a table, and its columns where the table before has others.
void add_rows(store::PlainTable& all, const Table& table) {
  std::vector<std::size_t> places;
  for (const Column& column : table.columns) {
    const auto found = std::ranges::find(all.columns, column.name);
    places.push_back(static_cast<std::size_t>(found - all.columns.begin()));
    if (found == all.columns.end()) all.columns.push_back(column.name);
  }
  for (const auto& cells : table.rows) {
    store::SqlRow& row = all.rows.emplace_back();
    row.resize(all.columns.size());
    for (std::size_t i = 0; i < places.size(); ++i) row[places[i]] = sql_value(cells[i]);
  }
  for (store::SqlRow& row : all.rows) row.resize(all.columns.size());
}

}  // namespace

std::string to_markdown(const Report& report, const std::vector<std::string>& missing) {
  const std::string launch = report.launch.empty() ? "" : report.launch + "\n\n";
  std::string page =
      fmt::format("# {}\n\n{}{}\n\n    {}\n", report.title, launch, report.answer, report.command);
  for (const auto& item : report.items) {
    const auto* statement = std::get_if<Statement>(&item);
    const auto* table = std::get_if<ReportTable>(&item);
    const auto* picture = std::get_if<Picture>(&item);
    if (statement != nullptr && !statement->markdown.empty()) page += "\n" + statement->markdown;
    if (table != nullptr && stands_on(Shown::page, *table)) page += "\n" + to_markdown(first_rows(*table));
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

std::string to_text(const Report& report, const std::filesystem::path& folder, std::size_t width) {
  std::string text = report.launch.empty() ? "" : report.launch + "\n\n";
  for (const ReportTable* item : items_of<ReportTable>(report)) {
    if (!stands_on(Shown::terminal, *item)) continue;
    Table table = item->table;
    const std::size_t rows = table.rows.size();
    table.rows.resize(std::min(rows, most_printed_rows));
    text += to_text(table, width) + "\n";
    if (rows > most_printed_rows)
      text += fmt::format("These are {} of {} rows; all are in {}\n\n", most_printed_rows, rows,
                          (folder / item->csv).string());
  }
  return text + report.answer + "\n";
}

std::string study_json(const study::StudyFile& study, const Report& report,
                       const nlohmann::ordered_json& members) {
  nlohmann::ordered_json head{{"format", "launchsafe study 1"},  {"kind", study.study.kind.name},
                              {"study", study_file_name(study)}, {"title", report.title},
                              {"answer", report.answer},         {"kinetics", kinetics_json(study.scene)}};
  head.update(members);
  if (study.study.kind.gives_verdicts) add_uncertainties(study.study, head);
  for (const Picture* picture : items_of<Picture>(report))
    head["pictures"].push_back({{"file", picture->file}, {"shows", picture->alternative}});
  // What is not UTF-8, such as an odd name of a file, is replaced.
  std::string text = head.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  text.resize(text.rfind("\n}"));  // open the object again
  std::vector<const ReportTable*> tables = items_of<ReportTable>(report);
  std::erase_if(tables, [](const ReportTable* table) { return table->member.empty(); });
  while (!tables.empty()) {
    const std::string member = tables.front()->member;
    text += fmt::format(",\n  \"{}\": [", member);
    for (const ReportTable* table : tables)
      if (table->member == member) append_json_rows(text, table->table);
    text += text.ends_with('[') ? "]" : "\n  ]";
    std::erase_if(tables, [&](const ReportTable* table) { return table->member == member; });
  }
  return text + "\n}\n";
}

std::vector<store::PlainTable> plain_tables(const Report& report) {
  std::vector<store::PlainTable> tables;
  for (const ReportTable* table : items_of<ReportTable>(report)) {
    if (table->member.empty() || table->table.columns.empty()) continue;
    auto found = std::ranges::find(tables, table->member, &store::PlainTable::name);
    if (found == tables.end()) found = tables.insert(found, {table->member, {}, {}});
    add_rows(*found, for_programs(table->table));
  }
  return tables;
}

RenderedReport render_report(const Report& report, const DrawingLimits& limits) {
  RenderedReport rendered;
  for (const ReportTable* table : items_of<ReportTable>(report))
    if (!table->csv.empty() && !table->table.rows.empty())
      rendered.files.push_back({table->csv, to_csv(table->table)});
  rendered.files.insert(rendered.files.end(), report.files.begin(), report.files.end());
  const std::vector<std::string> missing = draw(report, limits, rendered);
  rendered.remarks.insert(rendered.remarks.end(), report.remarks.begin(), report.remarks.end());
  rendered.files.push_back({"report.md", to_markdown(report, missing)});
  if (!report.json.empty()) rendered.files.push_back({"study.json", report.json});
  return rendered;
}

}  // namespace launchsafe::report
