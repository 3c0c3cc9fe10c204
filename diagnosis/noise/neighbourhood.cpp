#include "diagnosis/noise/neighbourhood.hpp"

#include <cmath>

namespace muster::noise {
namespace {

constexpr double floor_variance = 1e-3;  // dB^2: readings are at best quantised to 0.1 dB
constexpr double least_variance = 1e-9;  // dB^2: of rows at one place

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace

Neighbourhood::Neighbourhood(const Field& field, const Covariance& covariance)
    : field_(field),
      slots_(field.slots()),
      field_variance_(covariance.field_variance()),
      reading_variance_(covariance.reading_variance()),
      root_(at(slots_ * slots_)),
      cross_(at(slots_)),
      nugget_(at(slots_ + 1)),
      present_(at(slots_)),
      combination_(at(slots_ + 1)) {
  const double share = covariance.shared(), s2 = field_variance_;
  for (Table* table : {&near_, &joint_, &near_by_distance_, &joint_by_distance_, &near_by_share_, &joint_by_share_})
    table->assign(Field::distances + 1, 0.0);
  for (std::size_t k = 0; k < Field::distances; ++k) {
    const double distance = static_cast<double>(k) * field.spacing();
    const double u = softened(covariance.family, distance, field.sites().soft) / covariance.decorrelation();
    const double value = correlation(covariance.family, u), slope = correlation_slope(covariance.family, u);
    near_[k] = s2 * share * value;
    joint_[k] = s2 * (1 - share) * value;
    near_by_distance_[k] = s2 * share * slope;
    joint_by_distance_[k] = s2 * (1 - share) * slope;
    near_by_share_[k] = s2 * share * (1 - share) * value;
    joint_by_share_[k] = -near_by_share_[k];
  }
  for (auto& vectors : {&turned_, &slope_}) {
    for (auto& vector : *vectors) vector.resize(at(slots_ + 1));
  }
}

Lanes Neighbourhood::looked_up(const Table& near, const Table& joint, Index group, Index pair) const {
  const uint16_t* const n = field_.near(group) + pair * Field::lanes;
  const uint16_t* const j = field_.joint(group) + pair * Field::lanes;
  Lanes result;
  for (Index lane = 0; lane < Field::lanes; ++lane) result[lane] = near[n[lane]] + joint[j[lane]];
  return result;
}

void Neighbourhood::own_variances(Index group) {
  for (Index lane = 0; lane < Field::lanes; ++lane) {
    const Index i = std::min(group * Field::lanes + lane, field_.size() - 1);
    for (Index a = 0; a < slots_; ++a) {
      const Index j = field_.neighbour(i, static_cast<int>(a));
      const bool here = j >= 0 && group * Field::lanes + lane < field_.size();
      present_[at(a)][lane] = here;
      nugget_[at(a)][lane] = here ? reading_variance_ / field_.sites().count[j] : 0.0;
    }
    nugget_[at(slots_)][lane] = reading_variance_ / field_.sites().count[i];
  }
}

void Neighbourhood::factorise(Index group) {
  own_variances(group);
  for (Index a = 0; a < slots_; ++a) {
    for (Index b = 0; b < a; ++b) {
      Lanes s = looked_up(near_, joint_, group, a * (a + 1) / 2 + b);
      for (Index k = 0; k < b; ++k) s -= root(a, k) * root(b, k);
      root(a, b) = s * root(b, b);
    }
    Lanes s = present_[at(a)] * (field_variance_ + floor_variance - 1) + 1 + nugget_[at(a)];
    for (Index k = 0; k < a; ++k) s -= root(a, k) * root(a, k);
    root(a, a) = s.max(least_variance).sqrt().inverse();
    cross_[at(a)] = looked_up(near_, joint_, group, a * (a + 1) / 2 + a);
  }
  Lanes variance = field_variance_ + floor_variance + nugget_[at(slots_)];
  for (Index a = 0; a < slots_; ++a) {
    for (Index k = 0; k < a; ++k) cross_[at(a)] -= root(a, k) * cross_[at(k)];
    cross_[at(a)] *= root(a, a);
    variance -= cross_[at(a)] * cross_[at(a)];
  }
  inverse_sd_ = variance.max(least_variance).sqrt().inverse();
  combination_[at(slots_)] = inverse_sd_;
  for (Index a = slots_ - 1; a >= 0; --a) {
    Lanes s = -cross_[at(a)] * inverse_sd_;
    for (Index k = a + 1; k < slots_; ++k) s -= root(k, a) * combination_[at(k)];
    combination_[at(a)] = s * root(a, a);
  }
}

// out = dC combination, for a derivative that is zero on the diagonal.
void Neighbourhood::times_derivative(const Table& near, const Table& joint, Index group,
                                     std::vector<Lanes>& out) const {
  for (Lanes& lanes : out) lanes.setZero();
  for (Index a = 0; a < slots_; ++a) {
    for (Index b = 0; b <= a; ++b) {
      const Index other = b < a ? b : slots_;
      const Lanes d = looked_up(near, joint, group, a * (a + 1) / 2 + b);
      out[at(a)] += d * combination_[at(other)];
      out[at(other)] += d * combination_[at(a)];
    }
  }
}

void Neighbourhood::solve_forward(std::vector<Lanes>& x) const {
  for (Index a = 0; a < slots_; ++a) {
    for (Index k = 0; k < a; ++k) x[at(a)] -= root(a, k) * x[at(k)];
    x[at(a)] *= root(a, a);
    x[at(slots_)] -= cross_[at(a)] * x[at(a)];
  }
  x[at(slots_)] *= inverse_sd_;
}

// The combination's derivative: minus L^-T times x with its last entry halved.
void Neighbourhood::solve_backward(const std::vector<Lanes>& x, std::vector<Lanes>& out) const {
  out[at(slots_)] = -0.5 * x[at(slots_)] * inverse_sd_;
  for (Index a = slots_ - 1; a >= 0; --a) {
    Lanes s = -x[at(a)] - cross_[at(a)] * out[at(slots_)];
    for (Index k = a + 1; k < slots_; ++k) s -= root(k, a) * out[at(k)];
    out[at(a)] = s * root(a, a);
  }
}

void Neighbourhood::differentiate(Index group) {
  times_derivative(near_by_distance_, joint_by_distance_, group, turned_[1]);
  times_derivative(near_by_share_, joint_by_share_, group, turned_[3]);
  for (Index a = 0; a <= slots_; ++a) turned_[2][at(a)] = nugget_[at(a)] * combination_[at(a)];
  for (const std::size_t p : {1, 2, 3}) solve_forward(turned_[p]);
  // C = field + nugget + floor, and L^-1 C L^-T e = e: the field's part is what the others leave.
  for (Index a = 0; a <= slots_; ++a) turned_[0][at(a)] = -floor_variance * combination_[at(a)];
  solve_forward(turned_[0]);
  turned_[0][at(slots_)] += 1;
  for (Index a = 0; a <= slots_; ++a) turned_[0][at(a)] -= turned_[2][at(a)];
  for (std::size_t p = 0; p < 4; ++p) {
    solve_backward(turned_[p], slope_[p]);
    log_slope_[p] = -0.5 * turned_[p][at(slots_)];
  }
}

Lanes Neighbourhood::information(std::size_t p, std::size_t q) const {
  Lanes sum = 0.5 * turned_[p][at(slots_)] * turned_[q][at(slots_)];
  for (Index a = 0; a < slots_; ++a) sum += turned_[p][at(a)] * turned_[q][at(a)];
  return sum;
}

}  // namespace muster::noise
