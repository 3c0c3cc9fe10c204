// The covariance of rows and their neighbours, factorised for eight rows side by side.
#pragma once

#include "diagnosis/inference/noise/row_kernel.hpp"
#include "diagnosis/inference/noise/vecchia.hpp"

namespace muster::noise {

constexpr double floor_variance = 1e-3;  // squared units, of every row: readings have steps of 0.1 at best

// One value for each of the eight rows.
struct alignas(alignment) Lanes {
  double of[lanes];
};

class Neighbourhood {
 public:
  // `slopes`: differentiate() will be called.
  Neighbourhood(const Field& field, const Covariance& covariance, bool slopes = true,
                const RowKernel& kernel = row_kernels().best());

  // Factorises the rows of one group. Slots without a neighbour hold an independent value of variance one and get
  // weight zero.
  void factorise(Index group);
  // Kriging weights, one a slot, then the row's own: (-weights of the best linear prediction, 1) over its standard
  // deviation.
  const Lanes* combination() const { return combination_.data(); }

  // After factorise(): derivatives by the four entries of theta.
  void differentiate() { kernel_.differentiate(arrays_); }
  const Lanes* slope(int parameter) const { return slope_.data() + parameter * (slots_ + 1); }
  // Derivative of the logarithm of the row's own weight.
  double log_slope(int parameter, int lane) const {
    return -0.5 * turned_[static_cast<std::size_t>(parameter) * static_cast<std::size_t>(slots_ + 1) +
                          static_cast<std::size_t>(slots_)]
                      .of[lane];
  }
  // Fisher information, q <= p.
  const Lanes& information(int p, int q) const {
    return information_[static_cast<std::size_t>(p) * parameters + static_cast<std::size_t>(q)];
  }

 private:
  void own_variances(Index group);
  void own_fields(Index group);
  void leave_alone(Index group);

  const Field& field_;
  const RowKernel& kernel_;
  Covariance covariance_;
  bool slopes_;
  Index slots_;
  double fixed_ = 0;  // share of the field's variance
  std::vector<double> correlation_, by_distance_;
  Eigen::VectorXd reading_variance_;  // of the rows' means
  std::vector<Lanes> nugget_, present_, own_field_, own_slope_, root_, cross_, combination_, turned_, slope_,
      information_;
  Neighbourhoods arrays_;
};

}  // namespace muster::noise
