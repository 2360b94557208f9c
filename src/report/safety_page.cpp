// Writes a safety report: its page, its facts and its pictures.
#include "safety_page.hpp"

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

/// `files`: those that were drawn.
std::string figure_html(const Picture& picture, const std::vector<TextFile>& files) {
  const std::string caption = html_escape(picture.alternative);
  std::string image = "<p>This figure was not drawn: gnuplot was not found, failed or took too long.</p>";
  if (const auto drawn = std::ranges::find(files, picture.file, &TextFile::name); drawn != files.end())
    image = fmt::format(R"(<img src="data:image/svg+xml;base64,{}" alt="{}">)", base64(drawn->text), caption);
  return fmt::format("<figure id=\"{}\">{}<figcaption>{}</figcaption></figure>\n", picture.file, image,
                     caption);
}

}  // namespace

RenderedReport make_safety_report(const SafetyEvidence& evidence, const DrawingLimits& limits) {
  const SafetyPage page = safety_page(evidence);
  RenderedReport rendered;
  std::vector<const Picture*> all;
  for (const auto& [name, pictures] : page.figures)
    for (const Picture& picture : pictures) all.push_back(&picture);
  draw(all, limits, rendered);
  Row parts{{"tables", Row::object()}, {"figures", Row::object()}}, facts = page.facts;
  for (const auto& [name, table] : page.tables) {
    if (!table.rows.empty()) parts["tables"][name] = to_html(table, name);
    facts["tables"][name] = json_rows(table);
  }
  for (const auto& [name, pictures] : page.figures)
    for (const Picture& picture : pictures)
      parts["figures"][name] = text_of(parts["figures"], name) + figure_html(picture, rendered.files);
  rendered.files.insert(
      rendered.files.begin(),
      {{"report.html", filled(safety_report_template, {&page.facts, &parts}, html_escape<std::string>)},
       {"report.json", facts.dump(1, ' ', false, Row::error_handler_t::replace) + "\n"}});
  return rendered;
}

}  // namespace launchsafe::report
