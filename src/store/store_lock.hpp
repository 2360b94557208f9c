// Who may write into a store.
#pragma once

#include "launchsafe/store/result.hpp"
#include "posix_file.hpp"

#include <filesystem>
#include <string>

namespace launchsafe::store {

/// Locks on files of a folder that the system itself takes back when their process ends, however it ends.
/// A whole study holds `lock` alone; a part shares `lock` with other parts and holds `lock.PART` alone. So a
/// whole study and any part exclude each other, and different parts do not.
class StoreLock {
 public:
  /// Errors: conflict (names who holds it, or a file of that name that is none of ours), write_failed.
  static Result<StoreLock> take(const std::filesystem::path& folder, const std::string& part);
  StoreLock(StoreLock&&) = default;
  StoreLock& operator=(StoreLock&&) = default;
  /// Why the lock files may not be used: files of these names that no process of ours left there. Changes
  /// nothing. Errors: conflict, unreadable.
  static MaybeError obstacle(const std::filesystem::path& folder, const std::string& part);
  /// Releases, and empties the file that names the owner; the files stay.
  ~StoreLock();

  /// False where the file system knows no locks: then nothing keeps a second process out.
  bool enforced() const { return enforced_; }

 private:
  StoreLock() = default;

  Descriptor whole_, part_;
  bool enforced_ = true;
};

}  // namespace launchsafe::store
