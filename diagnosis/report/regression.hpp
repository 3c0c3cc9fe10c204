// Regression test of a finding: checks that the extended world, or one in which nothing is named, still explains its
// own data.
#pragma once

#include <filesystem>

#include "diagnosis/report/words.hpp"
#include "kernel/simulation.hpp"

namespace muster::report {

// Copies the data beside the extended world in `folder`, unless they are there, and writes regression.json and
// replay.xml. Where nothing is named, it copies the world as given there, and writes no replay.xml. Nothing of an
// interrupted diagnosis: what it did not look at, no test may claim. Returns the files. Throws Error.
std::vector<std::string> write_regression(const Diagnosis& diagnosis, const std::filesystem::path& world,
                                          const std::filesystem::path& data, const std::filesystem::path& folder);

struct Checked {
  std::string what, found, expected;
  bool passed = false;
};

// `from`: a regression.json, or its folder. Throws Error if it cannot be read or its world does not run.
std::vector<Checked> check_regression(const std::filesystem::path& from, const Library::SearchPath& plugins);

}  // namespace muster::report
