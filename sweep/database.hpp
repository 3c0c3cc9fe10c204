// SQLite, as far as a job table needs it: statements, transactions, and its errors as Error.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

struct sqlite3;
struct sqlite3_stmt;

namespace muster::sweep {

class Database {
 public:
  // Made where it is not there. Throws Error.
  explicit Database(const std::filesystem::path& file);
  ~Database();
  Database(const Database&) = delete;
  Database& operator=(const Database&) = delete;

  void run(const std::string& sql);
  std::int64_t number(const std::string& sql);  // of the first cell, 0 if there is none
  std::int64_t last_row() const;

 private:
  friend class Statement;
  [[noreturn]] void fail() const;
  void use_write_ahead_log();

  std::filesystem::path file_;
  sqlite3* handle_ = nullptr;
};

class Statement {
 public:
  Statement(Database& database, const std::string& sql);
  ~Statement();
  Statement(const Statement&) = delete;
  Statement& operator=(const Statement&) = delete;

  // The next '?' of it.
  Statement& with(std::int64_t value);
  Statement& with(double value);  // NaN is stored as NULL
  Statement& with(const std::string& value);
  // False: there is no row any more.
  bool step();

  bool is_null(int column) const;
  std::int64_t integer(int column) const;
  double real(int column) const;  // NULL is read as NaN
  std::string text(int column) const;

 private:
  void check(int code) const;

  Database& database_;
  sqlite3_stmt* handle_ = nullptr;
  int bound_ = 0;
};

// Holds the right to write from its beginning to its end; without commit() nothing of it remains.
class Transaction {
 public:
  explicit Transaction(Database& database) : database_(&database) { database.run("BEGIN IMMEDIATE"); }
  ~Transaction();
  Transaction(const Transaction&) = delete;
  Transaction& operator=(const Transaction&) = delete;
  void commit();

 private:
  Database* database_;
};

}  // namespace muster::sweep
