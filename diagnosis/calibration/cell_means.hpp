// Means of measured and simulated readings over square cells of the floor, and their errors: the comparison of Fink
// et al., Fig. 3b to 3d.
#pragma once

#include <string>
#include <vector>

#include "diagnosis/calibration/fit.hpp"

namespace muster::diagnosis {

enum class Average { dB = 1, power };  // of dBm, or of power

struct CellOptions {
  double size = 0.25;  // m
  int least = 5;       // readings; cells with fewer are left out of the statistics
  Average average = Average::dB;
};

struct Cell {
  double x = 0, y = 0;                 // m, its centre
  double measured = 0, simulated = 0;  // dBm
  int count = 0;
};

// Cells of one stationary (or less mobile) radio, by the place of its partner.
struct CellMap {
  std::string radio;
  double x = 0, y = 0;  // m, its first place
  std::vector<Cell> cells;
};

struct CellErrors {
  std::vector<double> errors;  // dB, measured - simulated, for each cell with enough readings
  std::size_t few = 0;         // number of cells with fewer
  double mean = 0, sd = 0;
  std::vector<std::pair<double, double>> quantiles;  // 5, 25, 50, 75, 95 %
  double expected_sd = 0;                            // of cell means for independent errors of readings, dB
  std::vector<std::string> cannot_show;
};

// Cells of the received readings; `simulated` has one value a row of the data set.
std::vector<CellMap> cell_maps(const LinkModel& model, const Fit& fit, const Eigen::VectorXd& simulated,
                               const CellOptions& options);

CellErrors cell_errors(const std::vector<CellMap>& maps, const Fit& fit, const CellOptions& options);

}  // namespace muster::diagnosis
