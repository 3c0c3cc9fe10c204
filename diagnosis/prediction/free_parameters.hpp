// Free parameters of a world: their declarations, bounds and, once fitted, their values with intervals.
#pragma once

#include "diagnosis/prediction/measured_world.hpp"

namespace muster::diagnosis {

struct FitOptions {
  std::vector<std::string> free;  // paths of parameters to free beyond the declared ones
  std::vector<std::string> fix;   // paths to hold, PATH or PATH=VALUE
};

struct FitParameter {
  std::string path, unit;
  double start = 0, lower = 0, upper = 0;  // as declared
  double value = 0;                        // by least squares; NaN if not identifiable
  double by_search = 0;                    // by the derivative-free search
  double stderror = 0, lower95 = 0, upper95 = 0, freedom = 0;
  bool identifiable = true, at_bound = false;
};

// The free parameters of a world, by declaration and options. Throws Error with the nearest path.
std::vector<FitParameter> free_parameters(MeasuredWorld& model, const FitOptions& options);

}  // namespace muster::diagnosis
