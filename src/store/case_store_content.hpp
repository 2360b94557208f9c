// What a store holds while it is open, and the changes that it makes.
#pragma once

#include "case_store_files.hpp"
#include "launchsafe/store/case_store.hpp"
#include "store_status.hpp"

#include <chrono>
#include <filesystem>
#include <functional>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace launchsafe::store {

/// The newest attempts on all cases.
const SqlTable<RunRecord>& run_table();

/// What every case of this program has in common; what differs between equal runs is left out.
Manifest common_manifest();

struct CaseStore::Content {
  Content(StoreNames all_names, StoreOptions chosen, Database opened, bool may_write)
      : names(std::move(all_names)),
        options(std::move(chosen)),
        manifest(common_manifest()),
        host(host_name()),
        writes(may_write),
        database(std::move(opened)) {}

  /// Makes the table of runs where it is missing, and takes the rows of these files.
  MaybeError take_over(const std::vector<std::filesystem::path>& others);

  /// Makes a change, alone among the threads, unless something failed before; the first failure is kept and
  /// told. `at_once`: it is on disk before this returns.
  void change(bool at_once, const std::function<MaybeError()>& make);
  void fail(const Error& error);
  MaybeError failure() const;
  MaybeError flush();

  std::optional<RunRecord> record_of(const std::string& hash) const;
  void put(const RunRecord& record);
  /// Whether the record states a file of this size and time.
  bool knows(const std::string& hash, const struct stat& status) const;
  /// Reads and checks a file of another size or time than its record states; records it if it is whole.
  bool adopt(const std::string& hash);
  /// A file that is damaged, unless another thread has replaced it, counts no more. Returns its error.
  Error give_up(const std::string& hash, const Error& damage);
  MaybeError write_file(const std::string& hash, std::string_view bytes);
  void keep(const Result<std::string>& bytes, RunRecord record);
  /// Where and when an attempt ended, and of which model it was.
  void fill_in(RunRecord& record) const;

  bool is_given_up(const std::string& hash) const {
    const std::lock_guard lock(using_);
    return damaged_.contains(hash);
  }
  /// Takes over the whole result of another folder: a second name of its file where the file system can.
  MaybeError take_file(const std::filesystem::path& file, const std::string& hash);

  void remark(const std::string& text);
  void tell_progress(std::size_t done, std::size_t running, std::size_t total);
  void write_status();

  const StoreNames names;
  const StoreOptions options;
  const Manifest manifest;  ///< of every case, without its input
  const std::string host;
  const bool writes;
  mutable std::mutex naming;  ///< held while files get their names; locked before `using_`
  mutable std::mutex using_;  ///< of all below
  mutable Database database;
  StoreStatus status;
  std::vector<std::string> remarks;

 private:
  MaybeError make_change(bool at_once, const std::function<MaybeError()>& make);

  MaybeError failure_;
  std::set<std::string> damaged_;  ///< hashes
  std::chrono::steady_clock::time_point batch_began_, status_written_;
  bool has_said_who_ = false;
};

}  // namespace launchsafe::store
