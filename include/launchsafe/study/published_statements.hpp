// Reading statements of a publication, and checking them against the histories of a run.
#pragma once

#include "launchsafe/scene/toml_reader.hpp"
#include "launchsafe/study/gap_verdict.hpp"
#include "launchsafe/study/study_faults.hpp"

#include <optional>
#include <string>
#include <vector>

namespace launchsafe::study {

/// What has to be known of one quantity.
struct StatementTraits {
  StatementQuantity quantity;
  std::string word;                           ///< as in `quantity = "spread"`
  std::optional<scene::Dimension> dimension;  ///< of its value; none for a place or a text
  std::vector<std::string> needs;             ///< keys besides value, source and, for a number, tolerance
  std::vector<std::string> may_have;
  std::string definition;  ///< how it is computed, a clause
};
const std::vector<StatementTraits>& statement_traits();
const StatementTraits& traits_of(StatementQuantity quantity);

/// The parts of the bottom in which a maximum may lie: thirds of its radius.
const std::vector<std::string>& bottom_parts();

/// Keys of a [[statement]].
const std::vector<scene::Key<PublishedStatement>>& statement_keys();

/// Reads all [[statement]] of a table, which stands in `file`, into Study::statements. The study has its
/// scene, whose points the statements name.
Fault read_statements(const toml::table& root, const std::string& file, StudyFile& study);

/// A statement against what was computed, for one of its gaps.
struct StatementCheck {
  enum class Agreement { agrees, differs, not_computed };
  PublishedStatement statement;
  double gap = not_a_number;         ///< m; NaN where it speaks of none
  double low = not_a_number;         ///< computed, SI
  double high = not_a_number;        ///< likewise; the same for one number
  std::string place;                 ///< computed
  double difference = not_a_number;  ///< SI, by how much the computed lies beyond the published; 0 within it
  Agreement agreement = Agreement::not_computed;
  std::string reason;  ///< why it differs or was not computed, where no number says it
};

/// Every statement of a study against one of its cases, in their order. On the histories of the case's gaps;
/// other gaps are integrated on its trace. Of a case without a run nothing is computed.
std::vector<StatementCheck> check_statements(const Study& study, const CaseOutcome& outcome);

/// When the highest temperature of the stations begins and ceases to rise fast (s): where its rate, over half
/// a millisecond, first exceeds and last falls below half of its largest before an ignition. NaN where it
/// does neither.
struct FastRise {
  double begins = not_a_number, ends = not_a_number;
};
FastRise fast_rise_of(const surface::SkinHistory& skin, const trace::BottomTrace& trace);

}  // namespace launchsafe::study
