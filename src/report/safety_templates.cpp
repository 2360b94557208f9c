#include "safety_templates.hpp"

#include "launchsafe/report/safety_render.hpp"
#include "launchsafe/store/atomic_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <kainjow/mustache.hpp>

#include <sstream>
#include <string_view>
#include <utility>

namespace launchsafe::report {
namespace {

namespace mustache = kainjow::mustache;

store::Error no_template(std::string message) { return {store::Error::Kind::corrupt, std::move(message)}; }

/// Names begin with "@" in the first column, remarks with "@@"; lines of a text are joined by blanks.
store::Result<std::map<std::string, std::string>> texts_in(const std::string& file, const std::string& name) {
  std::map<std::string, std::string> texts;
  std::string* text = nullptr;
  std::istringstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.starts_with("@@") || line.empty()) continue;
    if (line.starts_with('@')) {
      text = &texts[line.substr(1)];
      text->clear();
    } else if (text == nullptr) {
      return no_template(
          fmt::format("{}: found \"{}\" before the first name; allowed: texts under their names, "
                      "such as @answer.value",
                      name, line));
    } else {
      *text += (text->empty() ? "" : " ") + line;
    }
  }
  for (const auto& [id, each] : texts) {
    const mustache::mustache parsed(each);
    if (!parsed.is_valid())
      return no_template(fmt::format("{}: the text {} is no template: {}", name, id, parsed.error_message()));
  }
  return texts;
}

store::Result<std::string> page_in(const std::string& file, const std::string& name) {
  const mustache::mustache parsed(file);
  if (parsed.is_valid()) return file;
  return no_template(fmt::format("{}: this is no template: {}", name, parsed.error_message()));
}

}  // namespace

SafetyTemplates built_in_templates() {
  return {safety::built_in_html, safety::built_in_markdown, *texts_in(safety::built_in_texts, "texts")};
}

store::Result<SafetyTemplates> read_templates(const std::filesystem::path& folder) {
  SafetyTemplates templates = built_in_templates();
  std::size_t found = 0;
  for (const char* name : template_names) {
    const std::filesystem::path path = folder / name;
    auto text = store::read_file(path);
    if (!text) {
      if (text.error().kind == store::Error::Kind::missing) continue;
      return text.error();
    }
    ++found;
    if (std::string_view(name) == "texts.mustache") {
      auto texts = texts_in(*text, path.string());
      if (!texts) return texts.error();
      for (auto& [id, each] : *texts) templates.texts[id] = std::move(each);
      continue;
    }
    auto page = page_in(*text, path.string());
    if (!page) return page.error();
    (std::string_view(name) == "report.html.mustache" ? templates.html : templates.markdown) =
        std::move(*page);
  }
  if (found > 0) return templates;
  return store::Error{store::Error::Kind::missing,
                      fmt::format("{}: found no template there; allowed: a folder with at least one of {}",
                                  folder.string(), fmt::join(template_names, ", "))};
}

}  // namespace launchsafe::report
