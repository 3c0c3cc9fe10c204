// Correlation of shadowing at two places: five families over one decorrelation distance.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>

namespace muster::noise {

enum class Family { exponential = 1, matern32, matern52, two_scale, gaussian };
inline constexpr std::array families{Family::exponential, Family::matern32, Family::matern52, Family::two_scale,
                                     Family::gaussian};

std::string_view name_of(Family family);

// At distance u, in decorrelation distances.
double correlation(Family family, double u);

// Its derivative by the logarithm of the decorrelation distance.
double correlation_slope(Family family, double u);

// The families differ in what they call a decorrelation distance: what to add to its logarithm beside the
// exponential's.
double log_scale_of(Family family);
// Whether it falls at once with distance. A field that does not hardly changes along a row.
bool is_rough(Family family);

// Distance in decorrelation distances at which the correlation falls to 1/e.
double efold(Family family);

// log variance of the field [dB^2], log decorrelation distance [m], log variance of one reading [dB^2], logit of the
// correlation that rows of different groups have at one place.
using Theta = Eigen::Vector4d;

struct Covariance {
  Family family = Family::exponential;
  Theta theta = Theta::Zero();

  double field_variance() const;    // dB^2
  double decorrelation() const;     // m
  double reading_variance() const;  // dB^2
  double shared() const;            // correlation between anchors, 0 to 1
};

// A field as a world states it, which names no family of correlations.
struct StatedField {
  double shadowing = 0, decorrelation = 0;  // dB, 0 where nothing is stated; m, at which correlation falls to 1/e
};
// `within` [m]: the mean distance of two readings of a row. A mean over them varies less than one reading does.
StatedField said_by(const Covariance& covariance, double within);
// The rest of theta from `beside`.
Covariance as_stated(const StatedField& field, Family family, const Theta& beside, double within);

}  // namespace muster::noise
