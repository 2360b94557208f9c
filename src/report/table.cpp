// Tables for people and for programs.
#include "launchsafe/report/table.hpp"

#include "launchsafe/scene/quantity.hpp"

#include <boost/algorithm/string/replace.hpp>
#include <kainjow/mustache.hpp>
#include <nlohmann/json.hpp>

#include <numeric>

namespace launchsafe::report {
namespace {

/// Places of the columns that people or programs read.
std::vector<std::size_t> places_for(const Table& table, Audience audience) {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < table.columns.size(); ++i) {
    const Audience reader = table.columns[i].audience;
    if (reader == Audience::everyone || reader == audience) places.push_back(i);
  }
  return places;
}

bool is_text(const Column& column) { return column.form.notation == Notation::text; }

/// A cell as people read it.
std::string cell_text(const Cell& cell, const Column& column) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* number = std::get_if<double>(&cell)) return shown_digits(*number, column.form);
  if (const auto* count = std::get_if<std::int64_t>(&cell)) return std::to_string(*count);
  return {};
}

/// What people read: the cells as text, the headings first, without columns that are empty in all rows.
struct Grid {
  std::vector<Column> columns;
  std::vector<std::vector<std::string>> lines;
};

template <class Escape>
Grid grid_of(const Table& table, Escape escape) {
  Grid grid;
  grid.lines.resize(table.rows.size() + 1);
  for (const std::size_t place : places_for(table, Audience::people)) {
    const Column& column = table.columns[place];
    std::vector<std::string> cells;
    for (const auto& row : table.rows) cells.push_back(cell_text(row[place], column));
    if (!cells.empty() && std::ranges::all_of(cells, &std::string::empty)) continue;
    grid.columns.push_back(column);
    grid.lines.front().push_back(escape(column.label()));
    for (std::size_t i = 0; i < cells.size(); ++i) grid.lines[i + 1].push_back(escape(cells[i]));
  }
  return grid;
}

std::vector<std::size_t> widths_of(const Grid& grid, std::size_t smallest) {
  std::vector<std::size_t> widths(grid.columns.size(), smallest);
  for (const auto& line : grid.lines) {
    for (std::size_t i = 0; i < line.size(); ++i) widths[i] = std::max(widths[i], display_width(line[i]));
  }
  return widths;
}

std::string on_one_line(std::string text) {
  for (const char blank : {'\n', '\r', '\t'}) std::ranges::replace(text, blank, ' ');
  return text;
}

/// What stands around the cells of a line and at the right end of the rule under numbers, and how narrow a
/// column may be.
struct Frame {
  const char *begin, *between, *end;
  char right;
  std::size_t narrowest;
};
constexpr Frame text_frame{"", "  ", "", '-', 1}, markdown_frame{"| ", " | ", " |", ':', 3};

/// The headings, a rule, and the rows.
std::string lines_of(const Grid& grid, const Frame& frame) {
  const auto widths = widths_of(grid, frame.narrowest);
  std::string text;
  const auto add = [&](const std::vector<std::string>& cells) {
    std::string line = frame.begin;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const std::string fill(widths[i] - display_width(cells[i]), ' ');
      line += (i > 0 ? frame.between : "") + (is_text(grid.columns[i]) ? cells[i] + fill : fill + cells[i]);
    }
    line += frame.end;
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  };
  std::vector<std::string> rules;
  for (std::size_t i = 0; i < widths.size(); ++i) {
    rules.emplace_back(widths[i], '-');
    if (!is_text(grid.columns[i])) rules.back().back() = frame.right;
  }
  add(grid.lines.front());
  add(rules);
  for (std::size_t i = 1; i < grid.lines.size(); ++i) add(grid.lines[i]);
  return text;
}

/// The columns of these places.
Grid part_of(const Grid& grid, const std::vector<std::size_t>& places) {
  Grid part;
  part.lines.resize(grid.lines.size());
  for (const std::size_t place : places) {
    part.columns.push_back(grid.columns[place]);
    for (std::size_t i = 0; i < grid.lines.size(); ++i) part.lines[i].push_back(grid.lines[i][place]);
  }
  return part;
}

/// Below each other as many columns as fit, each time behind the first; a column that does not fit even so
/// stands alone with it. Width 0: all.
std::string text_parts(const Grid& grid, std::size_t width) {
  const auto widths = widths_of(grid, text_frame.narrowest);
  const std::size_t needed = std::accumulate(widths.begin(), widths.end(), 2 * widths.size());
  if (width == 0 || widths.size() < 2 || needed <= width + 2) return lines_of(grid, text_frame);
  std::string text;
  for (std::size_t next = 1; next < grid.columns.size();) {
    std::vector<std::size_t> places{0, next};
    std::size_t taken = widths[0] + 2 + widths[next];
    while (++next < grid.columns.size() && (taken += 2 + widths[next]) <= width) places.push_back(next);
    text += (text.empty() ? "" : "\n") + lines_of(part_of(grid, places), text_frame);
  }
  return text;
}

/// Written in place: tables of a hundred thousand rows go through here.
void append_csv(std::string& csv, const Cell& cell) {
  if (const auto* number = std::get_if<double>(&cell)) csv += exact(*number);
  if (const auto* count = std::get_if<std::int64_t>(&cell)) csv += std::to_string(*count);
  const auto* text = std::get_if<std::string>(&cell);
  if (text == nullptr) return;
  if (text->find_first_of(",\"\r\n") == std::string::npos && !text->starts_with(' ') && !text->ends_with(' '))
    csv += *text;
  else
    csv += '"' + boost::algorithm::replace_all_copy(*text, "\"", "\"\"") + '"';
}

