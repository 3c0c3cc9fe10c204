#include "job_table.hpp"

#include <fmt/core.h>

#include "text/error.hpp"

namespace muster::sweep {
namespace {

constexpr std::int64_t application = 0x6d737770;  // "mswp", by which the file is known as a job table
constexpr std::int64_t version = 2;

// begun counts how often a job was: once more for each worker that was killed in it. A second row of a job in `run` is
// refused by SQLite itself.
constexpr const char* schema = R"(
CREATE TABLE source (file TEXT PRIMARY KEY, digest TEXT NOT NULL) WITHOUT ROWID;
CREATE TABLE metric (number INTEGER PRIMARY KEY, name TEXT NOT NULL, unit TEXT NOT NULL);
CREATE TABLE worker (number INTEGER PRIMARY KEY AUTOINCREMENT);
CREATE TABLE job (number INTEGER PRIMARY KEY, combination INTEGER NOT NULL, seed INTEGER NOT NULL,
  label TEXT NOT NULL DEFAULT '', worker INTEGER REFERENCES worker, begun INTEGER NOT NULL DEFAULT 0, done INTEGER NOT NULL DEFAULT 0);
CREATE INDEX job_open ON job (done, begun, number);
CREATE TABLE run (job INTEGER PRIMARY KEY REFERENCES job, worker INTEGER NOT NULL REFERENCES worker,
  time REAL NOT NULL, digest TEXT NOT NULL, fault TEXT NOT NULL);
CREATE TABLE value (job INTEGER REFERENCES run, metric INTEGER REFERENCES metric, value REAL,
  PRIMARY KEY (job, metric)) WITHOUT ROWID;
)";

// Of a row of number, combination, seed, and in that column the label.
Job job_in(const Statement& row, int label) {
  return {row.integer(0), static_cast<std::size_t>(row.integer(1)), row.integer(2), row.text(label)};
}

std::filesystem::path made(std::filesystem::path folder) {
  std::filesystem::create_directories(folder);
  return folder;
}

}  // namespace

JobTable::JobTable(std::filesystem::path folder) : folder_(made(std::move(folder))), database_(folder_ / file_name) {
  Transaction making(database_);
  const auto is = database_.number("PRAGMA application_id");
  const bool is_empty = database_.number("SELECT count(*) FROM sqlite_master") == 0;
  if (is == 0 && is_empty) {
    database_.run(schema);
    database_.run(fmt::format("PRAGMA application_id = {}; PRAGMA user_version = {}", application, version));
  } else if (is != application || database_.number("PRAGMA user_version") != version) {
    throw Error(Exit::invalid_input, Place{(folder_ / file_name).string()},
                "is no table of this version's sweeps; expected another folder");
  }
  making.commit();
}

JobTable::~JobTable() = default;

bool JobTable::is_filled() { return database_.number("SELECT count(*) FROM source") > 0; }

void JobTable::fill(const Sources& sources, const std::vector<MetricTitle>& metrics, std::size_t combinations,
                    const std::vector<std::int64_t>& seeds) {
  Transaction filling(database_);
  if (is_filled()) return;
  for (const auto& [file, digest] : sources)
    Statement(database_, "INSERT INTO source VALUES (?, ?)").with(file).with(digest).step();
  for (std::size_t i = 0; i < metrics.size(); ++i) {
    Statement insert(database_, "INSERT INTO metric VALUES (?, ?, ?)");
    insert.with(static_cast<std::int64_t>(i)).with(metrics[i].name).with(metrics[i].unit).step();
  }
  std::int64_t number = 0;
  for (std::size_t combination = 0; combination < combinations; ++combination) {
    for (const std::int64_t seed : seeds) {
      Statement insert(database_, "INSERT INTO job (number, combination, seed) VALUES (?, ?, ?)");
      insert.with(number++).with(static_cast<std::int64_t>(combination)).with(seed).step();
    }
  }
  filling.commit();
}

void JobTable::add(const Sources& sources) {
  Transaction adding(database_);
  std::int64_t number = database_.number("SELECT count(*) FROM job");
  for (const auto& [name, digest] : sources) {
    if (Statement(database_, "SELECT 1 FROM source WHERE file = ?").with(name).step()) continue;
    Statement(database_, "INSERT INTO source VALUES (?, ?)").with(name).with(digest).step();
    Statement insert(database_, "INSERT INTO job (number, combination, seed, label) VALUES (?, ?, 0, ?)");
    insert.with(number).with(number).with(name).step();
    ++number;
  }
  adding.commit();
}

void JobTable::renew(const Sources& sources) {
  Transaction renewing(database_);
  for (const auto& [name, digest] : sources)
    Statement(database_, "UPDATE source SET digest = ? WHERE file = ?").with(digest).with(name).step();
  renewing.commit();
}

Sources JobTable::sources() {
  Sources result;
  Statement query(database_, "SELECT file, digest FROM source");
  while (query.step()) result[query.text(0)] = query.text(1);
  return result;
}

std::vector<MetricTitle> JobTable::metrics() {
  std::vector<MetricTitle> result;
  Statement query(database_, "SELECT name, unit FROM metric ORDER BY number");
  while (query.step()) result.push_back({query.text(0), query.text(1)});
  return result;
}

std::filesystem::path JobTable::lock_file(std::int64_t worker) const {
  return folder_ / "workers" / std::to_string(worker);
}

