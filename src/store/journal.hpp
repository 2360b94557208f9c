// Lines of text files that are only ever appended to.
#pragma once

#include "launchsafe/store/case_store.hpp"
#include "posix_file.hpp"

#include <nlohmann/json.hpp>

#include <functional>
#include <optional>
#include <string>
#include <string_view>

namespace launchsafe::store {

/// One line of JSON with its newline. Numbers that are not finite become null.
std::string journal_line(const JournalEntry& entry);
/// Nothing for a line that is no entry.
std::optional<JournalEntry> journal_entry(std::string_view line);

/// "KEY CHECK TEXT" with its newline; CHECK are 16 hexadecimal digits of the SHA-256 of the text.
std::string answer_line(std::string_view key, std::string_view text);
struct AnswerLine {
  std::string_view key, text;
};
/// Nothing for a line that is no answer or whose text is not what it was.
std::optional<AnswerLine> parse_answer_line(std::string_view line);

/// The journal's line about an answer: its key and the SHA-256 of both. An answer that the journal does not
/// know was not written by this program, whatever its own check says.
std::string answer_entry_line(std::string_view key, std::string_view text);
/// Key and digest as in the line above; nothing for any other line.
std::optional<std::string> answer_entry(std::string_view line);
/// What `answer_entry` gives for the line of an answer.
std::string answer_digest(std::string_view key, std::string_view text);

/// Whether the content of a file is that of a journal, or of answers: some line of it is, or it is the
/// beginning of a single line that a kill or a full disk cut short.
bool is_journal(std::string_view content);
bool is_answers(std::string_view content);

/// Calls `take` with every line that ends in a newline; a last one without was cut short. Returns how many
/// lines `take` did not understand.
std::size_t for_each_line(std::string_view text, const std::function<bool(std::string_view)>& take);
/// Whether `is_one` holds for any such line.
bool any_line(std::string_view text, const std::function<bool(std::string_view)>& is_one);

/// A text in an object of JSON; empty for what is no text or not there.
std::string text_member(const nlohmann::json& object, const char* key);

/// A file that lines are added to. It is made with the first of them. Whether what is there already is ours
/// is the caller's to find out before, see `obstacle_in_place`.
class AppendedFile {
 public:
  explicit AppendedFile(std::filesystem::path path) : path_(std::move(path)) {}
  /// Adds whole lines, which outlive this process from then on. Errors: conflict (no plain file),
  /// write_failed.
  MaybeError append(std::string_view lines);
  /// Waits until all lines are on disk, so that they outlive a power cut too. Errors: write_failed.
  MaybeError sync();

 private:
  MaybeError open();

  std::filesystem::path path_;
  Descriptor file_;
};

}  // namespace launchsafe::store
