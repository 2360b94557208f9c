#include "launchsafe/report/report.hpp"

#include <boost/algorithm/string/finder.hpp>
#include <boost/algorithm/string/iter_find.hpp>
#include <kainjow/mustache.hpp>

#include <cstdlib>
#include <deque>
#include <sstream>

namespace launchsafe::report {
namespace {

namespace mustache = kainjow::mustache;
using Fields = mustache::data;

store::Error no_template(std::string message) { return {store::Error::Kind::corrupt, std::move(message)}; }

std::vector<std::string> split_at(const std::string& line, const char* separator) {
  std::vector<std::string> parts;
  boost::algorithm::iter_split(parts, line, boost::algorithm::first_finder(separator));
  return parts;
}

/// "item of main.accepted from {{main.label}} / accepted"
void read_place(const std::string& line, PageText& text) {
  const std::vector<std::string> parts = split_at(line, " from ");
  if (parts.size() > 1) text.from = split_at(parts[1], " / ");
  const std::vector<std::string> words = split_at(parts.front(), " of ");
  text.look = words[0];
  if (words.size() > 1) text.of = words[1];
}

/// "temperature_max_K | T max [K] | fixed 0": by default the cell is what the row has; a form, or a text.
TextColumn column_in(const std::string& line) {
  const std::vector<std::string> parts = split_at(line, " | ");
  TextColumn column{parts[0], parts.size() > 1 ? parts[1] : parts[0], "{{" + parts[0] + "}}"};
  if (parts.size() > 2)
    column.cell =
        parts[2].find("{{") != std::string::npos ? parts[2] : "{{" + parts[0] + "|" + parts[2] + "}}";
  return column;
}

/// A number as its template wants it: "fixed 1", "sig 4", "sci 1" as digits; "down 3" and "up 3" rounded to
/// the safe side by so many decimals, "uncertain" up to two digits; "percent 3" of a share; "mega 3"
/// millions; "duration" of seconds; "short" two digits, or all before the point.
std::string digits_of(double value, const std::string& form, int digits) {
  if (form == "fixed") return report::fixed(value, digits);
  if (form == "sci") return report::scientific(value, digits);
  if (form == "down") return allowed_text(value, digits);
  if (form == "up") return report::fixed(rounded_up(value, digits), digits);
  if (form == "uncertain") return uncertain_text(value);
  if (form == "percent") return report::significant(100.0 * value, digits) + " %";
  if (form == "mega") return report::significant(1e-6 * value, digits);
  if (form == "duration") return report::duration(value);
  if (form == "short") return value < 10.0 ? report::significant(value, 2) : report::fixed(value, 0);
  return report::significant(value, digits);
}

/// A text, a number as its shortest text, or "true"; empty for anything else.
std::string fact_text(const Row& fact) {
  if (fact.is_string()) return fact.get<std::string>();
  if (fact.is_number_float()) return exact(fact.get<double>());
  return fact.is_number() || fact == true ? fact.dump() : std::string{};
}

/// Facts by name, those that were pushed last first; behind bars in forms: "margin_K|down 1", where the
/// digits may be a fact too. Besides those of numbers: "over 1" is there where a number is larger (than a
/// fact too), "is 1" where a number or a word is that one, and "counted case" is "2 cases"; of a text "words"
/// has blanks between them, "first 12" is its beginning and "padded 22" is as wide as that at least; of a
/// list "list 4" are its first texts, "and" all of them, "some" is there where it has any, "any warning
/// fault" where a row has something under one of these, and "count verdict SAFE" is how many rows have that
/// there.
class Facts : public mustache::basic_context<std::string> {
 public:
  explicit Facts(std::vector<const Row*> facts) : stack_(std::move(facts)) {}
  void push(const Fields* data) override { stack_.push_back(rows_.at(data)); }
  void pop() override { stack_.pop_back(); }
  const Fields* get_partial(const std::string&) const override { return nullptr; }

  const Fields* get(const std::string& name) const override {
    const std::vector<std::string> parts = split_at(name, "|");
    const Row* fact = &find(parts.front());
    for (std::size_t i = 1; i < parts.size() && !fact->is_null(); ++i) fact = &in_form(*fact, parts[i]);
    return issue(*fact);
  }

