#include "diagnosis/inference/noise/neighbourhood.hpp"

#include <algorithm>

namespace muster::noise {
Neighbourhood::Neighbourhood(const Field& field, const Covariance& covariance, bool slopes, const RowKernel& kernel)
    : field_(field),
      kernel_(kernel),
      covariance_(covariance),
      slopes_(slopes),
      slots_(field.slots()),
      correlation_(3 * same_site),
      by_distance_(3 * same_site),
      reading_variance_(covariance.reading_variance() / field.sites().count.array()),
      nugget_(at(slots_ + 1)),
      present_(at(slots_)),
      own_field_(at(slots_ + 1)),
      own_slope_(at(slots_ + 1)),
      root_(at(slots_ * slots_)),
      cross_(at(slots_)),
      combination_(at(slots_ + 1)),
      turned_(at(parameters * (slots_ + 1))),
      slope_(at(parameters * (slots_ + 1))),
      information_(parameters * parameters) {
  const double s2 = covariance.field_variance();
  const bool stated = is_stated(covariance.family);
  fixed_ = fixed_share(covariance.family);
  for (std::size_t k = 0; k < distances; ++k) {
    const double u = static_cast<double>(k) * field.spacing() / covariance.decorrelation();
    const double value = stated ? StatedTables::correlation_of(k) : correlation(covariance.family, u);
    const double slope = stated ? value : correlation_slope(covariance.family, u);
    correlation_[k] = (1 - fixed_) * value;
    by_distance_[k] = (1 - fixed_) * slope;
    correlation_[same_site + k] = correlation_[k] + fixed_to_site(covariance.family);
    correlation_[2 * same_site + k] = correlation_[k] + fixed_;
    // The stated slope is a difference of two values, in which the fixed share cancels.
    by_distance_[same_site + k] = by_distance_[2 * same_site + k] = by_distance_[k];
  }
  // The stated correlation is interpolated between two decorrelation distances: each takes the place of one metric.
  const double share = stated ? 1 - StatedTables::position_of(covariance.theta[1]).weight : covariance.shared();
  const double per_step = s2 / StatedTables::step;
  for (Lanes& slot : own_field_) std::fill_n(slot.of, lanes, s2);  // of the families; its derivative is 0
  arrays_ = {slots_,
             correlation_.data(),
             by_distance_.data(),
             s2 * share,
             s2 * (1 - share),
             stated ? -per_step : s2 * share,
             stated ? per_step : s2 * (1 - share),
             stated ? 0 : s2 * share * (1 - share),
             floor_variance,
             nullptr,
             nullptr,
             nullptr,
             nugget_[0].of,
             present_[0].of,
             own_field_[0].of,
             own_slope_[0].of,
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

// Rows without a field: only their own readings' variance, whatever theta.
void Neighbourhood::leave_alone(Index group) {
  for (Index lane = 0; lane < lanes; ++lane) {
    const Index i = std::min(group * lanes + lane, field_.size() - 1);
    const bool alone = field_.sites().is_alone(i);
    if (alone) nugget_[at(slots_)].of[lane] = field_.sites().alone[at(i)] / field_.sites().count[i];
    if (alone) {
      own_field_[at(slots_)].of[lane] = 0;
    } else if (!is_stated(covariance_.family)) {
      own_field_[at(slots_)].of[lane] = covariance_.field_variance();
    }
  }
}

// Variance of the stated field at the slots and at the rows themselves.
void Neighbourhood::own_fields(Index group) {
  const double s2 = covariance_.field_variance();
  const auto [k, weight] = StatedTables::position_of(covariance_.theta[1]);
  const Eigen::VectorXf &low = field_.stated(k).own, &high = field_.stated(slopes_ || weight > 0 ? k + 1 : k).own;
  for (Index lane = 0; lane < lanes; ++lane) {
    const Index i = std::min(group * lanes + lane, field_.size() - 1);
    for (Index a = 0; a <= slots_; ++a) {
      const Index j = a < slots_ ? field_.neighbour(i, static_cast<int>(a)) : i;
      const double before = j < 0 ? 1 : static_cast<double>(low[j]), after = j < 0 ? 1 : static_cast<double>(high[j]);
      own_field_[at(a)].of[lane] = s2 * (fixed_ + (1 - fixed_) * ((1 - weight) * before + weight * after));
      own_slope_[at(a)].of[lane] = s2 * (1 - fixed_) * (after - before) / StatedTables::step;
    }
  }
}

void Neighbourhood::factorise(Index group) {
  own_variances(group);
  if (is_stated(covariance_.family)) own_fields(group);
  if (!field_.sites().alone.empty()) leave_alone(group);
  const Field::Entries entries = field_.entries(group, covariance_, slopes_);
  arrays_.near = entries.near;
  arrays_.joint = entries.joint;
  arrays_.kinds = entries.kinds;
  kernel_.factorise(arrays_);
}

}  // namespace muster::noise
