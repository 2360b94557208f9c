#include "launchsafe/report/columns.hpp"

#include <fmt/format.h>

namespace launchsafe::report {

Table first_rows(Table table, std::size_t most, const std::string& file) {
  if (table.rows.size() <= most) return table;
  table.notes.insert(table.notes.begin(),
                     fmt::format("The first {} of {} rows; all are in {}.", most, table.rows.size(), file));
  table.rows.resize(most);
  return table;
}

}  // namespace launchsafe::report