nlohmann::ordered_json json_cell(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* count = std::get_if<std::int64_t>(&cell)) return *count;
  const auto* number = std::get_if<double>(&cell);
  return number != nullptr && std::isfinite(*number) ? nlohmann::ordered_json(*number) : nullptr;
}

nlohmann::ordered_json json_row(const std::vector<Cell>& cells, const std::vector<std::string>& keys,
                                const std::vector<std::size_t>& places) {
  auto row = nlohmann::ordered_json::object();
  for (const std::size_t i : places) row[keys[i]] = json_cell(cells[i]);
  return row;
}

}  // namespace

Cell shown_cell(Cell cell_si, const Column& column) {
  if (auto* number = std::get_if<double>(&cell_si)) *number = shown_value(*number, column.form);
  return cell_si;
}

double shown_value(double value_si, const Form& form) {
  return scene::as_written(value_si, form.dimension, form.unit);
}

std::string digits_of(double value_si, const Form& form) {
  return shown_digits(shown_value(value_si, form), form);
}

std::string in_words(double value_si, const Form& form) {
  return digits_of(value_si, form) + (form.unit.empty() ? "" : " " + form.unit);
}

std::string markdown_escaped(const std::string& text) {
  constexpr std::string_view markup = "\\|*_`<>[]#~";
  std::string escaped;
  for (const char character : text) {
    if (markup.find(character) != std::string_view::npos) escaped += '\\';
    if (character == '&') {
      escaped += "&amp;";
    } else if (character == '\n') {
      escaped += "<br>";
    } else if (character != '\r') {
      escaped += character;
    }
  }
  return escaped;
}

std::vector<std::string> keys_of(const Table& table) {
  std::vector<std::string> keys;
  for (const Column& column : table.columns) keys.push_back(column.key());
  return keys;
}

std::string to_text(const Table& table, std::size_t width) {
  const Grid grid = grid_of(table, on_one_line);
  std::string text = table.title.empty() ? "" : table.title + "\n\n";
  text += text_parts(grid, width);
  if (!table.notes.empty()) text += fmt::format("\n{}\n", fmt::join(table.notes, "\n"));
  return text;
}

std::string to_markdown(const Table& table) {
  const Grid grid = grid_of(table, markdown_escaped);
  std::string text = table.title.empty() ? "" : "**" + markdown_escaped(table.title) + "**\n\n";
  text += lines_of(grid, markdown_frame);
  for (const std::string& note : table.notes) text += "\n" + markdown_escaped(note) + "\n";
  return text;
}

std::string to_html(const Table& table, const std::string& id) {
  const Grid grid = grid_of(table, kainjow::mustache::html_escape<std::string>);
  std::string html = fmt::format("<table id=\"{}-table\">\n<caption>{}</caption>\n", id,
                                 kainjow::mustache::html_escape(table.title));
  for (std::size_t line = 0; line < grid.lines.size(); ++line) {
    html += line == 0 ? "<thead><tr>" : "<tr>";
    for (std::size_t i = 0; i < grid.columns.size(); ++i) {
      const std::string &cell = grid.lines[line][i], &heading = grid.lines[0][i];
      const bool is_verdict = line > 0 && grid.columns[i].name.starts_with("verdict");
      html += fmt::format("<{0} class=\"{1}\" data-heading=\"{2}\">{3}</{0}>", line == 0 ? "th" : "td",
                          is_verdict                 ? cell
                          : is_text(grid.columns[i]) ? ""
                                                     : "number",
                          heading, cell);
    }
    html += line == 0 ? "</tr></thead>\n<tbody>\n" : "</tr>\n";
  }
  return html + "</tbody>\n</table>\n";
}

std::string to_csv(const Table& table) {
  std::string csv;
  const auto keys = keys_of(table);
  const auto places = places_for(table, Audience::programs);
  const auto append_line = [&](const auto& append_place) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (i > 0) csv += ',';
      append_place(places[i]);
    }
    csv += "\r\n";
  };
  append_line([&](std::size_t place) { append_csv(csv, keys[place]); });
  for (const auto& row : table.rows) append_line([&](std::size_t place) { append_csv(csv, row[place]); });
  return csv;
}

Table for_programs(const Table& table) {
  Table part;
  const auto keys = keys_of(table);
  const auto places = places_for(table, Audience::programs);
  for (const std::size_t place : places) part.columns.push_back({.name = keys[place]});
  for (const auto& row : table.rows) {
    auto& cells = part.rows.emplace_back();
    for (const std::size_t place : places) cells.push_back(row[place]);
  }
  return part;
}

nlohmann::ordered_json json_rows(const Table& table) {
  auto rows = nlohmann::ordered_json::array();
  const auto keys = keys_of(table);
  const auto places = places_for(table, Audience::programs);
  for (const auto& row : table.rows) rows.push_back(json_row(row, keys, places));
  return rows;
}

void append_json_rows(std::string& text, const Table& table) {
  const auto keys = keys_of(table);
  const auto places = places_for(table, Audience::programs);
  for (const auto& row : table.rows)
    text +=
        (text.ends_with('[') ? "\n    " : ",\n    ") +
        json_row(row, keys, places).dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace launchsafe::report
