// Worlds of the tests, with this build's plugins.
#pragma once

#include "diagnosis/calibration/fit.hpp"
#include "diagnosis/calibration/residual_scan.hpp"

namespace muster::diagnosis {

inline const Library::SearchPath plugins = {MUSTER_PLUGINS_DIR};
inline const std::filesystem::path source = MUSTER_SOURCE_DIR;
inline const std::filesystem::path hall = source / "worlds" / "hall";

inline const FitParameter& parameter(const Fit& fit, const std::string& path) {
  for (const FitParameter& p : fit.parameters) {
    if (p.path == path) return p;
  }
  throw std::runtime_error("no parameter " + path);
}

}  // namespace muster::diagnosis
