// Verdicts and critical gaps as cells and sentences, the same in every study that judges gaps.
#pragma once

#include "launchsafe/report/number.hpp"
#include "launchsafe/report/table.hpp"
#include "launchsafe/study/gap_verdict.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace launchsafe::report {

/// From T max to the energy of the air: what is known of one gap of one case.
std::vector<Column> verdict_columns(const study::Study& study);
/// The cells under them, put behind those that a row already has. `inert`: T max without reaction, K.
void add_verdict_cells(const study::GapVerdict& row, double inert, std::vector<Cell>& cells);

/// Kind, value and bracket of a critical gap, and how it reads.
std::vector<Column> critical_gap_columns();
/// Those of its bounds, of a kind that finds them; they follow.
std::vector<Column> critical_gap_bounds_columns();
/// The cells under them, put behind those that a row already has.
void add_critical_gap_cells(const study::CriticalGap& gap, std::vector<Cell>& cells);
void add_critical_gap_bounds_cells(const study::CriticalGap& gap, std::vector<Cell>& cells);

/// What every table of verdicts must say: an uncertainty that is assumed or stated by hand, a charge off the
/// grid lines.
std::vector<std::string> mesh_notes(const study::StudyFile& study);
/// What temperatures are read over.
std::string station_note(const study::StudyFile& study);

/// What the published highest temperature of a gap was used for.
std::string used_for(const study::Reference& published);

/// The value in m, NaN for anything that is none: a bound never passes for a value.
double value_of(const study::CriticalGap& gap);
/// cm: the value between its bounds; nothing where it is none, or one of them is not known.
std::optional<Measured> measured_gap(const study::CriticalGap& gap);
/// What makes critical gaps uncertain, cause by cause, of cases by their labels.
Table gap_share_table(const std::vector<std::pair<std::string, const study::CriticalGap*>>& cases);
/// "0.0395 cm", "> 0.1 cm", "ignites without a gap", "indeterminate".
std::string reads_as(const study::CriticalGap& gap);

/// The study's cited limits beside the critical gaps of its cases, which are in their order; without rows
/// where it cites none.
Table cited_limit_table(const study::StudyFile& study,
                        const std::vector<const study::CriticalGap*>& critical);

/// On what the absolute value of a critical gap rests.
std::string friction_remark(const study::StudyFile& study);

/// What the uncertainty of a margin is made of, as a sentence.
std::string uncertainty_remark(const study::StudyFile& study);

/// Whether any limiter acted.
bool acted(const run::LimiterCounts& limiters);

}  // namespace launchsafe::report
