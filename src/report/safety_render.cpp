#include "launchsafe/report/safety_render.hpp"

#include <fmt/format.h>
#include <kainjow/mustache.hpp>
#include <openssl/evp.h>

#include <functional>
#include <set>
#include <string_view>

namespace launchsafe::report {
namespace {

namespace mustache = kainjow::mustache;
using Fields = mustache::data;
using Escape = std::function<std::string(const std::string&)>;

// --- words ---

Fields fields_of(const Parts& parts);

Fields field_of(const Parts& value) {
  if (value.is_object()) {
    if (value.contains("text") && value.contains("unit")) return field_of(value["text"]);
    return fields_of(value);
  }
  if (value.is_array()) {
    Fields list{Fields::type::list};
    for (const Parts& each : value) list << field_of(each);
    return list;
  }
  if (value.is_boolean()) return Fields(value.get<bool>());
  if (value.is_string()) {
    const std::string text = value.get<std::string>();
    return text.empty() ? Fields(false) : Fields(text);
  }
  // A count of nothing is nothing to a section, but must be told where it stands by itself.
  return value.is_null() ? Fields(false) : Fields(value.dump());
}

Fields fields_of(const Parts& parts) {
  Fields fields{Fields::type::object};
  for (const auto& [name, value] : parts.items()) fields.set(name, field_of(value));
  return fields;
}

/// The words of one report.
class Words {
 public:
  explicit Words(const SafetyTemplates& templates) : texts_(templates.texts) {}

  bool has(const std::string& id) const { return texts_.contains(id); }
  std::string operator()(const std::string& id, const Parts& parts = {}) const {
    const auto found = texts_.find(id);
    if (found == texts_.end()) return {};
    mustache::mustache text(found->second);
    text.set_custom_escape([](const std::string& each) { return each; });
    return text.render(fields_of(parts));
  }
  /// The text of that name, or the word itself.
  std::string word(const std::string& id, const std::string& otherwise) const {
    return has(id) ? (*this)(id) : otherwise;
  }

 private:
  const std::map<std::string, std::string>& texts_;
};

std::string text_of(const Origin& origin) {
  std::string text = origin.study;
  for (const std::string& each : {origin.of, origin.setting})
    if (!each.empty()) text += (text.empty() ? "" : ", ") + each;
  return text;
}

Fields text_field(const std::string& text) { return text.empty() ? Fields(false) : Fields(text); }

/// A table with the headings and words of the templates.
Table worded(const SaidTable& said, const Words& words) {
  Table table = said.table;
  for (Column& column : table.columns) column.name = words.word("column." + column.key, column.name);
  for (auto& row : table.rows)
    for (std::size_t i = 0; i < row.size(); ++i)
      if (auto* text = std::get_if<std::string>(&row[i]))
        *text = words.word(table.columns[i].key + "." + *text, *text);
  return table;
}

// --- figures ---

std::string base64(const std::string& bytes) {
  std::string text(4 * ((bytes.size() + 2) / 3) + 1, '\0');
  const int length =
      EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                      reinterpret_cast<const unsigned char*>(bytes.data()), static_cast<int>(bytes.size()));
  text.resize(static_cast<std::size_t>(length));
  return text;
}

std::string without_element(std::string svg, const std::string& name) {
  const std::size_t begin = svg.find("<" + name + ">"), end = svg.find("</" + name + ">");
  if (begin != std::string::npos && end != std::string::npos && begin < end)
    svg.erase(begin, end + name.size() + 3 - begin);
  return svg;
}

/// The picture with its name and what it shows, for who cannot see it.
std::string with_alternative(std::string svg, const std::string& title, const std::string& description) {
  svg = without_element(without_element(std::move(svg), "title"), "desc");
  const std::size_t head = svg.find("<svg");
  const std::size_t end = head == std::string::npos ? head : svg.find('>', head);
  if (end == std::string::npos) return svg;
  svg.insert(end + 1, fmt::format("\n<title>{}</title>\n<desc>{}</desc>", mustache::html_escape(title),
                                  mustache::html_escape(description)));
  return svg.insert(end, " role=\"img\"");
}

store::Result<std::string> drawn(const SaidFigure& figure, const DrawingLimits& limits) {
  if (const auto* plot = std::get_if<Plot>(&figure.picture)) return to_svg(*plot, "gnuplot", limits);
  if (const auto* cells = std::get_if<CellPlot>(&figure.picture)) return to_svg(*cells, "gnuplot", limits);
  return std::get<std::string>(figure.picture);
}

/// A figure with its words; without a picture where it could not be drawn.
struct WordedFigure {
  std::string svg, caption, alternative;
};

// --- the pages ---

struct Renderer {
  const SafetyDocument& document;
  const Words words;
  std::map<const SaidFigure*, WordedFigure> figures = {};

