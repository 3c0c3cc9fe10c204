// Predicts measured readings from a world: expected values and draws, by the simulator's own code.
#pragma once

#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "kernel/simulation.hpp"

namespace muster::diagnosis {

// First column of a published table; valid as long as the view.
using FirstColumn = Eigen::Map<const Eigen::VectorXd, 0, Eigen::InnerStride<>>;
FirstColumn first_column(const TableView& table);

// Tables and phase by which a kind of measurement is predicted.
struct Observable {
  uint32_t phase = 0;            // after which the prediction is complete
  std::string terms;             // table that causes add to, such as "link/*/level"
  std::string measured;          // table compared with measurements, such as "link/*/rssi"
  InstanceDeclaration stand_in;  // instance whose rows are the readings of the measured table
  const Standard* sets = &standard();
};

class MeasuredWorld {
 public:
  // `options` without the stand-in, which comes first. Throws Error.
  MeasuredWorld(World world, Options options, Observable observable);
  virtual ~MeasuredWorld() = default;
  MeasuredWorld(const MeasuredWorld&) = delete;
  MeasuredWorld& operator=(const MeasuredWorld&) = delete;

  const Observable& observable() const { return observable_; }
  const std::shared_ptr<TableCache>& tables() const { return tables_; }  // files already read, for further worlds
  std::vector<std::shared_ptr<Library>> libraries() const;               // those of its instances, likewise
  std::size_t rows() const { return static_cast<std::size_t>(values_.size()); }  // readings
  // Expected value of every reading.
  const Eigen::VectorXd& expected();
  // One draw of every reading, NaN where nothing is measured.
  Eigen::VectorXd drawn();
  // Number of evaluations so far.
  int evaluations() const { return evaluations_; }

  std::vector<ParameterInfo> parameters() const { return run_->parameters(); }
  ParameterInfo parameter(const std::string& path) const { return run_->parameter(path); }
  void set(const std::string& path, double value) { run_->set_parameter(path, value); }

  const Simulation& simulation() const { return *run_; }
  Simulation& simulation() { return *run_; }

 private:
  void evaluate(bool expected);

  Observable observable_;
  std::shared_ptr<TableCache> tables_;
  std::unique_ptr<Simulation> run_;
  Eigen::VectorXd values_;
  int evaluations_ = 0;
};

// Moves parameters; the destructor restores their values before.
class ParameterGuard {
 public:
  explicit ParameterGuard(MeasuredWorld& world) : world_(world) {}
  ~ParameterGuard();
  ParameterGuard(const ParameterGuard&) = delete;
  ParameterGuard& operator=(const ParameterGuard&) = delete;

  void set(const std::string& path, double value);

 private:
  MeasuredWorld& world_;
  std::vector<std::pair<std::string, double>> before_;  // in the order of their first change
};

}  // namespace muster::diagnosis
