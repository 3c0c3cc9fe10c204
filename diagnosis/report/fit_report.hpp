// A world fitted to measured readings, scanned for misfit, as JSON and as text.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "diagnosis/calibration/cell_means.hpp"
#include "diagnosis/calibration/residual_scan.hpp"
#include "text/json.hpp"

namespace muster::report {

class FitReport {
 public:
  // Reads, fits and scans. `progress` is called with the share that is done, 0 to 1. Throws Error.
  FitReport(
      const std::filesystem::path& world, const std::filesystem::path& data, const Library::SearchPath& plugins,
      const diagnosis::FitOptions& options, const diagnosis::CellOptions& cells,
      const std::function<void(double)>& progress = [](double) {});

  const diagnosis::Fit& fit() const { return fit_; }
  const Simulation& simulation() const { return model_.simulation(); }
  // Writes the figures of the fit to a folder; json() and print() list them.
  void draw(const std::filesystem::path& folder);
  Json json() const;
  void print() const;

 private:
  Json cells_json() const;

  diagnosis::CellOptions options_;
  diagnosis::Dataset data_;
  diagnosis::LinkModel model_;
  diagnosis::Fit fit_;
  diagnosis::ResidualScan misfit_;
  std::vector<diagnosis::CellMap> maps_;
  diagnosis::CellErrors errors_;
  std::vector<std::filesystem::path> pictures_;
};

}  // namespace muster::report
