// Runs of the world itself at the places and times of its readings, with other seeds: what the world as it is would
// have measured. Null distributions of tests are made of them.
#pragma once

#include <map>
#include <string>

#include "diagnosis/inference/noise/family.hpp"
#include "diagnosis/radio/links/link_model.hpp"

namespace muster::diagnosis {

struct WorldDraw {
  Eigen::VectorXd drawn, expected;  // dBm, of every reading; NaN where nothing is measured
};

class WorldDraws {
 public:
  // `step`: dB between the levels that the data record; 0: all are. `floors`: levels by path that the data refute, and
  // others instead.
  WorldDraws(std::filesystem::path world, std::filesystem::path data, Library::SearchPath plugins,
             std::shared_ptr<TableCache> tables, double step, std::map<std::string, double> floors);

  // `values`: parameters by path; `field`: of its shadowing, as declared if it has no size. Throws Error.
  WorldDraw draw(uint64_t number, const std::map<std::string, double>& values, const noise::StatedField& field) const;

 private:
  std::filesystem::path world_, data_;
  Library::SearchPath plugins_;
  std::shared_ptr<TableCache> tables_;
  double step_;
  std::map<std::string, double> floors_;
};

}  // namespace muster::diagnosis
