// Correlation of the field at two places: five families over one decorrelation distance, and the one that a model
// states itself (stated_correlation.hpp). The exponential and the stated one come also with a share that is fixed at a
// site (recurring_sites.hpp): rows of one site, or of one stream there, have it in common, and no others. Multipath is
// such a share where nothing moves.
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>

namespace muster::noise {

enum class Family { exponential = 1, matern32, matern52, two_scale, gaussian, stated };
// Those of one distance.
inline constexpr std::array families{Family::exponential, Family::matern32, Family::matern52, Family::two_scale,
                                     Family::gaussian};

std::string name_of(Family family);

// Shares that may be fixed, of the field's variance.
inline constexpr std::array fixed_shares{0.03, 0.1, 0.3, 0.6, 0.9, 0.97, 0.99};
// Parts of a fixed share that may be that of one stream, and of no other at the site.
inline constexpr std::array stream_parts{0.0, 1.0, 0.03, 0.1, 0.3};
// A family with the k-th of these shares fixed at a site, of which the `part`-th part is a stream's own.
Family with_fixed(Family family, std::size_t k, std::size_t part);
Family without_fixed(Family family);
// With the next lower or higher share; the family itself if there is none, or it has no share.
Family with_less_fixed(Family family);
Family with_more_fixed(Family family);
// The same share, of which the next lower or higher part is a stream's own; of none and all the family itself.
Family with_less_of_stream(Family family);
Family with_more_of_stream(Family family);
// Share of the field's variance fixed at a site, and the part of it that is that of one stream there, 0 to 1.
double fixed_share(Family family);
double stream_part(Family family);
// Share that any two rows of a site have in common; two of one stream have all that is fixed.
inline double fixed_to_site(Family family) { return (1 - stream_part(family)) * fixed_share(family); }
// True for the stated correlation, with a fixed share or without.
bool is_stated(Family family);

// Correlation at distance u, in decorrelation distances, beside the fixed share. Not of a stated one.
double correlation(Family family, double u);

// Its derivative by the logarithm of the decorrelation distance.
double correlation_slope(Family family, double u);

// Offset of the family's log decorrelation distance from the exponential's: the families define that distance
// differently.
double log_scale_of(Family family);
// True if the correlation falls linearly at distance 0. A smooth field hardly changes along a row.
bool is_rough(Family family);

// Distance in decorrelation distances at which the correlation falls to 1/e.
double efold(Family family);

// log variance of the field [squared units of a reading], log decorrelation distance [m], log variance of one reading
// [squared units], logit of the correlation that rows of different groups have at one place.
using Theta = Eigen::Vector4d;

struct Covariance {
  Family family = Family::exponential;
  Theta theta = Theta::Zero();

  double field_variance() const;    // squared units of a reading
  double decorrelation() const;     // m
  double reading_variance() const;  // squared units of a reading
  double shared() const;            // correlation between anchors, 0 to 1

  bool operator==(const Covariance& other) const { return family == other.family && theta == other.theta; }
};

// A field as a model states it, without a family of correlations.
struct StatedField {
  double shadowing = 0, decorrelation = 0;  // units of a reading, 0: not stated; m, to a correlation of 1/e
};
// The stated field equivalent to a fitted one. `within` [m]: mean distance of two readings of a row, whose mean
// varies less than one reading does.
StatedField stated_by(const Covariance& covariance, double within);
// The covariance of a stated field, with the rest of theta from `beside`.
Covariance as_stated(const StatedField& field, Family family, const Theta& beside, double within);

}  // namespace muster::noise
