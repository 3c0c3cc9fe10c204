// Moves and priors of walls and things that are sought in a plan.
#pragma once

#include "diagnosis/causes/cause_shape.hpp"
#include "diagnosis/radio/links/measurement_geometry.hpp"

namespace muster::diagnosis {

// Number of times that a segment was driven across.
int driven_across(const MeasurementGeometry& geometry, double x, double y, double length, double angle);
// True where a way leads through the disk.
bool driven_through(const MeasurementGeometry& geometry, double x, double y, double radius);

inline constexpr double move_of_segment = 0.4;  // m, of its ends
// Moves of a segment: along and across, either end further out, about either end, each axis, and away from the nearest
// radio that stands, in whose shadow it then stays the same.
Eigen::MatrixXd moves_of_segment(const MeasurementGeometry& geometry, const Eigen::VectorXd& theta);
// Moves of a disk: east, north, wider; and for each of the two nearest radios that stand either edge of its shadow
// alone, and away from the radio, which leaves its shadow as it is.
Eigen::MatrixXd moves_of_disk(const MeasurementGeometry& geometry, const Eigen::VectorXd& theta);
// Prior log density of a segment's direction, nats: walls run along those of the plan, or across, within a fifth of a
// radian.
double belief_in_segment(const MeasurementGeometry& geometry, const Eigen::VectorXd& theta);

// Segments between the ends that lie farthest apart, of each pair of pieces; those of `id` are segments, others points.
std::vector<Eigen::VectorXd> spans(const std::vector<inference::Piece>& pieces, const std::string& id);

}  // namespace muster::diagnosis
