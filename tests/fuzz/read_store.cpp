// What a store reads back from any bytes: lines of a journal, lines of answers, and the answers in them. An
// input is a journal and, after a line "%%%%", a file of answers. What is read must mean the same when it is
// written again.
#include "fuzz_input.hpp"
#include "journal.hpp"
#include "launchsafe/study/case_answer.hpp"

#include <cmath>

namespace {

using namespace launchsafe;

void check_entry(const store::JournalEntry& entry) {
  fuzz::require(!entry.hash.empty(), "an entry is of a case");
  const std::string line = store::journal_line(entry);
  fuzz::require(line.find('\n') == line.size() - 1, "an entry is one line", line);
  const auto again = store::journal_entry(std::string_view(line).substr(0, line.size() - 1));
  fuzz::require(again.has_value(), "an entry can be written and read", line);
  fuzz::require(store::journal_line(*again) == line, "an entry is what was written", line);
}

void check_verdict(const study::CaseAnswer& answer, const study::GapVerdict& row) {
  if (row.judgement.verdict != study::Verdict::safe) return;
  fuzz::require(answer.completed(), "no failed run is safe");
  fuzz::require(!row.ignition, "no ignition is safe");
  fuzz::require(row.margin > row.uncertainty.total(), "what is safe has a margin");
  fuzz::require(std::isfinite(row.maximum.temperature), "what is safe has a temperature");
}

void check_answer(std::string_view text) {
  const auto answer = study::answer_from_json(std::string(text));
  if (!answer) return;
  for (const study::GapVerdict& row : answer->verdicts) check_verdict(*answer, row);
  const std::string written = study::to_json_line(*answer);
  const auto again = study::answer_from_json(written);
  fuzz::require(again.has_value(), "an answer can be written and read", written);
  fuzz::require(study::to_json_line(*again) == written, "an answer is what was written", written);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const auto parts = fuzz::parts_of(data, size);
  store::is_journal(parts[0]);
  store::for_each_line(parts[0], [](std::string_view line) {
    const auto entry = store::journal_entry(line);
    if (entry) check_entry(*entry);
    const auto mark = store::answer_entry(line);
    fuzz::require(!mark || !entry, "a line of the journal is of one kind", line);
    return entry || mark;
  });
  if (parts.size() < 2) return 0;
  store::is_answers(parts[1]);
  store::for_each_line(parts[1], [](std::string_view line) {
    const auto answer = store::parse_answer_line(line);
    // No fuzzer finds a checksum, so what stands where a text would is looked at as well.
    check_answer(answer ? answer->text : line);
    return answer.has_value();
  });
  return 0;
}
