// Over what a parameter of a cause is sought, from its declaration and from what was measured.
#pragma once

#include <optional>

#include "diagnosis/causes/cause_shape.hpp"
#include "diagnosis/radio/links/measurement_geometry.hpp"

namespace muster::diagnosis {

// `alone`: no other parameter is sought beside it, so that its grid may be fine. Nothing if the data cannot tell.
std::optional<Axis> axis_of(const muster_param& declared, const Survey& survey, const CauseShape& shape, bool alone);

// How often a segment was driven across.
int driven_across(const Survey& survey, double x, double y, double length, double angle);
// Whether a way leads through the disk.
bool driven_through(const Survey& survey, double x, double y, double radius);

inline constexpr double move_of_segment = 0.4;  // m, of its ends
// Moves of a segment: along and across, either end further out, about either end, each axis, and away from the nearest
// radio that stands, in whose shadow it then stays the same.
Eigen::MatrixXd moves_of_segment(const Survey& survey, const Eigen::VectorXd& theta);
// Moves of a disk: east, north, wider; and for each of the two nearest radios that stand either edge of its shadow
// alone, and away from the radio, which leaves its shadow as it is.
Eigen::MatrixXd moves_of_disk(const Survey& survey, const Eigen::VectorXd& theta);
// What is believed of a segment before the data, in nats: walls run along those of the plan, or across, but for a fifth
// of a radian.
double belief_in_segment(const Survey& survey, const Eigen::VectorXd& theta);

// Segments between the ends that lie farthest apart, of each pair of pieces; those of `id` are segments, others points.
std::vector<Eigen::VectorXd> spans(const std::vector<inference::Piece>& pieces, const std::string& id);

}  // namespace muster::diagnosis
