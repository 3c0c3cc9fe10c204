// Noise of plugins fitted to what was measured: the standard deviations with which a world's runs scatter about its run
// without noise as the measured rows do.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "diagnosis/prediction/free_parameters.hpp"
#include "diagnosis/replicates/noise_checks.hpp"
#include "kernel/simulation.hpp"

namespace muster::diagnosis {

struct NoiseParameter {
  std::string path, unit;
  double start = 0, value = 0, lower95 = 0, upper95 = 0, freedom = 0;
  bool at_bound = false;
};

struct NoiseFit {
  std::vector<NoiseParameter> parameters;
  std::vector<std::string> held;      // free, but of no effect on the table's scatter
  std::vector<std::string> left_out;  // kinds of pieces that noise moves too little
  std::vector<NoiseCheck> checks;
  std::vector<std::string> doubts;  // a sentence each
  std::size_t noiseless = 0;        // pieces that the world leaves without noise, such as of a robot at rest
  int runs = 0;
};

// `table`: of named rows, such as "robot/*/odometry". Free are those declared so and those of `options`. Throws Error:
// where the table is drawn also with all of them at 0, or where none of them moves it.
NoiseFit fit_noise(const World& world, const Options& running, const std::string& table,
                   const std::filesystem::path& data, const FitOptions& options);

}  // namespace muster::diagnosis
