// What the runs of a sweep depend on: its file, its worlds and the files that these name, the plugins and the program.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "loader/library.hpp"
#include "sweep/job_table.hpp"
#include "sweep/sweep_file.hpp"
#include "sweep_runs.hpp"

namespace muster::cli {

// Of a file's bytes, in hexadecimal digits; empty where it cannot be read.
std::string digest_of(const std::filesystem::path& file);

// Of all runs that were checked.
sweep::Sources sources_of(const sweep::SweepFile& file, const SweepRuns::Checked& checked,
                          const Library::SearchPath& plugins);

// Throws Error where one of them is another now than it was when the table in that folder was begun.
void expect_unchanged(const sweep::Sources& then, const sweep::SweepFile& file, const Library::SearchPath& plugins,
                      const std::filesystem::path& folder);

}  // namespace muster::cli
