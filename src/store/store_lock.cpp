#include "store_lock.hpp"

#include "launchsafe/store/atomic_file.hpp"
#include "launchsafe/store/manifest.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>

#include <cerrno>
#include <csignal>
#include <regex>
#include <vector>

namespace launchsafe::store {
namespace {

/// "HOST process PID since TIME".
std::string own_name() { return fmt::format("{} process {} since {}\n", host_name(), ::getpid(), utc_now()); }

/// HOST and PID in a lock file's content that we wrote; people's notes have no match.
std::optional<std::cmatch> named_owner(std::string_view content) {
  static const std::regex form("([^\\s]+) process ([0-9]{1,10}) since [0-9T:-]{19}Z\n");
  constexpr std::size_t longest = 400;
  std::cmatch owner;
  if (content.size() >= longest ||
      !std::regex_match(content.data(), content.data() + content.size(), owner, form))
    return {};
  return owner;
}

/// Whether a lock file's content is ours.
bool names_owner(std::string_view content) { return named_owner(content).has_value(); }

std::string part_file(const std::string& part) { return "lock." + part; }

/// The living owner that a lock file names; empty when it names none, or one of this machine that has ended:
/// a kill leaves its name.
std::string owner_in(const std::filesystem::path& file) {
  const Result<std::string> text = read_file(file);
  const auto owner = text ? named_owner(*text) : std::nullopt;
  if (!owner) return {};
  const long long process = std::stoll((*owner)[2].str());
  const bool ended =
      (*owner)[1] == host_name() && ::kill(static_cast<pid_t>(process), 0) != 0 && errno == ESRCH;
  return ended ? std::string{} : text->substr(0, text->find('\n'));
}

/// Who keeps us out of the lock file of this name, for the message: `lock` itself names only a whole study.
std::string owners(const std::filesystem::path& folder, const std::string& wanted) {
  std::vector<std::string> found;
  std::error_code status;
  for (const std::string& name : list_folder(folder, status)) {
    if (name != wanted && !(wanted == "lock" && name.starts_with("lock."))) continue;
    if (const std::string owner = owner_in(folder / name); !owner.empty()) found.push_back(owner);
  }
  return found.empty() ? "another process" : fmt::format("{}", fmt::join(found, " and "));
}

enum class Outcome { taken, held, unsupported, failed };

/// One attempt; failed with errno set.
Outcome try_lock(int file, int operation) {
  while (::flock(file, operation | LOCK_NB) != 0) {
    if (errno == EINTR) continue;
    if (errno == EWOULDBLOCK) return Outcome::held;
    const bool unsupported = errno == ENOLCK || errno == ENOTSUP || errno == EOPNOTSUPP || errno == ENOSYS;
    return unsupported ? Outcome::unsupported : Outcome::failed;
  }
  return Outcome::taken;
}

/// The text helps people alone, so a failure to write it is none of the lock.
void name_owner(const Descriptor& file) {
  if (::ftruncate(file.number(), 0) == 0) write_all(file.number(), own_name());
}

}  // namespace

MaybeError StoreLock::obstacle(const std::filesystem::path& folder, const std::string& part) {
  if (MaybeError error = obstacle_in_place(folder / "lock", names_owner)) return error;
  return part.empty() ? MaybeError() : obstacle_in_place(folder / part_file(part), names_owner);
}

Result<StoreLock> StoreLock::take(const std::filesystem::path& folder, const std::string& part) {
  if (const MaybeError error = obstacle(folder, part)) return *error;
  StoreLock lock;
  const auto acquire = [&](Descriptor& file, const std::string& name, int operation) -> MaybeError {
    Result<Descriptor> opened = open_in_place(folder / name, 0);
    if (!opened) return opened.error();
    switch (try_lock(opened->number(), operation)) {
      case Outcome::held:
        return Error{Error::Kind::conflict,
                     fmt::format("{} is in use by {}", folder.string(), owners(folder, name))};
      case Outcome::failed:
        return write_error(folder / name, errno);
      case Outcome::unsupported:
        lock.enforced_ = false;
        break;
      case Outcome::taken:
        break;
    }
    file = std::move(*opened);
    return {};
  };
  if (const MaybeError error = acquire(lock.whole_, "lock", part.empty() ? LOCK_EX : LOCK_SH)) return *error;
  if (!part.empty()) {
    if (const MaybeError error = acquire(lock.part_, part_file(part), LOCK_EX)) return *error;
  }
  name_owner(part.empty() ? lock.whole_ : lock.part_);
  return lock;
}

StoreLock::~StoreLock() {
  const Descriptor& named = part_.is_open() ? part_ : whole_;
  // Emptied before it is released, so that the next owner's name is never wiped out.
  if (named.is_open() && ::ftruncate(named.number(), 0) != 0) return;
}

}  // namespace launchsafe::store
