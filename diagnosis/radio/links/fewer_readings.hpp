// The world with a part of its readings: a model that costs less where no more are asked for.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "diagnosis/radio/links/link_model.hpp"

namespace muster::diagnosis {

struct FewerReadings {
  std::unique_ptr<LinkModel> model;
  std::vector<Eigen::Index> rows;  // of it: those asked for
};

// `table`: from which `all` was made; `rows`: of it, in its order. Those that tell which radios there are and which of
// them stand are kept beside them: of each radio the first that it sends and hears, and the farthest from its first
// place. None where that is more than half of all, or where the world does not run with these.
std::optional<FewerReadings> with_fewer_readings(const LinkModel& all, const std::filesystem::path& table,
                                                 const std::vector<Eigen::Index>& rows);

}  // namespace muster::diagnosis
