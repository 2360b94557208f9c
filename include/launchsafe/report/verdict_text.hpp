// Verdicts and critical gaps as cells and sentences, the same in every study that judges gaps.
#pragma once

#include "launchsafe/report/number.hpp"
#include "launchsafe/report/table.hpp"
#include "launchsafe/study/verdict.hpp"

namespace launchsafe::report {

/// From T max to the energy of the air: what is known of one gap of one case.
Quantities<study::GapVerdict> verdict_quantities(const study::Study& study);

/// Kind, value and bracket of a critical gap, and how it reads.
Quantities<study::CriticalGap> critical_gap_quantities();
/// Those and the bounds of it, of a kind that finds them.
Quantities<study::CriticalGap> bounded_gap_quantities();

/// A case with its critical gap, however the study keeps it.
struct NamedGap {
  std::string label;
  const study::CriticalGap* gap;
};

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
/// "0.039 ± 0.010 cm", or six digits of the value where its bounds are not known.
std::string measured_text(const study::CriticalGap& gap);
/// What makes critical gaps uncertain, cause by cause.
Table gap_share_table(const std::vector<NamedGap>& cases);
/// "0.0395 cm", "> 0.1 cm", "ignites without a gap", "indeterminate".
std::string reads_as(const study::CriticalGap& gap);

std::vector<Column> cited_limit_columns();
/// The study's cited limits beside the critical gaps of its cases, which are in their order; without rows
/// where it cites none.
Table cited_limit_table(const study::StudyFile& study,
                        const std::vector<const study::CriticalGap*>& critical);

/// On what the absolute value of a critical gap rests.
std::string friction_remark(const study::StudyFile& study);

/// What the uncertainty of a margin is made of, as a sentence.
std::string uncertainty_remark(const study::StudyFile& study);

}  // namespace launchsafe::report
