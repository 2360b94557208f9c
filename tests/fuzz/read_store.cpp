// What is read back from any bytes that stand for a results file: no verdict that its own numbers do not bear
// out, and the same again once it is written.
#include "fuzz_input.hpp"
#include "launchsafe/study/case_answer.hpp"

#include <cmath>

namespace {

using namespace launchsafe;

void check_verdict(const study::CaseAnswer& answer, const study::GapVerdict& row) {
  if (row.judgement.verdict != study::Verdict::safe) return;
  fuzz::require(answer.completed(), "no failed run is safe");
  fuzz::require(!row.ignition, "no ignition is safe");
  fuzz::require(row.margin > row.uncertainty.total(), "what is safe has a margin");
  fuzz::require(std::isfinite(row.maximum.temperature), "what is safe has a temperature");
}

/// On an input that has nothing to say, under which most may be safe.
void check_verdicts(study::CaseAnswer answer) {
  const auto evidence = std::make_shared<const study::CaseEvidence>(study::CaseEvidence{
      answer.failure, answer.run.limiters, answer.validity_warnings, answer.friction_rise});
  study::judge_rows({}, evidence, answer.critical, answer.verdicts);
  for (const study::GapVerdict& row : answer.verdicts) check_verdict(answer, row);
}

void check_answer(const study::CaseAnswer& answer, const std::string& key) {
  check_verdicts(answer);
  auto database = store::Database::in_memory("again");
  try {
    study::save_answer(database, key, answer);
  } catch (const store::Error& error) {
    fuzz::require(false, "an answer can be written", error.message);
  }
  const auto again = study::read_answer(database, key);
  fuzz::require(again && study::bytes_of(*again) == study::bytes_of(answer), "an answer is what was written");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) try {
  static fuzz::ScratchFolder folder;
  folder.write("study.db", {reinterpret_cast<const char*>(data), size});
  auto database = store::Database::copy_of(folder.path() / "study.db");
  for (const store::SqlRow& row : database.rows("SELECT key FROM stored_case_answers")) {
    const auto* key = std::get_if<std::string>(&row.front());
    if (key == nullptr || key->empty() || key->find_first_not_of("0123456789abcdef") != std::string::npos)
      continue;
    if (const auto answer = study::read_answer(database, *key)) check_answer(*answer, *key);
  }
  return 0;
} catch (const store::Error&) {  // no results file, or none with answers
  return 0;
}
