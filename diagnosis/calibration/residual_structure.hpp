// Structure found in a residual along one covariate, and along all.
#pragma once

#include <string>
#include <vector>

namespace muster::diagnosis {

// A range of a covariate, or one of its names.
struct Bin {
  std::string name;         // "wall/w7", "anchor2"; empty for a range
  double from = 0, to = 0;  // of the covariate
  double rows = 0;
  double mean = 0, stderror = 0;  // dB: measured - simulated
};

// Test along one covariate.
struct StructureTest {
  std::string by, unit;
  double p = 1;         // p-value, with shared errors of neighbouring readings
  int columns = 0;      // number of shapes
  double explains = 0;  // share of the residual's variance explained by these shapes
  bool alarm = false;
  std::vector<Bin> bins{};
  std::string where{};  // the largest of them, as text
};

struct ResidualScan {
  std::vector<StructureTest> looks;     // by share of variance explained, the largest first
  bool shared_allowed = true;           // true if the tests allow for shared errors of neighbours
  std::vector<std::string> not_tested;  // each with its reason
  bool misfits = false;
};

}  // namespace muster::diagnosis