bool JobTable::is_held(std::int64_t worker) const {
  return worker == worker_ || WorkerLock::is_held(lock_file(worker));
}

void JobTable::register_worker() {
  Statement(database_, "INSERT INTO worker DEFAULT VALUES").step();
  worker_ = database_.last_row();
  alive_ = std::make_unique<WorkerLock>(lock_file(worker_));
}

std::optional<Job> JobTable::claim(const Share& share) {
  Transaction claiming(database_);
  if (worker_ == 0) register_worker();
  std::optional<Job> found;
  {
    std::map<std::int64_t, bool> lives;
    Statement query(database_,
                    "SELECT number, combination, seed, worker, label FROM job WHERE done = 0 AND number % ? = ? "
                    "ORDER BY begun, number");
    query.with(static_cast<std::int64_t>(share.of)).with(static_cast<std::int64_t>(share.index - 1));
    while (!found && query.step()) {
      const std::int64_t holder = query.integer(3);  // 0: none
      const auto [known, is_new] = lives.emplace(holder, false);
      if (is_new && holder != 0) known->second = is_held(holder);
      if (!known->second) found = job_in(query, 4);
    }
  }
  if (found) {
    Statement update(database_, "UPDATE job SET worker = ?, begun = begun + 1 WHERE number = ?");
    update.with(worker_).with(found->number).step();
  }
  claiming.commit();
  return found;
}

void JobTable::expect_mine(const Job& job) {
  Statement query(database_, "SELECT 1 FROM job WHERE number = ? AND worker = ? AND done = 0");
  if (!query.with(job.number).with(worker_).step())
    throw Error(Exit::internal, fmt::format("the claim of job {} is another worker's", job.number));
}

void JobTable::record(const Job& job, const RunResult& result) {
  Transaction recording(database_);
  expect_mine(job);
  Statement(database_, "INSERT INTO run VALUES (?, ?, ?, ?, ?)")
      .with(job.number)
      .with(worker_)
      .with(result.time)
      .with(result.digest)
      .with(result.fault)
      .step();
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    Statement insert(database_, "INSERT INTO value VALUES (?, ?, ?)");
    insert.with(job.number).with(static_cast<std::int64_t>(i)).with(result.values[i]).step();
  }
  Statement(database_, "UPDATE job SET done = 1, worker = NULL WHERE number = ?").with(job.number).step();
  recording.commit();
}

void JobTable::release(const Job& job) {
  Transaction releasing(database_);
  expect_mine(job);
  Statement(database_, "UPDATE job SET worker = NULL WHERE number = ?").with(job.number).step();
  releasing.commit();
}

Counts JobTable::counts(const Share& share) {
  Statement query(database_,
                  "SELECT count(*), coalesce(sum(done), 0), count(CASE WHEN fault <> '' THEN 1 END), "
                  "count(CASE WHEN done = 0 AND begun = 0 THEN 1 END) FROM job "
                  "LEFT JOIN run ON run.job = job.number WHERE number % ? = ?");
  query.with(static_cast<std::int64_t>(share.of)).with(static_cast<std::int64_t>(share.index - 1)).step();
  return {query.integer(0), query.integer(1), query.integer(2), query.integer(3)};
}

std::vector<Job> JobTable::left() {
  std::vector<Job> result;
  Statement query(database_,
                  "SELECT number, combination, seed, worker, label FROM job WHERE done = 0 AND worker IS NOT NULL "
                  "ORDER BY number");
  while (query.step()) {
    if (!is_held(query.integer(3))) result.push_back(job_in(query, 4));
  }
  return result;
}

void JobTable::reopen_if(const std::function<bool(const Job&)>& is_due) {
  Transaction reopening(database_);
  std::vector<std::int64_t> due;
  {
    Statement query(database_, "SELECT number, combination, seed, label FROM job WHERE done = 1");
    while (query.step()) {
      const Job job = job_in(query, 3);
      if (is_due(job)) due.push_back(job.number);
    }
  }
  for (const std::int64_t number : due) {
    Statement(database_, "DELETE FROM value WHERE job = ?").with(number).step();
    Statement(database_, "DELETE FROM run WHERE job = ?").with(number).step();
    Statement(database_, "UPDATE job SET done = 0, begun = 0, worker = NULL WHERE number = ?").with(number).step();
  }
  reopening.commit();
}

std::vector<DoneJob> JobTable::done() {
  std::vector<DoneJob> result;
  const std::size_t width = metrics().size();
  std::map<std::int64_t, std::vector<double>> values;
  Statement cells(database_, "SELECT job, metric, value FROM value");
  while (cells.step()) {
    auto& row = values.try_emplace(cells.integer(0), width, std::numeric_limits<double>::quiet_NaN()).first->second;
    row.at(static_cast<std::size_t>(cells.integer(1))) = cells.real(2);
  }
  Statement query(database_,
                  "SELECT number, combination, seed, label, time, digest, fault FROM job JOIN run ON run.job = "
                  "job.number ORDER BY number");
  while (query.step()) {
    DoneJob job;
    static_cast<Job&>(job) = job_in(query, 3);
    job.time = query.real(4);
    job.digest = query.text(5);
    job.fault = query.text(6);
    const auto row = values.find(job.number);
    job.values = row == values.end() ? std::vector(width, std::numeric_limits<double>::quiet_NaN()) : row->second;
    result.push_back(std::move(job));
  }
  return result;
}

}  // namespace muster::sweep