  Fields paragraph(const SaidParagraph& said) const {
    Fields fields{Fields::type::object};
    std::string text = words(said.id, said.parts);
    // A line break would end the block of code.
    if (said.look == Look::code) std::replace(text.begin(), text.end(), '\n', ' ');
    fields.set("text", text);
    fields.set("origin", text_field(text_of(said.origin)));
    fields.set("lead", Fields(said.look == Look::lead));
    return fields;
  }

  Fields table(const SaidTable& said) const {
    const Table table = worded(said, words);
    Fields fields{Fields::type::object}, columns{Fields::type::list}, rows{Fields::type::list};
    const auto for_people = [](const Column& column) { return column.audience != Audience::programs; };
    for (const Column& column : table.columns) {
      if (!for_people(column)) continue;
      Fields each{Fields::type::object};
      each.set("name", heading_of(column));
      each.set("number", Fields(column.alignment == Alignment::right));
      columns << each;
    }
    for (const auto& row : table.rows) {
      Fields cells{Fields::type::list};
      for (std::size_t i = 0; i < row.size(); ++i) {
        const Column& column = table.columns[i];
        if (!for_people(column)) continue;
        const std::string text = cell_text(row[i], column);
        // The look follows from the program's word, also where a template translates it.
        const auto* word = i < said.table.rows[rows.list_value().size()].size()
                               ? std::get_if<std::string>(&said.table.rows[rows.list_value().size()][i])
                               : nullptr;
        Fields cell{Fields::type::object};
        cell.set("name", heading_of(column));
        cell.set("text", text_field(text));
        cell.set("look", text_field(column.key == "verdict" && word != nullptr ? *word
                                    : column.alignment == Alignment::right     ? "number"
                                                                               : ""));
        cells << cell;
      }
      Fields line{Fields::type::object};
      line.set("cells", cells);
      rows << line;
    }
    fields.set("id", said.id);
    fields.set("heading", words.word("table." + said.id, said.id));
    fields.set("origin", text_field(text_of(said.origin)));
    fields.set("columns", columns);
    fields.set("rows", rows);
    fields.set("markdown", to_markdown(Table{"", table.columns, table.rows}));
    return fields;
  }

  Fields figure(const SaidFigure& said) const {
    const WordedFigure& worded = figures.at(&said);
    Fields fields{Fields::type::object};
    fields.set("file", said.file);
    fields.set("caption", worded.caption);
    fields.set("alternative", worded.alternative);
    fields.set("origin", text_field(text_of(said.origin)));
    fields.set("missing", worded.svg.empty() ? Fields(words("no_figure")) : Fields(false));
    fields.set("source", "data:image/svg+xml;base64," + base64(worded.svg));
    return fields;
  }

  Fields blocks(const SafetySection& section) const {
    Fields list{Fields::type::list};
    const auto add = [&list](const char* kind, const Fields& fields) {
      Fields block{Fields::type::object};
      block.set(kind, fields);
      list << block;
    };
    for (std::size_t i = 0; i < section.blocks.size(); ++i) {
      if (const auto* said = std::get_if<SaidTable>(&section.blocks[i])) {
        add("table", table(*said));
      } else if (const auto* picture = std::get_if<SaidFigure>(&section.blocks[i])) {
        add("figure", figure(*picture));
      } else {
        const auto& text = std::get<SaidParagraph>(section.blocks[i]);
        if (text.look != Look::item) {
          add(text.look == Look::code ? "code" : "paragraph", paragraph(text));
          continue;
        }
        Fields items{Fields::type::list};
        const auto item_at = [&](std::size_t place) {
          const auto* each = std::get_if<SaidParagraph>(&section.blocks[place]);
          return each != nullptr && each->look == Look::item ? each : nullptr;
        };
        for (; i < section.blocks.size() && item_at(i) != nullptr; ++i) items << paragraph(*item_at(i));
        --i;
        Fields whole{Fields::type::object};
        whole.set("items", items);
        add("list", whole);
      }
    }
    return list;
  }

  std::string made_of() const {
    std::set<std::string> labels;
    for (const SafetySection& section : document.sections)
      for (const Block& block : section.blocks)
        std::visit([&](const auto& each) { labels.insert(each.origin.study); }, block);
    labels.erase("");
    return words("made_of", {{"studies", fmt::format("{}", fmt::join(labels, ", "))}});
  }

  Fields page() const {
    Fields page{Fields::type::object}, sections{Fields::type::list};
    int number = 0;
    for (const SafetySection& section : document.sections) {
      Fields each{Fields::type::object};
      each.set("id", section.id);
      each.set("number", std::to_string(++number));
      each.set("heading", words("section." + section.id));
      each.set("blocks", blocks(section));
      sections << each;
    }
    page.set("language", words("language"));
    page.set("report", words("report"));
    page.set("title", document.title);
    page.set("subject", document.subject);
    page.set("made_of", made_of());
    page.set("sections", sections);
    return page;
  }

  // --- JSON ---

