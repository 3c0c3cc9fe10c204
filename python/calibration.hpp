// A world held against measured readings, as JSON: the work of muster fit and muster diagnose.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "loader/library.hpp"

namespace muster::python {

struct FitWords {
  std::string world, data, out;  // out: a folder for figures, or ""
  std::vector<std::string> free, fix;
  double cell = 0.25;  // m
  int least = 5;       // readings of a cell
  bool power = false;  // cell means of power instead of dB
};

// Throws Error. docs/how-to/drive_from_python.md names the keys that matter.
std::string fit(const FitWords& words, const Library::SearchPath& plugins);

// `out`: a folder for the report and the extended world, which is diagnosed again; or "". `stopped` is called between
// steps and ends the search with what is known. Throws Error. docs/reference/diagnosis_format.md has the keys.
std::string diagnose(const std::string& world, const std::string& data, const std::string& out,
                     const Library::SearchPath& plugins, const std::function<bool()>& stopped);

// A line for each name over x, as SVG or, by the file's name, nothing else. Throws Error.
struct NamedLine {
  std::string name;
  std::vector<double> values;
};
void plot(const std::string& file, const std::vector<double>& x, const std::vector<NamedLine>& lines,
          const std::string& x_label, const std::string& y_label, const std::string& title);

}  // namespace muster::python
