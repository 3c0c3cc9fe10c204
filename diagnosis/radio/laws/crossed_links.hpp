// People who cross links: one that is blocked now and then, or any of a standing network.
#pragma once

#include <set>
#include <string>

#include "diagnosis/radio/laws/law_sources.hpp"

namespace muster::diagnosis {

// What people who cross links leave to the tests of single readings.
struct Crossed {
  std::set<std::string> link;  // ends of the one that is blocked now and then; none if no one is
  bool all = false;            // they may cross any link
};

// Names the blocked link, or people who walk about in a standing network.
Crossed add_blockage(const LawSources& sources, const Eigen::VectorXd& residual, Diagnosis& found);

}  // namespace muster::diagnosis
