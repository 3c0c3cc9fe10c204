// The runs of a sweep as a table in SQLite: each is claimed by one worker at a time and recorded once, whoever is
// killed when. What the runs depend on is kept beside them, so that runs of something else are never mixed in.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "database.hpp"
#include "worker_lock.hpp"

namespace muster::sweep {

struct Job {
  std::int64_t number = 0;  // from 0; combination by combination
  std::size_t combination = 0;
  std::int64_t seed = 0;
  std::string label;  // of one that was added by its name
};

struct MetricTitle {
  std::string name, unit;
  std::string title() const { return unit.empty() ? name : name + " [" + unit + ']'; }
};

// What came of a job.
struct RunResult {
  double time = 0;  // s, simulated
  std::string digest;
  std::string fault;           // empty: none
  std::vector<double> values;  // of each metric; NaN where there is none
};

struct DoneJob : Job, RunResult {};

// Of `of` shares the one that takes each of-th job.
struct Share {
  int index = 1, of = 1;
};

struct Counts {
  std::int64_t all = 0, done = 0, failed = 0, untouched = 0;  // untouched: never begun
};

using Sources = std::map<std::string, std::string>;  // name of a file and its digest

class JobTable {
 public:
  static constexpr const char* file_name = "sweep.sqlite";

  // In that folder, which is made. Throws Error.
  explicit JobTable(std::filesystem::path folder);
  ~JobTable();

  bool is_filled();
  // Nothing is done where another has filled it meanwhile.
  void fill(const Sources& sources, const std::vector<MetricTitle>& metrics, std::size_t combinations,
            const std::vector<std::int64_t>& seeds);
  // A job for each of these sources that the table has not, called by its name.
  void add(const Sources& sources);
  // Sources that the table has, with other digests.
  void renew(const Sources& sources);
  Sources sources();
  std::vector<MetricTitle> metrics();

  // A job of the share that nobody does: open, or left by a worker that is no more. Those that were never begun come
  // first, so that one that crashes its workers holds up no other. None: all are done or being done.
  std::optional<Job> claim(const Share& share);
  // Of the claimed job. Throws Error where it is not this worker's, so that no job is recorded twice.
  void record(const Job& job, const RunResult& result);
  void release(const Job& job);
  // Done jobs that are to be done again are those that `is_due` is true of. It is asked while no other process changes
  // the table, and does not use it.
  void reopen_if(const std::function<bool(const Job&)>& is_due);

  Counts counts(const Share& share = {});
  // Claimed by workers that are no more.
  std::vector<Job> left();
  // Those that are done, by number.
  std::vector<DoneJob> done();
  // `write` alone, of all processes that use this table.
  template <class Write>
  void exclusively(Write&& write) {
    Transaction alone(database_);
    write();
  }

 private:
  void register_worker();
  bool is_held(std::int64_t worker) const;
  std::filesystem::path lock_file(std::int64_t worker) const;
  void expect_mine(const Job& job);

  std::filesystem::path folder_;
  Database database_;
  std::int64_t worker_ = 0;  // 0: has claimed nothing yet
  std::unique_ptr<WorkerLock> alive_;
};

}  // namespace muster::sweep
