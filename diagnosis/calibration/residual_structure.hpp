// Structure left in a residual along one covariate, and along all of them.
#pragma once

#include <string>
#include <vector>

namespace muster::diagnosis {

// A part of a covariate's range, or one of its names.
struct Bin {
  std::string name;         // "wall/w7", "anchor2"; empty for a range
  double from = 0, to = 0;  // of the covariate
  double rows = 0;
  double mean = 0, stderror = 0;  // dB: measured - simulated
};

// One covariate, looked along.
struct Look {
  std::string by, unit;
  double p = 1;         // that chance does it, errors of neighbouring readings being alike
  int columns = 0;      // shapes tried
  double explains = 0;  // share of the residual's variance that these shapes take up
  bool alarm = false;
  std::vector<Bin> bins{};
  std::string where{};  // of the largest of them, in words
};

struct Misfit {
  std::vector<Look> looks;              // by what they explain, most first
  bool shared_allowed = true;           // whether looks allow for errors that neighbours share
  std::vector<std::string> not_tested;  // and why
  bool misfits = false;
};

}  // namespace muster::diagnosis
