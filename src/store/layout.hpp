// Where everything is in a case file. Each function serves writing and reading; `at` is the path of a group,
// such as "gaps/0000/".
#pragma once

#include "launchsafe/run/case_result.hpp"
#include "launchsafe/store/case_file.hpp"
#include "launchsafe/store/hdf5.hpp"

#include <fmt/format.h>

namespace launchsafe::store {

void lay_out(Hdf5& file, run::CaseResult& result);
void lay_out(Hdf5& file, const std::string& at, run::Snapshot& snapshot);

/// An enumerator by its word; `words` are in the order of the enumeration.
template <class Value, class Words>
void choice(Hdf5& file, const std::string& name, Value& value, const Words& words) {
  std::string text;
  if (!file.reading()) text = words.at(static_cast<std::size_t>(value));
  file.data(name, text, "none");
  const auto found = std::ranges::find(words, text);
  if (found == words.end()) file.fail(name + " is '" + text + "', which this program does not know");
  value = static_cast<Value>(found - words.begin());
}

/// The members of an object that a list of run::Stored describes, each as a dataset.
template <class Object, class Members>
void members(Hdf5& file, const std::string& at, Object& object, const Members& list) {
  std::apply([&](const auto&... each) { (file.data(at + each.name, object.*each.member, each.unit), ...); },
             list);
}

/// One member of every row as a dataset; the first one read decides how many rows there are.
template <class Row, class Member>
void column(Hdf5& file, const std::string& name, std::vector<Row>& rows, Member member, const char* unit) {
  using Value = std::remove_cvref_t<std::invoke_result_t<Member, Row&>>;
  std::vector<std::conditional_t<std::is_same_v<Value, bool>, std::uint8_t, Value>> values;
  for (Row& row : rows) values.push_back(std::invoke(member, row));
  file.data(name, values, unit);
  if (!file.reading()) return;
  if (rows.empty()) rows.resize(values.size());
  if (rows.size() != values.size()) file.fail(name + " has another length than its table");
  for (std::size_t i = 0; i < rows.size(); ++i) std::invoke(member, rows[i]) = values[i];
}

/// The members of all rows that a list of run::Stored describes.
template <class Row, class Members>
void columns(Hdf5& file, const std::string& at, std::vector<Row>& rows, const Members& list) {
  std::apply([&](const auto&... each) { (column(file, at + each.name, rows, each.member, each.unit), ...); },
             list);
}

/// Calls `body` with the path of a group, "0000/", "0001/", ... below `at`, and its element.
template <class Elements, class Body>
void list(Hdf5& file, const std::string& at, Elements& elements, Body body) {
  if (file.reading()) elements.resize(file.size(at));
  for (std::size_t i = 0; i < elements.size(); ++i) body(fmt::format("{}{:04}/", at, i), elements[i]);
}

/// Calls `body` with a part that some results lack, where there is one.
template <class Part, class Body>
void optional_part(Hdf5& file, const std::string& group, std::optional<Part>& part, Body body) {
  if (file.reading() && file.has(group)) part.emplace();
  if (part) body(group + "/", *part);
}

/// The description by which ParaView finds the snapshots in a case file: an XDMF document with a time series
/// of particles as quadrilateral cells with values on cells, and another for every gap that burns.
/// `case_file` is the case file's name without its folder.
std::string xdmf_of(const run::CaseResult& result, const std::string& case_file);

}  // namespace launchsafe::store
