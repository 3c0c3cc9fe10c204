// Walls and things wherever in the plan they could stand: what each would gain, before any is refined.
#pragma once

#include "diagnosis/search/candidate.hpp"
#include "diagnosis/survey.hpp"

namespace muster::diagnosis {

// The ends of the readings that a tally speaks of.
using LinkEnds = std::vector<std::array<End, 2>>;

// Thetas of segments (no row, x, y, length, angle), the best first: on lines along the plan and a little aslant, a
// quarter of a metre apart, all pieces that no radio was driven across.
std::vector<Eigen::VectorXd> swept_segments(const Survey& survey, const LinkEnds& ends, search::Tally& tally);

// Of disks (no row, x, y, log radius), the best first: a few radii about places 0.4 m apart, clear of all ways.
std::vector<Eigen::VectorXd> swept_disks(const Survey& survey, const LinkEnds& ends, search::Tally& tally);

}  // namespace muster::diagnosis
