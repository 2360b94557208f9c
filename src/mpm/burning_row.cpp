// The row of a charge that burns, in a file of its own: beside it, in one file, compilers make the row that
// does not burn slower by a tenth.
#include "total_lagrangian_row.hpp"

namespace launchsafe::mpm {

void advance_burning_row(Body<materials::Charge>& body, Nodes& nodes, const RowStep& step,
                         ParticleTotals& totals) {
  advance_row<true>(body, nodes, step, totals);
}

}  // namespace launchsafe::mpm
