#include "launchsafe/report/report.hpp"
#include "launchsafe/scene/toml_reader.hpp"

#include <kainjow/mustache.hpp>
#include <openssl/evp.h>

namespace launchsafe::report {
namespace {

using kainjow::mustache::html_escape;

std::string base64(const std::string& bytes) {
  std::string text(4 * ((bytes.size() + 2) / 3) + 1, '\0');
  const int length =
      EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                      reinterpret_cast<const unsigned char*>(bytes.data()), static_cast<int>(bytes.size()));
  text.resize(static_cast<std::size_t>(length));
  return text;
}

/// The picture with its name and what it shows, for who cannot see it.
std::string with_alternative(std::string svg, const std::string& title, const std::string& description) {
  for (const std::string name : {"title", "desc"}) {
    const std::size_t begin = svg.find("<" + name + ">"), end = svg.find("</" + name + ">");
    if (begin != std::string::npos && end != std::string::npos && begin < end)
      svg.erase(begin, end + name.size() + 3 - begin);
  }
  const std::size_t head = svg.find("<svg");
  const std::size_t end = head == std::string::npos ? head : svg.find('>', head);
  if (end == std::string::npos) return svg;
  svg.insert(end + 1, fmt::format("\n<title>{}</title>\n<desc>{}</desc>", html_escape(title),
                                  html_escape(description)));
  return svg.insert(end, " role=\"img\"");
}

/// The sections with their blocks, as programs read them and templates of pages do.
struct Sections {
  const PageFacts& all;
  const std::vector<PageText>& texts;
  const DrawingLimits& limits;
  Row sections = Row::array();
  std::vector<TextFile> figures = {};
  std::vector<std::string> remarks = {};
  std::set<std::string> studies = {};  ///< labels of those that something comes from

  void add_all() {
    for (const PageText& text : texts)
      if (text.look == "section")
        sections.push_back({{"id", text.id.substr(text.id.find('.') + 1)},
                            {"number", sections.size() + 1},
                            {"heading", words(text.id)},
                            {"blocks", Row::array()}});
      else if (text.look == "table")
        add_table(text, selected(text, all.facts));
      else if (!text.look.empty())
        for (const Row* each : selected(text, all.facts)) add(text, *each);
  }

  std::string words(const std::string& id, const Row& facts = {}) const {
    const auto found = std::ranges::find(texts, id, &PageText::id);
    return found == texts.end() ? std::string{} : fill(found->words, facts);
  }

  std::string fill(const std::string& text, const Row& facts) const {
    return filled(text, {&all.facts, &facts});
  }

  /// "A (launch)": those that something comes from, with what they tell.
  Row named_studies() const {
    Row named = Row::array();
    for (const Row& each : found_in(all.facts, "studies"))
      if (const std::string label = text_of(each, "label"); studies.contains(label))
        named.push_back(
            fmt::format("{} ({})", label, text_of(each, text_of(each, "tells").empty() ? "kind" : "tells")));
    return named;
  }

  /// A block with where it comes from, for people one text.
  void put(const PageText& text, const char* kind, const Row& facts, Row block) {
    std::vector<std::string> parts;
    for (const std::string& each : text.from) parts.push_back(fill(each, facts));
    parts.resize(3);
    if (parts[0].empty())
      parts.assign(3, "");  // of a study that is not there
    else
      studies.insert(parts[0]);
    block["kind"] = kind;
    block[kind] = true;
    const std::size_t dot = text.id.find('.');
    block["id"] = text.look == "figure"  ? text.id.substr(dot + 1)
                  : text.look == "table" ? text.id.substr(0, dot)
                                         : text.id;
    block["origin"] = {{"study", parts[0]}, {"of", parts[1]}, {"setting", parts[2]}};
    std::erase(parts, "");
    block["from"] = fmt::format("{}", fmt::join(parts, ", "));
    sections.back()["blocks"].push_back(std::move(block));
  }

  void add(const PageText& text, const Row& facts) {
    if (text.look == "figure") return add_figure(text, facts);
    std::string said = words(text.id, facts);
    // A line break would end the block of code.
    if (text.look == "code") std::ranges::replace(said, '\n', ' ');
    if (!said.empty()) put(text, text.look.c_str(), facts, {{"text", said}});
  }

  /// The class of a verdict's cell. Green is for what rests on no value that somebody had to accept.
  static std::string look_of(const Row& row) {
    const std::string verdict = text_of(row, "verdict");
    return verdict == "SAFE" && !text_of(row, "accepted").empty() ? "ACCEPTED" : verdict;
  }

