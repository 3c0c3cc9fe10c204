// Runs of a world that differ by seed and parameters, each seen as pieces of the courses that were recorded.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>

#include "diagnosis/replicates/pieces.hpp"
#include "diagnosis/replicates/recorded_table.hpp"
#include "kernel/simulation.hpp"

namespace muster::diagnosis {

class Replicates {
 public:
  // Runs go on until the last recorded time. Throws Error, also where that is after the end of the world's run.
  Replicates(World world, Options options, std::string table, const std::filesystem::path& data);

  const RecordedTable& recorded() const { return recorded_; }
  const PieceMaker& pieces() const { return pieces_; }
  // Of each piece, in the order of courses.
  const Eigen::VectorXd& measured() const { return measured_; }
  // Whether two pieces of a kind are of one course and follow one another.
  bool follows(Eigen::Index before, Eigen::Index piece) const;
  std::vector<ParameterInfo> parameters() const { return at_start_->parameters(); }
  ParameterInfo parameter(const std::string& path) const { return at_start_->parameter(path); }

  // A run with these parameters, those of a map before others of the world. Between two ticks a sample is interpolated.
  Eigen::VectorXd run(uint64_t seed, const std::map<std::string, double>& parameters);
  int runs() const { return runs_; }

 private:
  World world_;
  Options options_;
  std::string table_;
  std::unique_ptr<Simulation> at_start_;  // its libraries serve all runs
  RecordedTable recorded_;
  PieceMaker pieces_;
  Eigen::VectorXd measured_;
  std::vector<Eigen::Index> course_of_;  // of each piece
  int runs_ = 0;
};

}  // namespace muster::diagnosis
