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

/// What a template reads. A text or a list without content is nothing to a section.
Fields field_of(const Parts& value) {
  if (value.is_object()) {
    if (value.contains("text") && value.contains("unit")) return field_of(value["text"]);
    Fields fields{Fields::type::object};
    for (const auto& [name, part] : value.items()) fields.set(name, field_of(part));
    return fields;
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

/// The words of one report.
class Words {
 public:
  explicit Words(const SafetyTemplates& templates) : texts_(templates.texts) {}

  std::string operator()(const std::string& id, const Parts& parts = {}) const {
    const auto found = texts_.find(id);
    if (found == texts_.end()) return {};
    mustache::mustache text(found->second);
    text.set_custom_escape([](const std::string& each) { return each; });
    return text.render(field_of(parts.is_null() ? Parts::object() : parts));
  }
  /// The text of that name, or the word itself.
  std::string word(const std::string& id, const std::string& otherwise) const {
    return texts_.contains(id) ? (*this)(id) : otherwise;
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

bool is_number(const Column& column) { return column.form.notation != Notation::text; }

/// A table with the headings and words of the templates.
Table worded(const SaidTable& said, const Words& words) {
  Table table = said.table;
  for (Column& column : table.columns) column.heading = words.word("column." + column.key(), column.heading);
  for (auto& row : table.rows)
    for (std::size_t i = 0; i < row.size(); ++i)
      if (auto* text = std::get_if<std::string>(&row[i]))
        *text = words.word(table.columns[i].key() + "." + *text, *text);
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

  Parts paragraph(const SaidParagraph& said) const {
    std::string text = words(said.id, said.parts);
    // A line break would end the block of code.
    if (said.look == Look::code) std::replace(text.begin(), text.end(), '\n', ' ');
    return {{"text", text}, {"origin", text_of(said.origin)}, {"lead", said.look == Look::lead}};
  }

  Parts table(const SaidTable& said) const {
    const Table table = worded(said, words);
    const auto for_people = [](const Column& column) { return column.audience != Audience::programs; };
    Parts columns = Parts::array(), rows = Parts::array();
    for (const Column& column : table.columns)
      if (for_people(column)) columns.push_back({{"name", column.label()}, {"number", is_number(column)}});
    for (std::size_t row = 0; row < table.rows.size(); ++row) {
      Parts cells = Parts::array();
      for (std::size_t i = 0; i < table.rows[row].size(); ++i) {
        const Column& column = table.columns[i];
        if (!for_people(column)) continue;
        // The look follows from the program's word, also where a template translates it.
        const auto* word = std::get_if<std::string>(&said.table.rows[row][i]);
        const bool is_verdict = column.key() == "verdict" && word != nullptr;
        cells.push_back({{"name", column.label()},
                         {"text", cell_text(table.rows[row][i], column)},
                         {"look", is_verdict          ? *word
                                  : is_number(column) ? "number"
                                                      : ""}});
      }
      rows.push_back({{"cells", cells}});
    }
    return {{"id", said.id},
            {"heading", words.word("table." + said.id, said.id)},
            {"origin", text_of(said.origin)},
            {"columns", columns},
            {"rows", rows},
            {"markdown", to_markdown(Table{"", table.columns, table.rows})}};
  }

  Parts figure(const SaidFigure& said) const {
    const WordedFigure& worded = figures.at(&said);
    return {{"file", said.file},
            {"caption", worded.caption},
            {"alternative", worded.alternative},
            {"origin", text_of(said.origin)},
            {"drawn", !worded.svg.empty()},
            {"missing", worded.svg.empty() ? words("no_figure") : ""},
            {"source", "data:image/svg+xml;base64," + base64(worded.svg)}};
  }

  Parts blocks(const SafetySection& section) const {
    Parts list = Parts::array();
    for (const Block& block : section.blocks) {
      if (const auto* said = std::get_if<SaidTable>(&block)) {
        list.push_back({{"table", table(*said)}});
      } else if (const auto* picture = std::get_if<SaidFigure>(&block)) {
        list.push_back({{"figure", figure(*picture)}});
      } else if (const auto& text = std::get<SaidParagraph>(block); text.look != Look::item) {
        list.push_back({{text.look == Look::code ? "code" : "paragraph", paragraph(text)}});
      } else {  // items that follow each other are one list
        if (list.empty() || !list.back().contains("list"))
          list.push_back({{"list", {{"items", Parts::array()}}}});
        list.back()["list"]["items"].push_back(paragraph(text));
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

  Parts page() const {
    Parts sections = Parts::array();
    for (const SafetySection& section : document.sections)
      sections.push_back({{"id", section.id},
                          {"number", sections.size() + 1},
                          {"heading", words("section." + section.id)},
                          {"blocks", blocks(section)}});
    return {{"language", words("language")}, {"report", words("report")}, {"title", document.title},
            {"subject", document.subject},   {"made_of", made_of()},      {"sections", sections}};
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

std::vector<const SaidFigure*> figures_in(const SafetyDocument& document) {
  std::vector<const SaidFigure*> figures;
  for (const SafetySection& section : document.sections)
    for (const Block& block : section.blocks)
      if (const auto* figure = std::get_if<SaidFigure>(&block)) figures.push_back(figure);
  return figures;
}

/// Draws all figures; after the first that gnuplot does not draw none is tried.
std::vector<std::string> draw(Renderer& renderer, const DrawingLimits& limits) {
  std::vector<std::string> remarks;
  for (const SaidFigure* figure : figures_in(renderer.document)) {
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
  const Fields page = field_of(renderer.page());
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
  for (const SaidFigure* figure : figures_in(document))
    if (const std::string& svg = renderer.figures.at(figure).svg; !svg.empty())
      report.files.push_back({figure->file, svg});
  return report;
}

}  // namespace launchsafe::report
