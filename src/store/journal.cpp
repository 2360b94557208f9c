#include "journal.hpp"

#include "launchsafe/store/sha256.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <limits>
#include <utility>

namespace launchsafe::store {
namespace {

constexpr std::array<std::pair<CaseState, const char*>, 4> states{{{CaseState::done, "done"},
                                                                   {CaseState::failed, "failed"},
                                                                   {CaseState::timed_out, "timed-out"},
                                                                   {CaseState::interrupted, "interrupted"}}};
constexpr std::size_t check_digits = 16, digest_digits = 64, key_digits = 32;
constexpr std::string_view hexadecimal = "0123456789abcdef";

constexpr std::string_view entry_begin = R"({"case":")";
constexpr std::string_view answer_begin = R"({"answer":")";

bool is_hexadecimal(std::string_view text) {
  return text.find_first_not_of(hexadecimal) == std::string_view::npos;
}

std::optional<CaseState> state_of(const std::string& name) {
  for (const auto& [state, word] : states)
    if (name == word) return state;
  return {};
}

nlohmann::ordered_json number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

/// NaN for null, which stands for what is not finite; 0 for what is no number or not there.
double number_member(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  if (found == object.end()) return 0.0;
  if (found->is_null()) return std::numeric_limits<double>::quiet_NaN();
  return found->is_number() ? found->get<double>() : 0.0;
}

/// 0 for what is no integer, does not fit (cut off it would become another one), or is not there.
template <class Integer>
Integer integer_member(const nlohmann::json& object, const char* key) {
  const auto fitting = [](auto number) {
    return std::in_range<Integer>(number) ? static_cast<Integer>(number) : Integer{0};
  };
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number_integer()) return 0;
  return found->is_number_unsigned() ? fitting(found->get<std::uint64_t>())
                                     : fitting(found->get<std::int64_t>());
}

}  // namespace

std::string text_member(const nlohmann::json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : std::string{};
}

std::size_t for_each_line(std::string_view text, const std::function<bool(std::string_view)>& take) {
  std::size_t ignored = 0;
  for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
    if (end > 0 && !take(text.substr(0, end))) ++ignored;
    text.remove_prefix(end + 1);
  }
  return ignored;
}

bool any_line(std::string_view text, const std::function<bool(std::string_view)>& is_one) {
  bool any = false;
  for_each_line(text, [&](std::string_view line) { return any = any || is_one(line); });
  return any;
}

std::string to_string(CaseState state) {
  for (const auto& [each, word] : states)
    if (each == state) return word;
  return "unknown";
}

