// Rows of a table of named things, measured or recorded: a time, the row's name, numbers. The format of `run --record`.
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "kernel/blackboard.hpp"
#include "text/text_table.hpp"

namespace muster::diagnosis {

// Samples of one row of the table, at times that rise.
struct RecordedCourse {
  std::string row;
  std::vector<double> t;   // [s]
  Eigen::MatrixXd values;  // samples x columns
};

struct RecordedTable {
  std::string file;
  std::vector<TextColumn> columns;
  std::vector<std::size_t> cells;  // of the world's table, that of each column
  std::vector<RecordedCourse> courses;

  double turned = 0;  // of all courses together, by the column yaw[rad] as it stands; 0 without one
  Place yaw_at{};     // that column's

  double last() const;  // [s]
};

// Reads the columns that the table of the world has, too; of a turn about the vertical also yaw[rad] instead of qw to
// qz. Throws Error with the place: a column that is not there, a row that the world has not, time that does not rise, a
// course of fewer than two samples.
RecordedTable read_recorded(const std::filesystem::path& file, const Table& of_world);

}  // namespace muster::diagnosis
