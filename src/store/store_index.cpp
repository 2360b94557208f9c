#include "store_index.hpp"

#include "launchsafe/store/atomic_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

namespace launchsafe::store {
namespace {

bool is_of_a_part(const std::string& name, std::string_view stem) {
  return name == fmt::format("{}.jsonl", stem) ||
         (name.starts_with(fmt::format("{}.", stem)) && name.ends_with(".jsonl"));
}

/// Between journals of different parts the time decides; of equal ones the result counts.
bool is_newer(const JournalEntry& entry, const JournalEntry& known) {
  if (entry.end_time != known.end_time) return entry.end_time > known.end_time;
  return entry.state == CaseState::done || known.state != CaseState::done;
}

std::string ignored_remark(const std::filesystem::path& file, std::size_t lines) {
  return fmt::format("{}: {} damaged line{} ignored", file.string(), lines, lines == 1 ? " was" : "s were");
}

std::string unknown_remark(const std::filesystem::path& file, std::size_t lines) {
  return fmt::format("{}: {} not as the journal says, and {} ignored", file.string(),
                     lines == 1 ? "1 answer is" : fmt::format("{} answers are", lines),
                     lines == 1 ? "is" : "are");
}

}  // namespace

MaybeError StoreIndex::read(const std::filesystem::path& folder) {
  std::error_code status;
  const std::vector<std::string> names = list_folder(folder, status);
  if (status)
    return Error{Error::Kind::unreadable,
                 fmt::format("cannot read {}: {}", folder.string(), status.message())};
  for (const bool journals : {true, false}) {
    for (const std::string& name : names) {
      if (!is_of_a_part(name, journals ? "journal" : "answers")) continue;
      const std::filesystem::path file = folder / name;
      Result<std::string> text = read_file(file);
      if (!text) return text.error();
      if (journals)
        read_journal(file, *text);
      else
        read_answers(file, *text);
    }
  }
  return {};
}

void StoreIndex::read_journal(const std::filesystem::path& file, std::string_view text) {
  // Within a file the order counts, whatever the clock said.
  std::unordered_map<std::string, JournalEntry> newest;
  const std::lock_guard lock(mutex_);
  const std::size_t ignored = for_each_line(text, [&](std::string_view line) {
    if (std::optional<std::string> digest = answer_entry(line)) {
      answer_digests_.insert(std::move(*digest));
      return true;
    }
    std::optional<JournalEntry> entry = journal_entry(line);
    if (entry) newest.insert_or_assign(entry->hash, std::move(*entry));
    return entry.has_value();
  });
  if (ignored > 0) remarks_.push_back(ignored_remark(file, ignored));
  for (auto& [hash, entry] : newest) {
    const auto [known, is_first] = entries_.try_emplace(hash);
    if (is_first || is_newer(entry, known->second)) known->second = std::move(entry);
  }
}

void StoreIndex::read_answers(const std::filesystem::path& file, std::string_view text) {
  const std::lock_guard lock(mutex_);
  std::size_t unknown = 0;
  const std::size_t ignored = for_each_line(text, [&](std::string_view line) {
    const std::optional<AnswerLine> answer = parse_answer_line(line);
    if (!answer) return false;
    if (answer_digests_.contains(answer_digest(answer->key, answer->text)))
      answers_.insert_or_assign(std::string(answer->key), std::string(answer->text));
    else
      ++unknown;
    return true;
  });
  if (ignored > 0) remarks_.push_back(ignored_remark(file, ignored));
  if (unknown > 0) remarks_.push_back(unknown_remark(file, unknown));
}

std::optional<JournalEntry> StoreIndex::last_entry(const std::string& hash) const {
  const std::lock_guard lock(mutex_);
  const auto found = entries_.find(hash);
  return found == entries_.end() ? std::nullopt : std::optional(found->second);
}

std::vector<JournalEntry> StoreIndex::entries() const {
  const std::lock_guard lock(mutex_);
  std::vector<JournalEntry> entries;
  entries.reserve(entries_.size());
  for (const auto& [hash, entry] : entries_) entries.push_back(entry);
  return entries;
}

void StoreIndex::take(const JournalEntry& entry) {
  const std::lock_guard lock(mutex_);
  entries_.insert_or_assign(entry.hash, entry);
}

std::optional<std::string> StoreIndex::answer(const std::string& key) const {
  const std::lock_guard lock(mutex_);
  const auto found = answers_.find(key);
  return found == answers_.end() ? std::nullopt : std::optional(found->second);
}

void StoreIndex::take_answer(const std::string& key, const std::string& text) {
  const std::lock_guard lock(mutex_);
  answers_.insert_or_assign(key, text);
}

std::map<std::string, std::string> StoreIndex::answers() const {
  const std::lock_guard lock(mutex_);
  return answers_;
}

std::vector<std::string> StoreIndex::remarks() const {
  const std::lock_guard lock(mutex_);
  return remarks_;
}

void StoreIndex::remark(const std::string& text) {
  const std::lock_guard lock(mutex_);
  if (std::find(remarks_.begin(), remarks_.end(), text) == remarks_.end()) remarks_.push_back(text);
}

}  // namespace launchsafe::store
