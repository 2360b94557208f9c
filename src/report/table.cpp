#include "launchsafe/report/table.hpp"

#include "launchsafe/report/number.hpp"
#include "launchsafe/scene/quantity.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace launchsafe::report {
namespace {

std::string rounded(double value, const Form& form) {
  if (form.notation == Notation::scientific) return scientific(value, form.digits);
  if (form.notation == Notation::significant) return significant(value, form.digits);
  return fixed(value, form.digits);
}

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

std::string padded(const std::string& text, std::size_t width, const Column& column) {
  const std::string fill(width - std::min(width, display_width(text)), ' ');
  return is_text(column) ? text + fill : fill + text;
}

/// What people read: the cells as text, the headings first.
struct Grid {
  std::vector<Column> columns;
  std::vector<std::vector<std::string>> lines;
};

template <class Escape>
Grid grid_of(const Table& table, Escape escape) {
  Grid grid{{}, std::vector<std::vector<std::string>>(1)};
  const std::vector<std::size_t> places = places_for(table, Audience::people);
  for (const std::size_t place : places) {
    grid.columns.push_back(table.columns[place]);
    grid.lines.front().push_back(escape(table.columns[place].label()));
  }
  for (const auto& row : table.rows) {
    auto& line = grid.lines.emplace_back();
    for (const std::size_t place : places)
      line.push_back(escape(cell_text(row[place], table.columns[place])));
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
  std::ranges::replace_if(
      text, [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
  return text;
}

std::string text_line(const std::vector<std::string>& cells, const std::vector<std::size_t>& widths,
                      const std::vector<Column>& columns) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    line += (i > 0 ? "  " : "") + padded(cells[i], widths[i], columns[i]);
  }
  return line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
}

std::size_t width_of(const Grid& grid) {
  std::size_t sum = 0;
  for (const std::size_t width : widths_of(grid, 1)) sum += width + 2;
  return sum - std::min<std::size_t>(sum, 2);
}

std::string text_lines(const Grid& grid) {
  const auto widths = widths_of(grid, 1);
  std::string text;
  for (std::size_t i = 0; i < grid.lines.size(); ++i) {
    text += text_line(grid.lines[i], widths, grid.columns);
    if (i > 0) continue;
    std::vector<std::string> rules;
    for (const std::size_t width : widths) rules.emplace_back(width, '-');
    text += text_line(rules, widths, grid.columns);
  }
  return text;
}

/// The columns of these places.
Grid part_of(const Grid& grid, const std::vector<std::size_t>& places) {
  Grid part{{}, std::vector<std::vector<std::string>>(grid.lines.size())};
  for (const std::size_t place : places) {
    part.columns.push_back(grid.columns[place]);
    for (std::size_t i = 0; i < grid.lines.size(); ++i) part.lines[i].push_back(grid.lines[i][place]);
  }
  return part;
}

/// Below each other as many columns as fit, each time behind the first; one that does not fit even so stands
/// alone.
std::string text_parts(const Grid& grid, std::size_t width) {
  std::string text;
  for (std::size_t next = 1; next < grid.columns.size();) {
    std::vector<std::size_t> places{0, next++};
    for (; next < grid.columns.size(); ++next) {
      places.push_back(next);
      if (width_of(part_of(grid, places)) <= width) continue;
      places.pop_back();
      break;
    }
    text += (text.empty() ? "" : "\n") + text_lines(part_of(grid, places));
  }
  return text;
}

std::string markdown_line(const std::vector<std::string>& cells, const std::vector<std::size_t>& widths,
                          const std::vector<Column>& columns) {
  std::string line = "|";
  for (std::size_t i = 0; i < cells.size(); ++i) line += " " + padded(cells[i], widths[i], columns[i]) + " |";
  return line + "\n";
}

std::string markdown_rule(const std::vector<std::size_t>& widths, const std::vector<Column>& columns) {
  std::string line = "|";
  for (std::size_t i = 0; i < columns.size(); ++i) {
    line += !is_text(columns[i]) ? " " + std::string(widths[i] - 1, '-') + ": |"
                                 : " " + std::string(widths[i], '-') + " |";
  }
  return line + "\n";
}

void append_csv(std::string& csv, const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos && !text.starts_with(' ') && !text.ends_with(' ')) {
    csv += text;
    return;
  }
  csv += '"';
  for (const char character : text) {
    if (character == '"') csv += '"';
    csv += character;
  }
  csv += '"';
}

/// Written in place: tables of a hundred thousand rows go through here.
void append_csv(std::string& csv, const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) append_csv(csv, *text);
  if (const auto* number = std::get_if<double>(&cell)) csv += exact(*number);
  if (const auto* count = std::get_if<std::int64_t>(&cell)) csv += std::to_string(*count);
}

