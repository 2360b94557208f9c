// The parts that the layouts of stored files are made of. Each function serves writing and reading: `Archive`
// is Hdf5Writer with const values, or Hdf5Reader with values to fill.
#pragma once

#include "launchsafe/store/hdf5.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <type_traits>
#include <vector>

namespace launchsafe::store {

/// An enumerator and its word in files.
template <class Enumeration>
struct Named {
  Enumeration value;
  const char* name;
};

/// A number of any integral type.
template <class Archive, class Number>
void integer(Archive& archive, const std::string& name, Number& value, const Label& label) {
  std::int64_t stored = static_cast<std::int64_t>(value);
  archive.value(name, stored, label);
  if constexpr (Archive::reading) {
    value = static_cast<Number>(stored);
    if (static_cast<std::int64_t>(value) != stored) archive.fail(name + " is out of range");
  }
}

/// An enumerator by its name.
template <class Archive, class Value, class Names>
void choice(Archive& archive, const std::string& name, Value& value, const Names& names, const Label& label) {
  std::string text;
  for (const auto& each : names) {
    if (each.value == value) text = each.name;
  }
  archive.value(name, text, label);
  if constexpr (Archive::reading) {
    for (const auto& each : names) {
      if (text == each.name) {
        value = each.value;
        return;
      }
    }
    archive.fail(name + " is '" + text + "', which this program does not know");
  }
}

/// One member of every row as an array; the first column read decides how many rows there are.
template <class Archive, class Rows, class Member>
void column(Archive& archive, const std::string& name, Rows& rows, Member member, const Label& label) {
  using Row = typename std::remove_const_t<Rows>::value_type;
  using Value = std::remove_cvref_t<std::invoke_result_t<Member, Row&>>;
  using Stored = std::conditional_t<std::is_integral_v<Value>, std::int64_t, Value>;
  std::vector<Stored> values;
  if constexpr (!Archive::reading) {
    values.reserve(rows.size());
    for (const auto& row : rows) values.push_back(static_cast<Stored>(std::invoke(member, row)));
    archive.array(name, values, label);
  } else {
    archive.array(name, values, label);
    if (rows.empty()) rows.resize(values.size());
    if (rows.size() != values.size())
      return archive.fail(name + " has another length than the columns before it");
    for (std::size_t i = 0; i < rows.size(); ++i) {
      std::invoke(member, rows[i]) = static_cast<Value>(values[i]);
      if constexpr (std::is_integral_v<Value>) {
        if (static_cast<Stored>(std::invoke(member, rows[i])) != values[i])
          return archive.fail(name + " is out of range");
      }
    }
  }
}

/// An array that is as long as the times it belongs to, or empty where it was not recorded.
template <class Archive, class Values>
void history(Archive& archive, const std::string& name, Values& values, std::size_t length,
             const Label& label) {
  archive.array(name, values, label);
  if (!values.empty() && values.size() != length) archive.fail(name + " has another length than its times");
}

/// Groups "0000", "0001", ... one for each element.
template <class Archive, class Elements, class Body>
void list(Archive& archive, const std::string& name, const std::string& description, Elements& elements,
          Body body) {
  archive.group(name, description, [&] {
    if constexpr (Archive::reading) elements.resize(archive.size());
    for (std::size_t i = 0; i < elements.size() && !archive.failed(); ++i) {
      const std::string digits = std::to_string(i);
      const std::string group = std::string(digits.size() < 4 ? 4 - digits.size() : 0, '0') + digits;
      archive.group(group, description, [&] { body(elements[i]); });
    }
  });
}

/// Plane vectors as rows of three, the last zero, as visualisation programs want them.
template <class Archive, class Values>
void plane_vectors(Archive& archive, const std::string& name, Values& along, Values& across,
                   std::size_t count, const Label& label) {
  std::vector<double> rows;
  if constexpr (!Archive::reading) {
    if (along.size() != across.size()) return archive.fail(name + " has components of different lengths");
    for (std::size_t i = 0; i < along.size(); ++i) rows.insert(rows.end(), {along[i], across[i], 0.0});
    archive.table(name, rows, {count, 3}, label);
  } else {
    archive.table(name, rows, {count, 3}, label);
    for (std::size_t i = 0; i + 2 < rows.size(); i += 3) {
      along.push_back(rows[i]);
      across.push_back(rows[i + 1]);
    }
  }
}

/// Whether to lay out what older files lack: written always, read where it is.
template <class Archive>
bool is_stored(Archive& archive, const std::string& name) {
  if constexpr (Archive::reading) return archive.has(name);
  return true;
}

/// Whether to lay out what some results lack: written where there is any, read where it is.
template <class Archive, class Values>
bool is_recorded(Archive& archive, const std::string& name, const Values& values) {
  if constexpr (Archive::reading) return archive.has(name);
  return !values.empty();
}

}  // namespace launchsafe::store