  /// Of a table without columns all that its rows have. Pages leave a column out that is empty, or says the
  /// same sentence in all rows, which then stands above them.
  void add_table(const PageText& text, const std::vector<const Row*>& rows) {
    if (rows.empty()) return;
    std::vector<TextColumn> columns = text.columns;
    if (columns.empty())
      for (const auto& [key, value] : rows.front()->items())
        columns.push_back({key, fill("{{key|words}}", {{"key", key}}), "{{" + key + "|sig 5}}"});
    Row block{{"heading", words(text.id)},
              {"columns", Row::array()},
              {"rows", Row(rows.size(), {{"cells", Row::array()}})}};
    for (const TextColumn& column : columns) {
      const std::string heading = fill(column.heading, {});
      std::vector<std::string> cells;
      bool is_number = false;
      for (const Row* row : rows) {
        cells.push_back(fill(column.cell, *row));
        is_number = is_number || found_in(*row, column.key).is_number();
      }
      const bool is_one_sentence = cells.size() > 1 && cells.front().size() >= shortest_shared_sentence &&
                                   std::ranges::count(cells, cells.front()) == std::ssize(cells);
      if (is_one_sentence)
        block["heading"] = text_of(block, "heading") + ". " +
                           words("in_all_rows", {{"heading", heading}, {"text", cells.front()}});
      const bool is_empty = is_one_sentence || std::ranges::all_of(cells, &std::string::empty);
      block["columns"].push_back(
          {{"key", column.key}, {"name", heading}, {"number", is_number}, {"empty", is_empty}});
      for (std::size_t i = 0; i < rows.size(); ++i) {
        const Row& value = found_in(*rows[i], column.key);
        block["rows"][i][column.key] = value.is_null() && !cells[i].empty() ? Row(cells[i]) : value;
        if (!is_empty)
          block["rows"][i]["cells"].push_back({{"name", heading},
                                               {"text", cells[i]},
                                               {"look", column.key == "verdict" ? look_of(*rows[i])
                                                        : is_number             ? "number"
                                                                                : ""}});
      }
    }
    put(text, "table", *rows.front(), std::move(block));
  }

  /// After the first figure that gnuplot does not draw none is tried.
  void add_figure(const PageText& text, const Row& facts) {
    const std::string file = text_of(facts, "file"), caption = words(text.id, facts),
                      alternative = words("alternative." + text.id.substr(text.id.find('.') + 1), facts);
    std::string svg = text_of(facts, "svg");
    if (svg.empty() && remarks.empty()) {
      auto made = to_svg(all.drawings.at(file), limits);
      if (made)
        svg = std::move(*made);
      else
        remarks.push_back("no figure: " + made.error().message);
    }
    if (!svg.empty()) svg = with_alternative(std::move(svg), caption, alternative);
    put(text, "figure", facts,
        {{"file", svg.empty() ? Row() : Row(file)},
         {"caption", caption},
         {"alternative", alternative},
         {"missing", svg.empty() ? words("no_figure") : ""}});
    if (!svg.empty()) figures.push_back({file, std::move(svg)});
  }
};

/// What only pages need: where a list begins and ends, and the pictures themselves.
void prepare(Row& blocks, const std::vector<TextFile>& figures) {
  const auto is_item = [&](std::size_t place) {
    return place < blocks.size() && blocks[place].contains("item");
  };
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    blocks[i]["begins"] = !is_item(i - 1);  // before the first: far behind the last
    blocks[i]["ends"] = !is_item(i + 1);
    for (const TextFile& figure : figures)
      if (text_of(blocks[i], "file") == figure.name)
        blocks[i]["source"] = "data:image/svg+xml;base64," + base64(figure.text);
  }
}

}  // namespace

RenderedReport render_page(const std::vector<PageText>& texts, const PageFacts& all, const Row& head,
                           const DrawingLimits& limits) {
  Sections made{all, texts, limits};
  made.add_all();
  Row page{{"format", head["format"]},
           {"report", made.words("report")},
           {"title", head["title"]},
           {"subject", head["subject"]},
           {"made_of", made.words("made_of", {{"studies", made.named_studies()}})},
           {"answer", head["answer"]},
           {"sections", std::move(made.sections)}};
  RenderedReport report{{{"report.json", page.dump(1, ' ', false, Row::error_handler_t::replace) + "\n"}},
                        std::move(made.remarks)};
  for (Row& section : page["sections"]) prepare(section["blocks"], made.figures);
  std::string html = filled(built_in_html, {&page}, html_escape<std::string>);
  std::string markdown = filled(built_in_markdown, {&page}, markdown_escaped);
  // What a template leaves of its tags are empty lines.
  for (std::size_t at = 0; (at = markdown.find("\n\n\n", at)) != std::string::npos;) markdown.erase(at, 1);
  report.files.insert(report.files.begin(),
                      {{"report.html", std::move(html)}, {"report.md", std::move(markdown)}});
  std::ranges::move(made.figures, std::back_inserter(report.files));
  return report;
}

}  // namespace launchsafe::report