nlohmann::ordered_json json_cell(const Cell& cell) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* count = std::get_if<std::int64_t>(&cell)) return *count;
  const auto* number = std::get_if<double>(&cell);
  return number != nullptr && std::isfinite(*number) ? nlohmann::ordered_json(*number) : nullptr;
}

}  // namespace

double shown_value(double value_si, const Form& form) {
  return scene::as_written(value_si, form.dimension, form.unit);
}

Cell shown_cell(Cell cell_si, const Column& column) {
  if (auto* number = std::get_if<double>(&cell_si)) *number = shown_value(*number, column.form);
  return cell_si;
}

std::string digits_of(double value_si, const Form& form) {
  return rounded(shown_value(value_si, form), form);
}

std::string in_words(double value_si, const Form& form) {
  return digits_of(value_si, form) + (form.unit.empty() ? "" : " " + form.unit);
}

std::string cell_text(const Cell& cell, const Column& column) {
  if (const auto* text = std::get_if<std::string>(&cell)) return *text;
  if (const auto* number = std::get_if<double>(&cell)) return rounded(*number, column.form);
  if (const auto* count = std::get_if<std::int64_t>(&cell)) return std::to_string(*count);
  return {};
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
  for (const Column& column : table.columns) {
    const std::string wanted = column.key();
    std::string key = wanted;
    for (int number = 2; std::ranges::find(keys, key) != keys.end(); ++number) {
      key = wanted + "_" + std::to_string(number);
    }
    keys.push_back(key);
  }
  return keys;
}

std::string to_text(const Table& table, std::size_t width) {
  const Grid grid = grid_of(table, on_one_line);
  std::string text = table.title.empty() ? "" : table.title + "\n\n";
  const bool fits = width == 0 || grid.columns.size() < 2 || width_of(grid) <= width;
  text += fits ? text_lines(grid) : text_parts(grid, width);
  for (std::size_t i = 0; i < table.notes.size(); ++i) text += (i == 0 ? "\n" : "") + table.notes[i] + "\n";
  return text;
}

std::string to_markdown(const Table& table) {
  const Grid grid = grid_of(table, markdown_escaped);
  const auto widths = widths_of(grid, 3);
  std::string text = table.title.empty() ? "" : "**" + markdown_escaped(table.title) + "**\n\n";
  for (std::size_t i = 0; i < grid.lines.size(); ++i) {
    text += markdown_line(grid.lines[i], widths, grid.columns);
    if (i == 0) text += markdown_rule(widths, grid.columns);
  }
  for (const std::string& note : table.notes) text += "\n" + markdown_escaped(note) + "\n";
  return text;
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

nlohmann::ordered_json json_of_row(const Table& table, std::size_t row) {
  const auto keys = keys_of(table);
  auto object = nlohmann::ordered_json::object();
  for (const std::size_t i : places_for(table, Audience::programs))
    object[keys[i]] = json_cell(table.rows[row][i]);
  return object;
}

nlohmann::ordered_json json_rows(const Table& table) {
  auto rows = nlohmann::ordered_json::array();
  for (std::size_t row = 0; row < table.rows.size(); ++row) rows.push_back(json_of_row(table, row));
  return rows;
}

void append_json_rows(std::string& text, const Table& table) {
  constexpr auto replace = nlohmann::ordered_json::error_handler_t::replace;
  const auto places = places_for(table, Audience::programs);
  std::vector<std::string> keys;
  for (const std::string& key : keys_of(table))
    keys.push_back(nlohmann::ordered_json(key).dump(-1, ' ', false, replace) + ": ");
  for (const auto& row : table.rows) {
    text += text.ends_with('[') ? "\n    {" : ",\n    {";
    for (std::size_t i = 0; i < places.size(); ++i) {
      if (i > 0) text += ", ";
      text += keys[places[i]] + json_cell(row[places[i]]).dump(-1, ' ', false, replace);
    }
    text += '}';
  }
}

}  // namespace launchsafe::report