std::string journal_line(const JournalEntry& entry) {
  nlohmann::ordered_json line{
      {"case", entry.hash}, {"state", to_string(entry.state)}, {"label", entry.label}};
  if (!entry.reason.empty()) line["reason"] = entry.reason;
  line["model_version"] = entry.model_version;
  line["wall_time_s"] = number(entry.wall_time);
  line["processor_time_s"] = number(entry.processor_time);
  line["predicted_updates"] = number(entry.predicted_updates);
  if (entry.state == CaseState::timed_out) line["time_limit_s"] = number(entry.time_limit);
  line["host"] = entry.host;
  line["end_time"] = entry.end_time;
  if (entry.state == CaseState::done) {
    line["file_bytes"] = entry.file_size;
    line["file_time_ns"] = entry.file_time;
  }
  return line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

std::optional<JournalEntry> journal_entry(std::string_view line) {
  const auto object = nlohmann::json::parse(line, nullptr, false);
  if (!object.is_object()) return {};
  const std::optional<CaseState> state = state_of(text_member(object, "state"));
  JournalEntry entry;
  entry.hash = text_member(object, "case");
  if (!state || entry.hash.empty()) return {};
  entry.state = *state;
  entry.label = text_member(object, "label");
  entry.reason = text_member(object, "reason");
  entry.model_version = integer_member<int>(object, "model_version");
  entry.wall_time = number_member(object, "wall_time_s");
  entry.processor_time = number_member(object, "processor_time_s");
  entry.predicted_updates = number_member(object, "predicted_updates");
  entry.time_limit = number_member(object, "time_limit_s");
  entry.host = text_member(object, "host");
  entry.end_time = text_member(object, "end_time");
  entry.file_size = integer_member<std::uint64_t>(object, "file_bytes");
  entry.file_time = integer_member<std::int64_t>(object, "file_time_ns");
  return entry;
}

std::string answer_line(std::string_view key, std::string_view text) {
  return fmt::format("{} {:.{}} {}\n", key, sha256(text), check_digits, text);
}

std::optional<AnswerLine> parse_answer_line(std::string_view line) {
  const std::size_t key_end = line.find(' ');
  if (key_end == std::string_view::npos || key_end == 0) return {};
  const std::string_view rest = line.substr(key_end + 1);
  if (rest.size() <= check_digits || rest[check_digits] != ' ') return {};
  const std::string_view text = rest.substr(check_digits + 1);
  if (sha256(text).compare(0, check_digits, rest.substr(0, check_digits)) != 0) return {};
  return AnswerLine{line.substr(0, key_end), text};
}

std::string answer_digest(std::string_view key, std::string_view text) {
  return fmt::format("{} {}", key, sha256(fmt::format("{} {}", key, text)));
}

std::string answer_entry_line(std::string_view key, std::string_view text) {
  const std::string digest = answer_digest(key, text).substr(key.size() + 1);
  return nlohmann::ordered_json{{"answer", key}, {"sha256", digest}}.dump() + "\n";
}

std::optional<std::string> answer_entry(std::string_view line) {
  if (!line.starts_with(answer_begin)) return {};
  const auto object = nlohmann::json::parse(line, nullptr, false);
  if (!object.is_object() || object.size() != 2) return {};
  const std::string key = text_member(object, "answer"), digest = text_member(object, "sha256");
  if (key.empty() || digest.size() != digest_digits || !is_hexadecimal(key + digest)) return {};
  return key + " " + digest;
}

namespace {

/// A first line that a kill cut short has no end, and nothing follows it.
bool is_one_cut_line(std::string_view content) { return content.find('\n') == std::string_view::npos; }

/// Whether a line that was cut short goes on with the key of a case or an answer and `end`.
bool goes_on_with_key(std::string_view line, std::string_view end) {
  return line.size() > key_digits && is_hexadecimal(line.substr(0, key_digits)) &&
         line.substr(key_digits).starts_with(end);
}

}  // namespace

bool is_journal(std::string_view content) {
  if (is_one_cut_line(content)) {
    const bool answer = content.starts_with(answer_begin);
    if (!answer && !content.starts_with(entry_begin)) return false;
    return goes_on_with_key(content.substr((answer ? answer_begin : entry_begin).size()), "\"");
  }
  return any_line(content, [](std::string_view line) {
    return answer_entry(line).has_value() || journal_entry(line).has_value();
  });
}

bool is_answers(std::string_view content) {
  if (is_one_cut_line(content)) return goes_on_with_key(content, " ");
  return any_line(content, [](std::string_view line) { return parse_answer_line(line).has_value(); });
}

MaybeError AppendedFile::open() {
  Result<Descriptor> opened = open_in_place(path_, O_APPEND);
  if (!opened) return opened.error();
  file_ = std::move(*opened);
  struct stat status {};
  if (::fstat(file_.number(), &status) != 0) return write_error(path_, errno);
  if (status.st_size == 0) {
    if (!sync_folder(path_.parent_path())) return write_error(path_, errno);
    return {};
  }
  // A line that a kill cut short must not swallow the beginning of ours.
  char last = 0;
  if (::pread(file_.number(), &last, 1, status.st_size - 1) != 1) return write_error(path_, errno);
  if (last != '\n' && !write_all(file_.number(), "\n")) return write_error(path_, errno);
  return {};
}

MaybeError AppendedFile::append(std::string_view lines) {
  if (!file_.is_open()) {
    if (MaybeError error = open()) return error;
  }
  if (!write_all(file_.number(), lines)) return write_error(path_, errno);
  return {};
}

MaybeError AppendedFile::sync() {
  if (file_.is_open() && ::fdatasync(file_.number()) != 0) return write_error(path_, errno);
  return {};
}

}  // namespace launchsafe::store
