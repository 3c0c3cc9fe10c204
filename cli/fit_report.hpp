// A fit as JSON and as text.
#pragma once

#include "diagnosis/calibration/cell_means.hpp"
#include "diagnosis/calibration/residual_scan.hpp"
#include "text/json.hpp"

namespace muster::cli {

struct FitReport {
  const diagnosis::LinkModel& model;
  const diagnosis::Dataset& data;
  const diagnosis::Fit& fit;
  const diagnosis::ResidualScan& misfit;
  const std::vector<diagnosis::CellMap>& maps;
  const diagnosis::CellErrors& errors;
  const diagnosis::CellOptions& options;
  std::vector<std::filesystem::path> pictures;

  Json json() const;
  void print() const;
};

}  // namespace muster::cli
