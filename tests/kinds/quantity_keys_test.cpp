// The keys of the tables of all kinds: one for a quantity, with its unit.
#include "kinds/made_studies.hpp"
#include "launchsafe/kinds/accuracy.hpp"
#include "launchsafe/kinds/calibration.hpp"
#include "launchsafe/kinds/critical_gap.hpp"
#include "launchsafe/kinds/kind.hpp"
#include "launchsafe/kinds/sensitivity.hpp"
#include "launchsafe/kinds/stability.hpp"
#include "study/synthetic_launch.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace launchsafe::kinds {
namespace {

/// A stress case with a gap, so that the tables of a stability study have rows.
StabilityResult stability_with_a_launch() {
  StabilityResult result;
  result.study = bare_study(traits_of("stability"), {2e-4});
  StressCaseRow row;
  row.result.gaps.resize(1);
  row.result.gaps.front().heated = 300.0;
  result.rows = {row};
  return result;
}

std::vector<report::Report> reports_of_all_kinds() {
  const std::string gaps =
      "gaps = \"0, 0.03, 0.06 cm\"\nreference = [{ gap = \"0 cm\", maximum_temperature = "
      "\"416.1 K\", point = \"G2\" }]\n";
  const auto critical = run_critical_gap(
      study::study_of(study::critical_text + gaps + study::synthetic_constants), study::synthetic_options());
  const std::string row = "{ scene = \"scene_155mm.toml\", gap = ";
  const study::StudyFile calibration = study::study_of(
      "kind = \"calibration\"\nscene = \"scene_155mm.toml\"\nfit = \"friction.localisation, "
      "gap.exchange_time\"\nreference = [" +
      row + "\"0 cm\", maximum_temperature = \"416.1 K\" }, " + row +
      "\"0.02 cm\", maximum_temperature = \"467.7 K\" }, " + row +
      "\"0.04 cm\", ignition_time = \"17.7 ms\" }]\n");
  const auto accuracy = run_accuracy(
      study::study_of("kind = \"accuracy\"\nscene = \"scene_155mm.toml\"\ngaps = \"0, 0.02 cm\"\n"
                      "reference_cell_sizes = \"0.625, 1.25, 2.5 mm\"\n" +
                      study::constants_on_even_lattice),
      study::synthetic_options(2));
  return {report_of(made_sweep()), report_of(made_sensitivity()),
          report_of(critical),     report_of(run_calibration(calibration, study::synthetic_options())),
          report_of(accuracy),     report_of(stability_with_a_launch())};
}

std::vector<report::Table> tables_of_all_kinds() {
  std::vector<report::Table> tables;
  for (const report::Report& report : reports_of_all_kinds()) {
    for (const auto& item : report.items) {
      if (const auto* table = std::get_if<report::ReportTable>(&item)) tables.push_back(table->table);
    }
  }
  return tables;
}

TEST(QuantityKeys, EndWithTheUnitAndAreTheSameInEveryTable) {
  std::map<std::string, std::string> units;  // by key
  std::size_t columns = 0;
  for (const report::Table& table : tables_of_all_kinds()) {
    const std::vector<std::string> keys = report::keys_of(table);
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const std::string& unit = table.columns[i].form.unit;
      std::string words = keys[i];
      if (!unit.empty() && unit != "1/s") {
        const std::string suffix = "_" + keys::unit_key(unit);
        ASSERT_TRUE(words.ends_with(suffix)) << table.title << ": " << words << " in " << unit;
        words.resize(words.size() - suffix.size());
      }
      EXPECT_FALSE(words.ends_with("_2")) << table.title << " has two columns of one key: " << words;
      const auto [known, is_new] = units.try_emplace(keys[i], unit);
      EXPECT_TRUE(is_new || known->second == unit) << keys[i];
      ++columns;
    }
  }
  EXPECT_GT(columns, 150u);
  EXPECT_TRUE(units.contains("temperature_max_K"));
}

/// Those that depend on the study: an axis, or a column for every gap, mesh or instant.
bool depends_on_study(const std::string& key) {
  const bool is_axis = std::ranges::any_of(scene::scene_keys(), [&key](const auto& each) {
    std::string name = each.name;
    std::ranges::replace(name, '.', '_');
    return key.starts_with(name);
  });
  return is_axis || key.find_first_of("0123456789") != std::string::npos;
}

TEST(QuantityKeys, EveryColumnHasAMeaningAndStandsInTheReferenceOfResults) {
  std::set<std::string> listed, files;
  for (const Kind& kind : kinds())
    for (const report::ReportTable& table : kind.results()) {
      files.insert(table.csv);
      for (const report::Column& column : table.table.columns) {
        EXPECT_FALSE(column.meaning.empty())
            << kind.traits.name << ", " << table.member << ": " << column.key();
        EXPECT_TRUE(column.meaning.ends_with(".")) << column.key() << ": " << column.meaning;
        listed.insert(column.key());
      }
    }
  for (const report::Report& report : reports_of_all_kinds())
    for (const auto& item : report.items) {
      const auto* table = std::get_if<report::ReportTable>(&item);
      if (table == nullptr) continue;
      EXPECT_TRUE(table->csv.empty() || files.contains(table->csv)) << table->csv;
      for (const report::Column& column : table->table.columns) {
        const std::string key = column.key();
        EXPECT_FALSE(column.meaning.empty()) << table->table.title << ": " << key;
        if (column.audience == report::Audience::people) continue;  // in no file
        EXPECT_TRUE(table->member.empty() || listed.contains(key) || depends_on_study(key))
            << table->member << ": " << key;
      }
    }
}

}  // namespace
}  // namespace launchsafe::kinds
