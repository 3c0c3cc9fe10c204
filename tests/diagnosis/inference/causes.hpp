// Simple causes over a synthetic world, in the form of an external author's.
#pragma once

#include "diagnosis/inference/state/problem.hpp"
#include "diagnosis/radio/links/link_smooths.hpp"
#include "tests/diagnosis/inference/synthetic.hpp"

namespace muster::synthetic {

// tx_offset, rx_offset, antenna_rx, antenna_tx, step, drift, periodic, dual_slope, room_clutter, unmapped_wall,
// obstacle.
std::vector<inference::Candidate> causes_of(const World& world);

// The world's speed, battery and temperature.
diagnosis::LinkColumns columns_of(const World& world);

// A problem with these candidates and the world's columns. `effect` (dB, one a reading) is added to the readings,
// which are then quantised to 1 dB. `run`: of each reading, empty where the data name none.
inference::Problem problem_of(const World& world, const Eigen::VectorXd& effect,
                              std::vector<inference::Candidate> causes, const diagnosis::LinkRowLimits& limits = {},
                              std::vector<int> run = {});

}  // namespace muster::synthetic
