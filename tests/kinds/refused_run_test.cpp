// Runs that fail before they begin are journaled like any other, whatever they were for.
#include "launchsafe/kinds/calibration.hpp"
#include "launchsafe/kinds/critical_gap.hpp"
#include "store/temporary_folder.hpp"
#include "study/synthetic_launch.hpp"

#include <gtest/gtest.h>

namespace {

using namespace launchsafe;
using namespace launchsafe::kinds;
using namespace launchsafe::study;

class RefusedRun : public launchsafe::testing::TemporaryFolder {
 protected:
  std::unique_ptr<store::CaseStore> open_store() { return store::CaseStore::open(folder() / "results"); }
  static StudyOptions options_with(store::CaseStore& store, double memory) {
    StudyOptions options = synthetic_options();
    options.store = &store;
    options.memory_limit = memory;
    return options;
  }
  static std::vector<store::RunRecord> refused(const store::CaseStore& store) {
    std::vector<store::RunRecord> entries = store.records();
    std::erase_if(entries, [](const auto& entry) { return entry.state == store::CaseState::done; });
    return entries;
  }
};

constexpr double one_byte = 1.0, plenty = 1e15;

const std::string gap_text = critical_text + "gaps = \"0, 0.05 cm\"\n";

TEST_F(RefusedRun, OfAConfirmationIsJournaled) {
  const auto store = open_store();
  run_critical_gap(study_of(gap_text + "confirm = false\n" + synthetic_constants),
                   options_with(*store, plenty));
  ASSERT_TRUE(refused(*store).empty());
  const CriticalGapResult result = run_critical_gap(
      study_of(gap_text + "confirm = true\n" + synthetic_constants), options_with(*store, one_byte));
  ASSERT_EQ(result.details.front().confirmations.size(), 2u);
  EXPECT_FALSE(result.details.front().incomplete.empty());
  EXPECT_TRUE(std::isnan(result.details.front().bounds.at_least));
  const auto entries = refused(*store);
  ASSERT_EQ(entries.size(), 2u);
  for (const auto& entry : entries) {
    EXPECT_EQ(entry.state, store::CaseState::failed);
    EXPECT_NE(entry.label.find("coupled at"), std::string::npos) << entry.label;
    EXPECT_NE(entry.reason.find("memory"), std::string::npos) << entry.reason;
  }
}

TEST_F(RefusedRun, OfACalibrationIsJournaled) {
  const auto store = open_store();
  const StudyFile study =
      study_of("kind = \"calibration\"\nscene = \"scene_155mm.toml\"\nreferences = \"table8.toml\"\n" +
               synthetic_constants);
  const CalibrationResult result = run_calibration(study, options_with(*store, one_byte));
  EXPECT_FALSE(result.constants);
  EXPECT_EQ(result.run.outcome, RunOutcome::refused);
  EXPECT_NE(result.failure.find("memory"), std::string::npos) << result.failure;
  const auto entries = refused(*store);
  ASSERT_EQ(entries.size(), 1u);
  for (const auto& entry : entries) EXPECT_NE(entry.reason.find("memory"), std::string::npos) << entry.reason;
}

}  // namespace
