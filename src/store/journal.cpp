#include "journal.hpp"

#include "launchsafe/store/sha256.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/stat.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <limits>

namespace launchsafe::store {
namespace {

constexpr std::array states{CaseState::done, CaseState::failed, CaseState::timed_out, CaseState::interrupted};
constexpr std::size_t check_digits = 16, digest_digits = 64, key_digits = 32;
constexpr std::string_view hexadecimal = "0123456789abcdef";

constexpr std::string_view entry_begin = R"({"case":")";
constexpr std::string_view answer_begin = R"({"answer":")", answer_middle = R"(","sha256":")",
                           answer_end = R"("})";

bool is_hexadecimal(std::string_view text) {
  return text.find_first_not_of(hexadecimal) == std::string_view::npos;
}

std::optional<CaseState> state_of(const std::string& name) {
  for (const CaseState state : states) {
    if (to_string(state) == name) return state;
  }
  return {};
}

nlohmann::ordered_json number(double value) {
  return std::isfinite(value) ? nlohmann::ordered_json(value) : nlohmann::ordered_json(nullptr);
}

/// Fills an entry as a line is parsed: a study of ten thousand cases is read at every start, and a tree of
/// values for each line would take most of that time. What is unknown or of another type is passed over.
class EntryReader : public nlohmann::json_sax<nlohmann::json> {
 public:
  JournalEntry entry;
  bool has_state = false;

  bool key(string_t& name) override {
    key_ = name;
    return true;
  }
  bool string(string_t& text) override {
    if (key_ == "case") entry.hash = text;
    if (key_ == "state") take_state(text);
    if (key_ == "label") entry.label = text;
    if (key_ == "reason") entry.reason = text;
    if (key_ == "host") entry.host = text;
    if (key_ == "end_time") entry.end_time = text;
    return true;
  }
  bool number_integer(std::int64_t number) override {
    if (key_ == "file_time_ns") entry.file_time = number;
    return real(static_cast<double>(number));
  }
  bool number_unsigned(std::uint64_t number) override {
    // One that does not fit is no version of ours, and must not become one by being cut off.
    constexpr std::uint64_t most = std::numeric_limits<int>::max();
    if (key_ == "model_version") entry.model_version = static_cast<int>(number <= most ? number : 0);
    if (key_ == "file_bytes") entry.file_size = number;
    constexpr std::uint64_t largest = std::numeric_limits<std::int64_t>::max();
    return number <= largest ? number_integer(static_cast<std::int64_t>(number))
                             : real(static_cast<double>(number));
  }
  bool number_float(double number, const string_t&) override { return real(number); }
  bool null() override { return real(std::numeric_limits<double>::quiet_NaN()); }
  bool boolean(bool) override { return true; }
  bool binary(binary_t&) override { return false; }
  /// An entry is one flat object.
  bool start_object(std::size_t) override { return ++depth_ == 1; }
  bool end_object() override { return true; }
  bool start_array(std::size_t) override { return false; }
  bool end_array() override { return false; }
  bool parse_error(std::size_t, const std::string&, const nlohmann::json::exception&) override {
    return false;
  }

 private:
  bool real(double number) {
    if (key_ == "wall_time_s") entry.wall_time = number;
    if (key_ == "processor_time_s") entry.processor_time = number;
    if (key_ == "predicted_updates") entry.predicted_updates = number;
    if (key_ == "time_limit_s") entry.time_limit = number;
    return true;
  }
  void take_state(const string_t& name) {
    const std::optional<CaseState> state = state_of(name);
    has_state = state.has_value();
    entry.state = state.value_or(CaseState::done);
  }

  std::string key_;
  int depth_ = 0;
};

}  // namespace

std::string to_string(CaseState state) {
  switch (state) {
    case CaseState::done:
      return "done";
    case CaseState::failed:
      return "failed";
    case CaseState::timed_out:
      return "timed-out";
    case CaseState::interrupted:
      return "interrupted";
  }
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
  EntryReader reader;
  if (!nlohmann::json::sax_parse(line, &reader) || !reader.has_state || reader.entry.hash.empty()) return {};
  return std::move(reader.entry);
}

std::string answer_line(std::string_view key, std::string_view text) {
  std::string line;
  line.reserve(key.size() + check_digits + text.size() + 3);
  line.append(key).append(" ").append(sha256(text), 0, check_digits).append(" ").append(text).append("\n");
  return line;
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

std::string answer_mark(std::string_view key, std::string_view text) {
  return fmt::format("{} {}", key, sha256(fmt::format("{} {}", key, text)));
}

std::string answer_entry_line(std::string_view key, std::string_view text) {
  const std::string mark = answer_mark(key, text);
  std::string line(answer_begin);
  line.append(key).append(answer_middle).append(mark, key.size() + 1).append(answer_end).append("\n");
  return line;
}

std::optional<std::string> answer_entry(std::string_view line) {
  if (!line.starts_with(answer_begin) || !line.ends_with(answer_end)) return {};
  line.remove_prefix(answer_begin.size());
  const std::size_t key_end = line.find(answer_middle);
  if (key_end == std::string_view::npos || key_end == 0) return {};
  const std::string_view key = line.substr(0, key_end);
  line.remove_prefix(key_end + answer_middle.size());
  const std::string_view digest = line.substr(0, line.size() - answer_end.size());
  if (digest.size() != digest_digits || !is_hexadecimal(digest) || !is_hexadecimal(key)) return {};
  return std::string(key).append(" ").append(digest);
}

namespace {

bool any_line(std::string_view content, const std::function<bool(std::string_view)>& is_one) {
  bool any = false;
  for_each_line(content, [&](std::string_view line) { return any = any || is_one(line); });
  return any;
}

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

std::size_t for_each_line(std::string_view text, const std::function<bool(std::string_view)>& take) {
  std::size_t ignored = 0;
  for (std::size_t end = text.find('\n'); end != std::string_view::npos; end = text.find('\n')) {
    if (end > 0 && !take(text.substr(0, end))) ++ignored;
    text.remove_prefix(end + 1);
  }
  return ignored;
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
  if (!write_all(file_.number(), lines) || ::fdatasync(file_.number()) != 0) return write_error(path_, errno);
  return {};
}

}  // namespace launchsafe::store
