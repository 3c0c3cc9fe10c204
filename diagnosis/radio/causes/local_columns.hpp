// Evaluates walls and obstacles only at readings whose links pass near them.
#pragma once

#include "diagnosis/radio/causes/simulated_readings.hpp"

namespace muster::diagnosis {

// Simulates these readings.
using Simulate = std::function<std::shared_ptr<SimulatedReadings>(const LinkReadings&)>;

// Columns of a wall or obstacle, bit for bit the cause's own, and cheaper at thetas such as these, of which there is at
// least one. Returns the cause's own if most links pass there, or if it affects any that does not.
std::function<Eigen::MatrixXd(const Eigen::VectorXd&)> columns_near(const std::vector<Eigen::VectorXd>& thetas,
                                                                    const CauseCandidate& cause,
                                                                    const LinkReadings& readings,
                                                                    const Simulate& simulate);

}  // namespace muster::diagnosis
