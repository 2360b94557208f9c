// Tables, page and files of a calibration on firings.
#include "answer_tables.hpp"
#include "calibration_parts.hpp"
#include "launchsafe/report/case_tables.hpp"

namespace launchsafe::kinds {

using report::Column, report::Quantities, report::Row;

namespace {

const Column initial_temperature{"initial_temperature", "T before", keys::significant(4, keys::kelvin),
                                 "Temperature of charge and air before."};

Column probability(const char* name, const char* heading, const char* meaning) {
  return {name, heading, keys::significant(3, keys::percent), meaning};
}

Quantities<FiringRow> row_quantities() {
  const auto of_firing = [](Column column, auto member) {
    return report::Quantity<FiringRow>(std::move(column), &FiringRow::firing, member);
  };
  return {
      of_firing({"name", "firing", keys::text(), "What the rounds are called."}, &study::Firing::name),
      of_firing({"rounds", "rounds", keys::count(), "How many there were."}, &study::Firing::rounds),
      of_firing(quantity::peak_pressure, &study::Firing::pressure),
      of_firing(initial_temperature, &study::Firing::temperature),
      of_firing(quantity::gap, &study::Firing::gap),
      of_firing({"gap_most", "gap at most", keys::significant(6, keys::centimetre),
                 "The largest that it can have been."},
                &study::Firing::most_gap),
      of_firing({"ignited", "ignited", keys::text(), "Whether the rounds ignited."}, &study::Firing::ignited),
      {probability("shown_lowest", "more than",
                   "With 95 % the probability of a round is more, by the rounds of this kind alone."),
       &FiringRow::shown_lowest},
      {probability("shown_highest", "less than", "With 95 % it is less, by these rounds alone."),
       &FiringRow::shown_highest},
      {probability("ignition_probability", "computed",
                   "Probability that a round ignites, after all firings."),
       &FiringRow::predicted, &IgnitionProbability::mean},
      {probability("ignition_probability_lowest", "from", "With 95 % it is more than this."),
       &FiringRow::predicted, &IgnitionProbability::lowest},
      {probability("ignition_probability_highest", "to", "With 95 % it is less than this."),
       &FiringRow::predicted, &IgnitionProbability::highest}};
}

Quantities<ConstantRange> range_quantities() {
  const auto column = [](const char* name, const char* heading, const char* meaning) {
    return Column{name, heading, keys::significant(4), meaning};
  };
  return {
      {"key", "constant", keys::text(), "Key of the scene, SI; or the scatter between rounds.",
       &ConstantRange::name},
      {column("prior_lowest", "before: 5 %", "5 % of the prior lie below."), &ConstantRange::prior_lowest},
      {column("prior_centre", "mean", "Geometric mean of the prior."), &ConstantRange::prior_centre},
      {column("prior_highest", "95 %", "95 % of the prior lie below."), &ConstantRange::prior_highest},
      {column("lowest", "after: 5 %", "5 % of the posterior lie below."), &ConstantRange::lowest},
      {column("centre", "mean", "Geometric mean of the posterior, which the record has as the constant."),
       &ConstantRange::centre},
      {column("highest", "95 %", "95 % of the posterior lie below."), &ConstantRange::highest},
      {"change_of_coarser", "coarser lattice", keys::significant(2, keys::percent),
       "By how much the mean is higher on a lattice of half as many values a constant.",
       &ConstantRange::change_of_coarser}};
}

const Quantities<NextFiring> next_quantities{
    {quantity::peak_pressure, &NextFiring::pressure},
    {initial_temperature, &NextFiring::temperature},
    {quantity::gap, &NextFiring::gap},
    {probability("ignition_probability", "ignites", "Probability that the round ignites, after all firings."),
     &NextFiring::ignition},
    {"information", "tells [bit]", keys::significant(2),
     "What its outcome tells of the constants, on average.", &NextFiring::information}};

int rounds_of(const FiringResult& result, bool ignited) {
  int rounds = 0;
  for (const FiringRow& row : result.rows) rounds += row.firing.ignited == ignited ? row.firing.rounds : 0;
  return rounds;
}

/// What the texts of the page are filled with.
Row facts_of(const FiringResult& result) {
  Row facts{{"failure", result.failure},
            {"contradicting", result.contradicting},
            {"quiet", rounds_of(result, false)},
            {"ignited", rounds_of(result, true)},
            {"demonstration", result.record && result.record->calibration.firings->demonstration},
            {"rows", Row::array()}};
  for (const FiringRow& row : result.rows) {
    Row& facts_of_row = facts["rows"].emplace_back(report::json_of(row_quantities(), row));
    facts_of_row["ignited_rounds"] = row.ignited;
    facts_of_row["counted_rounds"] = row.rounds;
  }
  if (!result.next.empty()) facts["next"] = report::json_of(next_quantities, result.next.front());
  if (result.record) facts["largest"] = report::centimetres(result.record->calibration.evidence.largest_gap);
  return facts;
}

std::vector<report::ReportTable> tables_of(const FiringResult& result) {
  const Row facts = facts_of(result);
  const auto table = [&](const char* title, const auto& quantities, const auto& rows, const char* notes) {
    return report::table_of(title, quantities, rows, said(notes, facts));
  };
  return {{table("Firings, and the probability that such a round ignites", row_quantities(), result.rows,
                 "calibration.note.firings"),
           "firings.csv", "firings"},
          {table("The constants before and after the firings", range_quantities(), result.constants,
                 "calibration.note.posterior"),
           "", "posterior"},
          {table("What one more round would tell", next_quantities, result.next, "calibration.note.next"), "",
           "next_firings"}};
}

}  // namespace

std::string answer(const FiringResult& result) {
  return said("calibration.firings.answer", facts_of(result)).front();
}

report::Report report_of(const FiringResult& result) {
  report::Report report{result.study.study.title, answer(result), report::remaking_command(result.study)};
  if (result.record) report.files.push_back({"calibration.json", study::to_json_text(*result.record)});
  for (report::ReportTable& table : tables_of(result)) report.add(std::move(table));
  report.say("## Setup\n\n" + report::setup_text(result.study));
  report.add({run_table(result.conditions), "", "runs", report::Shown::page});
  report.say(report::timing_sentence(result.timing));
  report.json = study_json(result.study, report,
                           {{"failure", result.failure}, {"timing", report::timing_json(result.timing)}});
  return report;
}

std::vector<report::ReportTable> firing_results() { return tables_of({}); }

}  // namespace launchsafe::kinds
