#include "database.hpp"

#include <sqlite3.h>
#include <sys/vfs.h>

#include <chrono>
#include <cmath>
#include <limits>
#include <set>
#include <thread>

#include "text/error.hpp"

namespace muster::sweep {
namespace {

constexpr int patience = 120'000;  // ms, for the transactions of others; one takes some of them

// Write-ahead logs need memory that all workers share, so one machine. Numbers of statfs(2).
bool is_of_several_machines(const std::filesystem::path& file) {
  static const std::set<std::uint64_t> shared{
      0x6969,      // NFS
      0xff534d42,  // CIFS
      0xfe534d42,  // SMB 2
      0x0bd00bd0,  // Lustre
      0x47504653,  // GPFS
      0x19830326,  // BeeGFS
      0x00c36400,  // Ceph
      0x5346414f,  // AFS
      0x01021997,  // 9P
      0x65735546,  // FUSE
  };
  struct statfs found {};
  return ::statfs(file.c_str(), &found) != 0 || shared.count(static_cast<std::uint32_t>(found.f_type)) > 0;
}

}  // namespace

Database::Database(const std::filesystem::path& file) : file_(file) {
  if (sqlite3_open(file.c_str(), &handle_) != SQLITE_OK) {
    const std::string reason = handle_ ? sqlite3_errmsg(handle_) : "out of memory";
    sqlite3_close(handle_);
    throw Error(Exit::io, Place{file.string()}, reason);
  }
  try {
    sqlite3_busy_timeout(handle_, patience);
    if (!is_of_several_machines(file)) use_write_ahead_log();
    run("PRAGMA synchronous = NORMAL");
    run("PRAGMA foreign_keys = ON");
  } catch (...) {
    sqlite3_close(handle_);
    throw;
  }
}

Database::~Database() { sqlite3_close(handle_); }

void Database::fail() const { throw Error(Exit::io, Place{file_.string()}, sqlite3_errmsg(handle_)); }

void Database::run(const std::string& sql) {
  if (sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail();
}

// Of two connections that turn a new file's journal into a log one is refused at once, whatever the busy timeout: both
// hold a read lock, and waiting for each other would last for ever (sqlite3_busy_handler()).
void Database::use_write_ahead_log() {
  const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(patience);
  for (;;) {
    const int code = sqlite3_exec(handle_, "PRAGMA journal_mode = WAL", nullptr, nullptr, nullptr);
    if (code == SQLITE_OK) return;
    if (code != SQLITE_BUSY || std::chrono::steady_clock::now() > end) fail();
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
}

std::int64_t Database::number(const std::string& sql) {
  Statement query(*this, sql);
  return query.step() ? query.integer(0) : 0;
}

std::int64_t Database::last_row() const { return sqlite3_last_insert_rowid(handle_); }

Statement::Statement(Database& database, const std::string& sql) : database_(database) {
  check(sqlite3_prepare_v2(database.handle_, sql.c_str(), -1, &handle_, nullptr));
}

Statement::~Statement() { sqlite3_finalize(handle_); }

void Statement::check(int code) const {
  if (code != SQLITE_OK) database_.fail();
}

Statement& Statement::with(std::int64_t value) { return check(sqlite3_bind_int64(handle_, ++bound_, value)), *this; }

Statement& Statement::with(double value) {
  ++bound_;
  check(std::isnan(value) ? sqlite3_bind_null(handle_, bound_) : sqlite3_bind_double(handle_, bound_, value));
  return *this;
}

Statement& Statement::with(const std::string& value) {
  check(sqlite3_bind_text(handle_, ++bound_, value.c_str(), static_cast<int>(value.size()), SQLITE_TRANSIENT));
  return *this;
}

bool Statement::step() {
  const int code = sqlite3_step(handle_);
  if (code != SQLITE_ROW && code != SQLITE_DONE) database_.fail();
  return code == SQLITE_ROW;
}

bool Statement::is_null(int column) const { return sqlite3_column_type(handle_, column) == SQLITE_NULL; }
std::int64_t Statement::integer(int column) const { return sqlite3_column_int64(handle_, column); }
double Statement::real(int column) const {
  return is_null(column) ? std::numeric_limits<double>::quiet_NaN() : sqlite3_column_double(handle_, column);
}
std::string Statement::text(int column) const {
  const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(handle_, column));
  return bytes ? std::string(bytes, static_cast<std::size_t>(sqlite3_column_bytes(handle_, column))) : "";
}

Transaction::~Transaction() {
  if (!database_) return;
  try {
    database_->run("ROLLBACK");
  } catch (const Error&) {  // the error that brought us here has ended it already
  }
}

void Transaction::commit() {
  database_->run("COMMIT");
  database_ = nullptr;
}

}  // namespace muster::sweep
