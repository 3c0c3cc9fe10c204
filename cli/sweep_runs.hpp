// The runs of a sweep: what its file says of each combination, made and measured.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bundle/world_files.hpp"
#include "kernel/simulation.hpp"
#include "run_metrics.hpp"
#include "sweep/job_table.hpp"
#include "sweep/sweep_file.hpp"

namespace muster::cli {

class SweepRuns {
 public:
  SweepRuns(const sweep::SweepFile& file, Library::SearchPath plugins, int workers)
      : file_(file), plugins_(std::move(plugins)), workers_(workers) {}

  struct Checked {
    std::vector<sweep::MetricTitle> metrics;
    std::vector<std::filesystem::path> libraries;                // of plugins, sorted
    std::map<std::filesystem::path, bundle::WorldFiles> worlds;  // by their files as given: all that each reads
  };
  // Makes each combination once, up to its first tick: what is wrong with any of them is told before the first run.
  // Throws Error.
  Checked check();

  // A plugin's fault is part of the result. None: interrupted. Throws Error.
  std::optional<sweep::RunResult> run(const sweep::Job& job);

 private:
  struct TimedMetric {
    Metric metric;
    sweep::Over over;
    double so_far, ticks = 0;
    void look(const Simulation& run, const Positions& at_start);
    double value(const Simulation& run, const Positions& at_start) const;
  };

  World world_of(const std::vector<sweep::Word>& values);
  const std::vector<std::string>& instances_of(const World& world);
  std::string where_exchanged(const std::vector<sweep::Word>& values, const std::string& path) const;
  std::unique_ptr<Simulation> make(std::size_t combination, std::int64_t seed);
  std::vector<TimedMetric> metrics_of(const Simulation& run) const;

  const sweep::SweepFile& file_;
  Library::SearchPath plugins_;
  int workers_;
  std::map<std::filesystem::path, std::vector<std::string>> instances_;  // of worlds as they are given
};

}  // namespace muster::cli
