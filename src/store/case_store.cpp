#include "launchsafe/store/case_store.hpp"

#include "case_store_files.hpp"
#include "launchsafe/scene/toml_reader.hpp"

#include <cassert>
#include <cerrno>

namespace launchsafe::store {
namespace {

constexpr std::size_t hash_digits = 32;

void make_folder(const std::filesystem::path& folder) {
  std::error_code status;
  const bool is_new = std::filesystem::create_directories(folder, status);
  if (is_new) sync_folder((folder / "..").lexically_normal());
  if (status)
    throw Error{Error::Kind::write_failed,
                fmt::format("cannot make the folder {}: {}", folder.string(), status.message())};
}

/// What every case of this program has in common; what differs between equal runs is left out.
Manifest common_manifest() {
  Manifest manifest = make_manifest("", 1);
  manifest.host.clear();
  manifest.start_time.clear();
  return manifest;
}

// --- tables of a report in a results file, for other programs ---

/// The type by which every value of a column can be declared.
std::string type_of_column(const PlainTable& table, std::size_t column) {
  bool any_text = false, any_number = false;
  for (const SqlRow& row : table.rows) {
    any_text = any_text || std::holds_alternative<std::string>(row[column]);
    any_number = any_number || std::holds_alternative<double>(row[column]);
  }
  if (any_text) return "ANY";
  return any_number ? "REAL" : "INTEGER";
}

/// Makes a table and fills it; none of that name may be there.
void write_table(Database& database, const PlainTable& table) {
  std::vector<std::string> declared;
  for (std::size_t i = 0; i < table.columns.size(); ++i)
    declared.push_back(fmt::format("\"{}\" {}", table.columns[i], type_of_column(table, i)));
  database.run(fmt::format("CREATE TABLE \"{}\" ({}) STRICT", table.name, fmt::join(declared, ", ")));
  const std::vector<std::string> marks(table.columns.size(), "?");
  const std::string insert =
      fmt::format("INSERT INTO \"{}\" VALUES ({})", table.name, fmt::join(marks, ", "));
  for (const SqlRow& row : table.rows) database.run(insert, row);
}

/// Drops all tables that are none of the store's own.
void drop_plain_tables(Database& database) {
  for (const SqlRow& row : database.rows("SELECT name FROM sqlite_schema WHERE type = 'table' AND name NOT "
                                         "GLOB 'stored_*' AND name NOT GLOB 'sqlite_*'"))
    database.run(fmt::format("DROP TABLE \"{}\"", std::get<std::string>(row[0])));
}

}  // namespace

CaseIdentity::CaseIdentity(std::string input)
    : input_(std::move(input)), hash_(sha256(input_).substr(0, hash_digits)) {}

Result<std::unique_ptr<CaseStore>> CaseStore::open(const std::filesystem::path& folder,
                                                   const std::string& part,
                                                   std::function<void(const Error&)> on_failure) try {
  StoreNames names{folder, part};
  make_folder(folder);
  make_folder(names.cases());
  Database database = of_results(names.results(), [&] { return Database::open(names.results()); });
  std::vector<std::filesystem::path> others = results_files_in(folder);
  std::erase_if(others, [&](const std::filesystem::path& each) {
    return each == names.results() || (!part.empty() && each != StoreNames{folder, {}}.results());
  });
  std::unique_ptr<CaseStore> store(
      new CaseStore(std::move(names), std::move(on_failure), std::move(database), true));
  store->take_over(others);
  // A part may have living neighbours.
  if (part.empty()) remove_leftovers(store->names_.cases());
  store->write_status();
  return store;
} catch (const Error& error) {
  return error;
}

Result<std::unique_ptr<CaseStore>> CaseStore::open_to_read(const std::filesystem::path& folder) try {
  std::error_code status;
  const std::filesystem::directory_iterator readable(folder, status);
  if (status)
    return Error{Error::Kind::unreadable,
                 fmt::format("cannot read {}: {}", folder.string(), status.message())};
  std::vector<std::filesystem::path> files = results_files_in(folder);
  Database database = of_results(files.empty() ? folder : files.front(), [&] {
    return files.empty() ? Database::in_memory(StoreNames{folder, {}}.results())
                         : Database::copy_of(files.front());
  });
  if (!files.empty()) files.erase(files.begin());
  std::unique_ptr<CaseStore> store(new CaseStore({folder, {}}, {}, std::move(database), false));
  store->take_over(files);
  return store;
} catch (const Error& error) {
  return error;
}

CaseStore::CaseStore(StoreNames names, std::function<void(const Error&)> on_failure, Database database,
                     bool writes)
    : names_(std::move(names)),
      on_failure_(std::move(on_failure)),
      manifest_(common_manifest()),
      host_(host_name()),
      writes_(writes),
      database_(std::move(database)),
      since_(utc_now()) {}

CaseStore::~CaseStore() {
  if (writes_) write_status(true);
}

std::vector<RunRecord> CaseStore::records() const {
  const std::lock_guard lock(using_);
  return records_in(database_);
}

bool CaseStore::holds(const std::string& hash) const {
  std::error_code failed;
  if (!std::filesystem::exists(names_.case_file(hash), failed)) return false;
  const std::lock_guard lock(using_);
  return !damaged_.contains(hash);
}

Result<run::CaseResult> CaseStore::load(const std::string& hash) {
  Result<StoredCase> stored = read_case_file(names_.case_file(hash));
  if (!stored) {
    const std::lock_guard lock(using_);
    if (stored.error().kind == Error::Kind::corrupt && damaged_.insert(hash).second)
      remarks_.push_back(stored.error().message + "; it does not count, and is computed again");
    return stored.error();
  }
  const std::optional<RunRecord> record = record_of(hash);
  if (record && record->state == CaseState::done) {
    stored->result.mechanics.wall_time = record->wall_time;
    stored->result.mechanics.processor_time = record->processor_time;
  }
  return std::move(stored->result);
}

void CaseStore::save(const CaseIdentity& identity, const scene::Scene& scene, run::CaseResult result,
                     RunRecord record) {
  assert(writes_);
  record.hash = identity.hash();
  record.state = CaseState::done;
  fill_in(record);
  Manifest manifest = manifest_;
  manifest.input_text = identity.input();
  manifest.input_sha256 = sha256(identity.input());
  manifest.model_version = record.model_version;
  if (record.wall_time == 0) {
    record.wall_time = result.mechanics.wall_time;
    record.processor_time = result.mechanics.processor_time;
  }
  result.mechanics.wall_time = result.mechanics.processor_time = 0;
  const Result<std::string> bytes = case_bytes(scene, result, manifest);
  const std::filesystem::path path = names_.case_file(record.hash);
  if (flush()) return;
  if (!bytes) return fail(of_file(path, bytes.error()));
  if (const MaybeError error = write_file_atomically(path, *bytes, IfExists::replace)) return fail(*error);
  put(record);
  const std::lock_guard lock(using_);
  damaged_.erase(record.hash);
}

void CaseStore::note(RunRecord record) {
  assert(writes_);
  fill_in(record);
  put(record);
}

void CaseStore::replace_tables(const std::vector<PlainTable>& tables) {
  change([&] {
    drop_plain_tables(database_);
    for (const PlainTable& table : tables) write_table(database_, table);
  });
}

std::vector<std::string> CaseStore::remarks() const {
  const std::lock_guard lock(using_);
  return remarks_;
}

Result<CaseStore::Imported> CaseStore::import_from(const std::filesystem::path& other) try {
  Imported imported;
  std::error_code status;
  if (std::filesystem::equivalent(other, folder(), status)) return imported;
  const std::vector<std::filesystem::path> files = results_files_in(other);
  if (files.empty())
    return Error{Error::Kind::missing, fmt::format("{} holds no results of a study", other.string())};
  for (const std::filesystem::path& file : files)
    if (Database::is_held(file)) throw told_who_writes({Error::Kind::held, {}}, file);
  const StoreNames theirs{other, {}};
  for (const std::string& name : scene::list_folder(theirs.cases())) {
    const std::filesystem::path file(name);
    if (file.extension() != ".h5") continue;
    const std::string hash = file.stem();
    if (holds(hash)) {
      ++imported.already_there;
      continue;
    }
    if (const MaybeError error = take_file(theirs.case_file(hash), hash)) return *error;
    ++imported.cases;
  }
  if (const MaybeError error = flush()) return *error;
  const std::lock_guard lock(using_);
  take_over(files);
  return imported;
} catch (const Error& error) {
  return error;
}

}  // namespace launchsafe::store