 private:
  const Row& find(const std::string& name) const {
    static const Row nothing;
    if (name == ".") return *stack_.back();
    for (auto row = stack_.rbegin(); row != stack_.rend(); ++row)
      if ((*row)->is_object() && ((*row)->contains(name) || (*row)->contains(name.substr(0, name.find('.')))))
        return found_in(**row, name);
    return nothing;
  }

  static bool has(const Row& row, const std::string& key) { return !fact_text(found_in(row, key)).empty(); }

  const Row& in_form(const Row& fact, const std::string& words) const {
    std::istringstream stream(words);
    std::string form, digits = "0", value;
    stream >> form >> digits;
    std::getline(stream >> std::ws, value);
    const Row& stated = find(digits);
    if (stated.is_number()) digits = fact_text(stated);
    const int number = std::atoi(digits.c_str());
    Row made = fact_text(fact);
    const auto has_value = [&](const Row& row) { return fact_text(found_in(row, digits)) == value; };
    if (form == "count") {
      made = std::ranges::count_if(fact, has_value);
    } else if (form == "any") {
      made = std::ranges::any_of(fact, [&](const Row& row) { return has(row, digits) || has(row, value); });
    } else if (form == "list" || form == "and") {
      std::vector<std::string> texts;
      for (const Row& each : fact) texts.push_back(fact_text(each));
      if (number > 0 && texts.size() > static_cast<std::size_t>(number)) {
        texts.resize(static_cast<std::size_t>(number));
        texts.push_back(fmt::format("and {} more", fact.size() - texts.size()));
      }
      if (form == "and" && texts.size() > 1) {
        const std::string last = texts.back();
        texts.pop_back();
        texts.back() += " and " + last;
      }
      made = fmt::format("{}", fmt::join(texts, ", "));
    } else if (form == "words") {
      std::ranges::replace(made.get_ref<std::string&>(), '_', ' ');
    } else if (form == "first") {
      made = made.get<std::string>().substr(0, static_cast<std::size_t>(number));
    } else if (form == "padded") {
      made = fmt::format("{:<{}}", made.get<std::string>(), number);
    } else if (form == "counted") {
      made = counted(fact.get<std::int64_t>(), digits + (value.empty() ? "" : " " + value));
    } else if (form == "is") {
      made = fact_text(fact) == digits;
    } else if (form == "some") {
      made = !fact.empty();
    } else if (form == "over") {
      made = fact.is_number() && fact.get<double>() > std::atof(digits.c_str());
    } else if (fact.is_number()) {
      made = digits_of(fact.get<double>(), form, number);
    }
    return made_.emplace_back(std::move(made));
  }

  /// As templates see a fact. A text or a list without content is nothing to a section; numbers are there,
  /// also 0.
  const Fields* issue(const Row& fact) const {
    Fields& fields = issued_.emplace_back(false);
    if (fact.is_array()) {
      fields = Fields{Fields::type::list};
      for (std::size_t i = 0; i < fact.size(); ++i) fields << as_section(fact[i]);
      for (std::size_t i = 0; i < fact.size(); ++i) rows_[&fields.list_value()[i]] = &fact[i];
    } else {
      fields = as_section(fact);
    }
    rows_[&fields] = &fact;
    return &fields;
  }
  static Fields as_section(const Row& fact) {
    if (fact.is_object()) return Fields{Fields::type::object};
    const std::string text = fact_text(fact);
    return text.empty() ? Fields(false) : Fields(text);
  }

