// Mustache templates filled with JSON.
#include "launchsafe/report/template.hpp"

#include "launchsafe/report/table.hpp"

#include <kainjow/mustache.hpp>

#include <deque>
#include <sstream>

namespace launchsafe::report {
namespace {

namespace mustache = kainjow::mustache;
using Fields = mustache::data;

/// A text, a number as its shortest text, or "true"; empty for anything else.
std::string fact_text(const Row& fact) {
  if (fact.is_string()) return fact.get<std::string>();
  if (fact.is_number_float()) return exact(fact.get<double>());
  return fact.is_number() || fact == true ? fact.dump() : std::string{};
}

std::string list_text(const Row& list) {
  std::vector<std::string> texts;
  for (const Row& each : list) texts.push_back(fact_text(each));
  return fmt::format("{}", fmt::join(texts, ", "));
}

/// A fact in a form, see `filled`.
Row in_form(const Row& fact, const std::string& form, const std::string& argument) {
  const double number = fact.is_number() ? fact.get<double>() : std::nan("");
  const int digits = std::atoi(argument.c_str());
  if (form == "some") return !fact.empty();
  if (form == "is") return fact_text(fact) == argument;
  if (form == "over") return number > digits;
  if (form == "list") return list_text(fact);
  if (form == "padded") return fmt::format("{:<{}}", fact_text(fact), digits);
  if (!fact.is_number()) return fact_text(fact);
  if (form == "counted") return counted(fact.get<std::int64_t>(), argument);
  if (form == "fixed") return report::fixed(number, digits);
  if (form == "mega") return report::significant(1e-6 * number, digits);
  if (form == "duration") return report::duration(number);
  return report::significant(number, digits);
}

class Facts : public mustache::basic_context<std::string> {
 public:
  explicit Facts(std::vector<const Row*> facts) : stack_(std::move(facts)) {}
  void push(const Fields* data) override { stack_.push_back(rows_.at(data)); }
  void pop() override { stack_.pop_back(); }
  const Fields* get_partial(const std::string&) const override { return nullptr; }

  const Fields* get(const std::string& name) const override {
    const std::size_t bar = name.find('|');
    const Row& fact = find(name.substr(0, bar));
    if (bar == std::string::npos || fact.is_null()) return issue(fact);
    std::istringstream words(name.substr(bar + 1));
    std::string form, argument;
    words >> form >> argument;
    return issue(made_.emplace_back(in_form(fact, form, argument)));
  }

 private:
  const Row& find(const std::string& name) const {
    static const Row nothing;
    if (name == ".") return *stack_.back();
    for (auto row = stack_.rbegin(); row != stack_.rend(); ++row)
      if ((*row)->is_object() && (*row)->contains(name.substr(0, name.find('.'))))
        return found_in(**row, name);
    return nothing;
  }

  /// Keeps it for the template, which comes back with a list's items.
  const Fields* issue(const Row& fact) const {
    Fields& fields = issued_.emplace_back(Fields::type::list);
    rows_[&fields] = &fact;
    if (!fact.is_array()) {
      fields = as_section(fact);
      return &fields;
    }
    for (const Row& each : fact) fields << as_section(each);
    for (std::size_t i = 0; i < fact.size(); ++i) rows_[&fields.list_value()[i]] = &fact[i];
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
  throw store::Error{store::Error::Kind::corrupt, "a template cannot be filled: " + parsed.error_message()};
}

}  // namespace launchsafe::report
