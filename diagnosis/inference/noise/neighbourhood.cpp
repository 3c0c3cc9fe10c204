#include "diagnosis/inference/noise/neighbourhood.hpp"

#include <algorithm>

namespace muster::noise {
namespace {

constexpr double least_variance = 1e-9;  // squared units of a reading: of rows at one place

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

Neighbourhood::Neighbourhood(const Field& field, const Covariance& covariance, const RowKernel& kernel)
    : field_(field),
      kernel_(kernel),
      family_(covariance.family),
      slots_(field.slots()),
      correlation_(distances + 1),
      by_distance_(distances + 1),
      reading_variance_(covariance.reading_variance() / field.sites().count.array()),
      nugget_(at(slots_ + 1)),
      present_(at(slots_)),
      root_(at(slots_ * slots_)),
      cross_(at(slots_)),
      combination_(at(slots_ + 1)),
      turned_(at(parameters * (slots_ + 1))),
      slope_(at(parameters * (slots_ + 1))),
      information_(parameters * parameters) {
  for (std::size_t k = 0; k < distances; ++k) {
    const double u = static_cast<double>(k) * field.spacing() / covariance.decorrelation();
    correlation_[k] = correlation(covariance.family, u);
    by_distance_[k] = correlation_slope(covariance.family, u);
  }
  const double s2 = covariance.field_variance(), share = covariance.shared();
  arrays_ = {slots_,
             correlation_.data(),
             by_distance_.data(),
             s2 * share,
             s2 * (1 - share),
             s2 * share * (1 - share),
             s2,
             least_variance,
             floor_variance,
             nullptr,
             nullptr,
             nullptr,
             nugget_[0].of,
             present_[0].of,
             root_[0].of,
             cross_[0].of,
             combination_[0].of,
             {},
             {},
             information_[0].of};
  for (Index p = 0; p < parameters; ++p) {
    arrays_.turned[p] = turned_[at(p * (slots_ + 1))].of;
    arrays_.slope[p] = slope_[at(p * (slots_ + 1))].of;
  }
}

void Neighbourhood::own_variances(Index group) {
  for (Index lane = 0; lane < lanes; ++lane) {
    const Index i = std::min(group * lanes + lane, field_.size() - 1);
    for (Index a = 0; a < slots_; ++a) {
      const Index j = field_.neighbour(i, static_cast<int>(a));
      const bool here = j >= 0 && group * lanes + lane < field_.size();
      present_[at(a)].of[lane] = here;
      nugget_[at(a)].of[lane] = here ? reading_variance_[j] : 0.0;
    }
    nugget_[at(slots_)].of[lane] = reading_variance_[i];
  }
}

void Neighbourhood::factorise(Index group) {
  own_variances(group);
  const Field::Entries entries = field_.entries(group, family_);
  arrays_.near = entries.near;
  arrays_.joint = entries.joint;
  arrays_.kinds = entries.kinds;
  kernel_.factorise(arrays_);
}

}  // namespace muster::noise
