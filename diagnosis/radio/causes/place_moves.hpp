// Search moves and priors of walls and obstacles in a plan.
#pragma once

#include "diagnosis/causes/cause_shape.hpp"
#include "diagnosis/radio/links/measurement_geometry.hpp"

namespace muster::diagnosis {

// The geometry with lengths in units of its scale.
MeasurementGeometry in_own_unit(MeasurementGeometry geometry);
// A theta with lengths in such units, or with `scale` inverted back in metres: of a point with a logarithm of a radius,
// or of a segment.
Eigen::VectorXd in_unit(PlaceShape place, Eigen::VectorXd theta, double scale);

// Number of driven paths that cross a segment.
int driven_across(const MeasurementGeometry& geometry, double x, double y, double length, double angle);
// True if a driven path leads through the disk, within 0.7 of its radius.
bool driven_through(const MeasurementGeometry& geometry, double x, double y, double radius);

inline constexpr double move_of_segment = 0.4;  // m, of its ends
// Moves of a segment: along and across it, either end outwards, rotation about either end, each axis. The last one
// moves it away from the nearest stationary radio and lengthens it, which keeps its shadow.
Eigen::MatrixXd moves_of_segment(const MeasurementGeometry& geometry, const Eigen::VectorXd& theta);
// Moves of a disk: east, north, wider. For each of the two nearest stationary radios: either edge of its shadow alone,
// and away from the radio with the shadow kept.
Eigen::MatrixXd moves_of_disk(const MeasurementGeometry& geometry, const Eigen::VectorXd& theta);
// Prior log density of a segment's direction, nats: normal about the plan's wall directions, sd 0.2 rad.
double belief_in_segment(const MeasurementGeometry& geometry, const Eigen::VectorXd& theta);

// For each pair of pieces, the segment between their two farthest ends. Pieces of `id` are segments, others points.
std::vector<Eigen::VectorXd> spans(const std::vector<inference::Piece>& pieces, const std::string& id);

}  // namespace muster::diagnosis
