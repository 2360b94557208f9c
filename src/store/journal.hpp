// Lines of text files that are only ever appended to.
#pragma once

#include "launchsafe/store/case_store.hpp"
#include "posix_file.hpp"

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

/// Calls `take` with every line that ends in a newline; a last one without was cut short. Returns how many
/// lines `take` did not understand.
std::size_t for_each_line(std::string_view text, const std::function<bool(std::string_view)>& take);

/// A file that lines are added to. It is made with the first of them.
class AppendedFile {
 public:
  explicit AppendedFile(std::filesystem::path path) : path_(std::move(path)) {}
  /// Adds whole lines and waits until they are on disk. Errors: write_failed.
  MaybeError append(std::string_view lines);

 private:
  MaybeError open();

  std::filesystem::path path_;
  Descriptor file_;
};

}  // namespace launchsafe::store