  static Parts json_of(const Origin& origin) {
    return {{"study", origin.study}, {"of", origin.of}, {"setting", origin.setting}};
  }
  Parts json_of(const SaidParagraph& said) const {
    return {{"kind", "paragraph"},
            {"id", said.id},
            {"look", to_string(said.look)},
            {"text", words(said.id, said.parts)},
            {"parts", said.parts.is_null() ? Parts::object() : said.parts},
            {"origin", json_of(said.origin)}};
  }
  Parts json_of(const SaidTable& said) const {
    Table table = said.table;
    table.title = words.word("table." + said.id, said.id);
    Parts object{{"kind", "table"}, {"id", said.id}};
    object.update(to_json(table));
    object["origin"] = json_of(said.origin);
    return object;
  }
  Parts json_of(const SaidFigure& said) const {
    const WordedFigure& worded = figures.at(&said);
    return {{"kind", "figure"},
            {"id", said.id},
            {"file", worded.svg.empty() ? Parts() : Parts(said.file)},
            {"caption", worded.caption},
            {"alternative", worded.alternative},
            {"parts", said.parts.is_null() ? Parts::object() : said.parts},
            {"origin", json_of(said.origin)}};
  }

  Parts json() const {
    Parts sections = Parts::array();
    for (const SafetySection& section : document.sections) {
      Parts blocks = Parts::array();
      for (const Block& block : section.blocks)
        blocks.push_back(std::visit([this](const auto& each) { return json_of(each); }, block));
      sections.push_back(
          {{"id", section.id}, {"heading", words("section." + section.id)}, {"blocks", blocks}});
    }
    return {{"format", "launchsafe safety report 1"},
            {"title", document.title},
            {"subject", document.subject},
            {"answer", document.answer},
            {"sections", sections}};
  }
};

/// Draws all figures; after the first that gnuplot does not draw none is tried.
std::vector<std::string> draw(Renderer& renderer, const DrawingLimits& limits) {
  std::vector<std::string> remarks;
  for (const SafetySection& section : renderer.document.sections) {
    for (const Block& block : section.blocks) {
      const auto* figure = std::get_if<SaidFigure>(&block);
      if (figure == nullptr) continue;
      WordedFigure& worded = renderer.figures[figure];
      worded.caption = renderer.words("figure." + figure->id, figure->parts);
      worded.alternative = renderer.words("alternative." + figure->id, figure->parts);
      if (!remarks.empty() && !std::holds_alternative<std::string>(figure->picture)) continue;
      auto svg = drawn(*figure, limits);
      if (svg)
        worded.svg = with_alternative(std::move(*svg), worded.caption, worded.alternative);
      else
        remarks.push_back("no figure: " + svg.error().message);
    }
  }
  return remarks;
}

store::Result<std::string> filled(const std::string& page, const Fields& fields, const Escape& escape) {
  mustache::mustache parsed(page);
  if (escape) parsed.set_custom_escape(escape);
  std::string text = parsed.render(fields);
  if (!parsed.is_valid())
    return store::Error{store::Error::Kind::corrupt,
                        "a template cannot be filled: " + parsed.error_message()};
  return text;
}

}  // namespace

std::vector<std::string> figures_of(const std::string& report_json) {
  std::vector<std::string> files;
  const auto report = nlohmann::json::parse(report_json, nullptr, false);
  const auto list = [](const nlohmann::json& object, const char* key) {
    return object.is_object() && object.contains(key) ? object[key] : nlohmann::json::array();
  };
  for (const auto& section : list(report, "sections"))
    for (const auto& block : list(section, "blocks"))
      if (block.is_object() && block.contains("file") && block["file"].is_string())
        files.push_back(block["file"]);
  return files;
}

store::Result<RenderedReport> render(const SafetyDocument& document, const SafetyTemplates& templates,
                                     const DrawingLimits& limits) {
  Renderer renderer{document, Words(templates)};
  RenderedReport report{{}, draw(renderer, limits)};
  const Fields page = renderer.page();
  auto html = filled(templates.html, page, {});
  if (!html) return html.error();
  auto markdown = filled(templates.markdown, page, markdown_escaped);
  if (!markdown) return markdown.error();
  // What a template leaves of its tags are empty lines.
  for (std::size_t at = 0; (at = markdown->find("\n\n\n", at)) != std::string::npos;) markdown->erase(at, 1);
  report.files = {
      {"report.html", std::move(*html)},
      {"report.md", std::move(*markdown)},
      {"report.json", renderer.json().dump(1, ' ', false, Parts::error_handler_t::replace) + "\n"}};
  for (const SafetySection& section : document.sections)
    for (const Block& block : section.blocks)
      if (const auto* figure = std::get_if<SaidFigure>(&block))
        if (const WordedFigure& worded = renderer.figures.at(figure); !worded.svg.empty())
          report.files.push_back({figure->file, worded.svg});
  return report;
}

}  // namespace launchsafe::report
