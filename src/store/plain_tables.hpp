// Tables of a report in a results file, for other programs.
#pragma once

#include "launchsafe/store/case_store.hpp"

namespace launchsafe::store {

/// Makes a table and fills it; none of that name may be there.
MaybeError write_table(Database& database, const PlainTable& table);

/// Drops all tables that are none of the store's own.
MaybeError drop_plain_tables(Database& database);

}  // namespace launchsafe::store
