// A world asked what it expects to be measured: its channel, evaluated at the places and times of the readings by the
// code that a simulation runs.
#pragma once

#include <Eigen/Core>
#include <array>
#include <memory>
#include <set>

#include "kernel/simulation.hpp"

namespace muster::diagnosis {

// One end of a reading, as the channel saw it.
struct End {
  double x, y, z, yaw;
  int radio;  // row of the set `radio`
};

// Of a published table; valid as long as the view is.
using FirstColumn = Eigen::Map<const Eigen::VectorXd, 0, Eigen::InnerStride<>>;
FirstColumn first_column(const TableView& table);

// The instance that stands in for a world's links: data.links with the readings of `file`.
InstanceDeclaration measured_links(const std::filesystem::path& file, const Place& place);

class LinkModel {
 public:
  // The world with the readings of `data` in the place of its links. Throws Error.
  LinkModel(const std::filesystem::path& world, const std::filesystem::path& data, const Library::SearchPath& plugins);

  std::size_t rows() const { return ends_.size(); }
  // Row i's two ends, tx first.
  const std::vector<std::array<End, 2>>& ends() const { return ends_; }
  const std::vector<std::string>& radio_names() const;  // by row of the set `radio`
  std::string radio_name(int radio) const;
  // Radios of the readings that the world does not have, and that were added to it; no cause is about them.
  std::vector<std::string> added_radios() const;
  std::set<std::string> link_of(int one, int other) const;  // names of both, whichever sends

  // E[rssi in dBm] of every row.
  const Eigen::VectorXd& expected();
  // By how much it changes, dB, if every link is moved so far to either side: what hangs on how exactly the ends of
  // walls and the places of radios are known. Lengths and bearings stay.
  Eigen::VectorXd changes_aside(double metres);
  // One draw of the channel, NaN where nothing is received.
  Eigen::VectorXd drawn();
  // How often the channel was evaluated.
  int evaluations() const { return evaluations_; }

  std::vector<ParameterInfo> parameters() const { return run_->parameters(); }
  ParameterInfo parameter(const std::string& path) const { return run_->parameter(path); }
  void set(const std::string& path, double value) { run_->set_parameter(path, value); }

  const Simulation& simulation() const { return *run_; }
  Simulation& simulation() { return *run_; }
  // The named parameter's value of the first instance of a plugin, or `otherwise` where the world has none.
  double value_of(const std::string& plugin, const std::string& param, double otherwise) const;
  bool has_plugin(const std::string& plugin) const;

 private:
  void evaluate(bool expected);
  void read_ends();

  std::unique_ptr<Simulation> run_;
  Eigen::VectorXd values_;
  std::vector<std::array<End, 2>> ends_;
  int evaluations_ = 0;
};

}  // namespace muster::diagnosis
