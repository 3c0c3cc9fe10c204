// What stands in the plan, asked of the readings whose links come near it.
#pragma once

#include "diagnosis/radio/causes/simulated_readings.hpp"

namespace muster::diagnosis {

// As many readings, simulated.
using Simulate = std::function<std::shared_ptr<SimulatedReadings>(const LinkReadings&)>;

// Columns of a wall or a thing that are the cause's own to the last bit, wherever it stands, but for less near `theta`.
// The cause's own where most links come near, or where it concerns any that does not.
std::function<Eigen::MatrixXd(const Eigen::VectorXd&)> columns_near(const Eigen::VectorXd& theta,
                                                                    const CauseCandidate& cause,
                                                                    const LinkReadings& readings,
                                                                    const Simulate& simulate);

}  // namespace muster::diagnosis
