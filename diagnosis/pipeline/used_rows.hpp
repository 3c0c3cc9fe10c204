// Rows of a table of readings that a search uses.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "diagnosis/data/dataset.hpp"
#include "diagnosis/radio/links/link_model.hpp"

namespace muster::diagnosis {

// Rows of the table used in the search, and notes on those left out.
struct UsedRows {
  std::vector<Eigen::Index> rows;
  std::vector<std::string> notes;
};

// Of the rows of a fit those that no burst has blocked: bursts at unknown times imitate any change in time. A link that
// the world declares as blocked now and then is left out. Where one of its radios has few other readings it stays
// without the readings that were probably blocked. `expected`: level of every row of the table, dBm. Throws Error if
// too few rows are left.
UsedRows used_rows(const LinkModel& model, const Dataset& data, const Eigen::VectorXd& expected,
                   const std::vector<std::size_t>& of_fit);

}  // namespace muster::diagnosis
