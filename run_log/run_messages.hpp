// What a log holds of a run, in its order: the scene, what sensors saw, then the recorded tables. The same for a file
// and for clients that watch.
#pragma once

#include <vector>

#include "run_log/scene_log.hpp"
#include "run_log/sensor_log.hpp"
#include "run_log/table_log.hpp"

namespace muster::run_log {

class RunMessages {
 public:
  RunMessages(const Simulation& run, const std::vector<RecordDeclaration>& tables, mcap::Sink& sink)
      : tables_(tables, sink), scene_(run, sink), sensors_(sink) {}

  // Call before the first tick and after each.
  void write(const Simulation& run) {
    scene_.write(run);
    sensors_.write(run);
    tables_.write(run);
  }

 private:
  TableLog tables_;
  SceneLog scene_;
  SensorLog sensors_;
};

}  // namespace muster::run_log
