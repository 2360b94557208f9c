// What a publication says beside what was computed, as tables.
#pragma once

#include "launchsafe/report/table.hpp"
#include "launchsafe/study/published_statements.hpp"

#include <string>
#include <vector>

namespace launchsafe::report {

/// A row a statement and gap: published, computed, and "agrees" or by how much it differs.
Table statement_table(const std::vector<study::StatementCheck>& checks);

/// A row a quantity: how many statements agree, and which differs most.
Table statement_summary(const std::vector<study::StatementCheck>& checks);

/// How the quantities that the statements name are computed, as Markdown list items.
std::string statement_definitions(const std::vector<study::StatementCheck>& checks);

}  // namespace launchsafe::report