  std::vector<const Row*> stack_;
  mutable std::deque<Row> made_;
  mutable std::deque<Fields> issued_;
  mutable std::map<const Fields*, const Row*> rows_;
};

}  // namespace

std::vector<PageText> texts_in(const std::string& file, const std::string& name) {
  std::vector<PageText> texts;
  std::istringstream lines(file);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("@@") || line.empty()) continue;
    if (line.starts_with('@'))
      texts.push_back({line.substr(1)});
    else if (texts.empty())
      throw no_template(
          fmt::format("{}: found \"{}\" before the first name; allowed: texts under their "
                      "names, such as @answer.value",
                      name, line));
    else if (line.starts_with("= "))
      read_place(line.substr(2), texts.back());
    else if (line.starts_with("| "))
      texts.back().columns.push_back(column_in(line.substr(2)));
    else
      texts.back().words += (texts.back().words.empty() ? "" : " ") + line;
  }
  for (const PageText& text : texts)
    if (const mustache::mustache parsed(text.words); !parsed.is_valid())
      throw no_template(
          fmt::format("{}: the text {} is no template: {}", name, text.id, parsed.error_message()));
  return texts;
}

std::string text_of(const Row& row, const std::string& key) {
  const auto found = row.find(key);
  return found != row.end() && found->is_string() ? found->get<std::string>() : std::string{};
}

double number_of(const Row& row, const std::string& key) {
  const auto found = row.find(key);
  return found != row.end() && found->is_number() ? found->get<double>() : std::nan("");
}

const Row& found_in(const Row& facts, const std::string& name) {
  static const Row nothing;
  if (!facts.is_object()) return nothing;
  if (const auto whole = facts.find(name); whole != facts.end()) return *whole;
  const std::size_t dot = name.find('.');
  const auto found = dot == std::string::npos ? facts.end() : facts.find(name.substr(0, dot));
  return found == facts.end() ? nothing : found_in(*found, name.substr(dot + 1));
}

std::string filled(const std::string& text, std::vector<const Row*> facts,
                   std::string (*escape)(const std::string&)) {
  mustache::mustache parsed(text);
  parsed.set_custom_escape(escape ? escape : [](const std::string& each) { return each; });
  Facts context(std::move(facts));
  std::string page = parsed.render(context);
  if (parsed.is_valid()) return page;
  throw no_template("a template cannot be filled: " + parsed.error_message());
}

std::vector<const Row*> selected(const PageText& text, const Row& facts) {
  if (text.of.empty()) return {&facts};
  std::istringstream words(text.of);
  std::string name, rule, key, value;
  words >> name;
  const Row& found = found_in(facts, name);
  std::vector<const Row*> rows;
  if (found.is_array())
    for (const Row& each : found) rows.push_back(&each);
  else if (!found.empty() && found != false && found != "")
    rows.push_back(&found);
  while (words >> rule >> key) {
    const auto number = [&key](const Row* row) { return number_of(*row, key); };
    if (rule == "first") {
      rows.resize(std::min<std::size_t>(rows.size(), std::stoul(key)));
    } else if (rule == "with") {
      std::erase_if(rows, [&](const Row* row) { return fact_text(found_in(*row, key)).empty(); });
    } else if (rule == "largest" || rule == "smallest" || rule == "lowest") {
      // What is not known may be lower than all others.
      const auto is_unknown = [&](const Row* row) { return std::isnan(number(row)); };
      const bool unknown = rule == "lowest" && std::ranges::any_of(rows, is_unknown);
      std::erase_if(rows, [&](const Row* row) { return is_unknown(row) != unknown; });
      if (rows.empty() || unknown) continue;
      const auto [least, most] = std::ranges::minmax(rows, {}, number);
      const double wanted = number(rule == "largest" ? most : least);
      std::erase_if(rows, [&](const Row* row) { return number(row) != wanted; });
    } else if (words >> value) {  // where, except, begins
      const std::string wanted = filled(value, {&facts});
      std::erase_if(rows, [&](const Row* row) {
        const std::string found_text = fact_text(found_in(*row, key));
        return rule == "begins" ? !found_text.starts_with(wanted)
                                : (found_text == wanted) != (rule == "where");
      });
    }
  }
  return rows;
}

std::vector<std::string> said(const std::vector<PageText>& texts, const std::string& name, const Row& facts) {
  std::vector<std::string> all;
  for (const PageText& text : texts) {
    if (text.id != name && !text.id.starts_with(name + ".")) continue;
    for (const Row* each : selected(text, facts)) all.push_back(filled(text.words, {&facts, each}));
  }
  std::erase(all, "");
  return all;
}

}  // namespace launchsafe::report
