// The true covariance of readings, inverted: what an effect weighs against shadowing and fading.
//
// Readings of one link within 0.4 m of way form a row. Deviations from the row's mean are taken as independent; the
// rows' means, whose covariances are averages over pairs of readings, are whitened by conditioning each on 35 nearby
// earlier ones in random order (Vecchia 1988; Stein, Chi, Welty 2004). tests/exam compares with the dense covariance.
#pragma once

#include "field.hpp"

namespace muster::exam {

// Of readings without shadowing: fading, channels, outliers, and 1/12 dB^2 of quantisation.
double reading_variance(const ReadingLaw& law);

class Whitener {
 public:
  // For the readings with `use`.
  Whitener(const Data& data, const Noise& noise, const std::vector<char>& use);

  // Columns over all readings; those in use become independent, of variance 1.
  Eigen::MatrixXd operator()(const Eigen::MatrixXd& columns) const;

  // dB, of each reading in use: how well its level is known from the readings before it, in the order of conditioning.
  std::vector<double> level_deviations() const;

  // 2 x the Kullback-Leibler divergence between two laws of the field, truth against stated.
  double field_lambda(const FieldLaw& truth, const FieldLaw& stated) const;

  std::size_t rows() const { return rows_.size(); }

 private:
  struct Row {
    Vec2 at;
    int station = 0;
    std::vector<int> readings;
    std::vector<Vec2> places;  // of some of its readings
    double within = 0;         // dB^2, of a reading's deviation from the row's mean
  };
  struct Weights {
    std::vector<double> of;  // one a neighbour, as in neighbours_
    double deviation = 1;    // dB, of what the neighbours leave
  };

  void settle(const Data& data, Row& row) const;
  void gather(const Data& data, const std::vector<char>& use);
  void find_neighbours();
  struct Kernel {
    explicit Kernel(const FieldLaw& of) : law(of), table(of) {}
    FieldLaw law;
    CorrelationTable table;
  };
  static double covariance(const Kernel& kernel, const Row& a, const Row& b);
  double nugget(const Row& row) const { return reading_variance_ / static_cast<double>(row.readings.size()); }
  Weights weights(const Kernel& kernel, std::size_t row) const;

  Noise noise_;
  double reading_variance_;
  std::vector<Row> rows_;  // in the order of conditioning
  std::vector<std::vector<int>> neighbours_;
  std::vector<Weights> weights_;
};

// Energy of `effect` after the best fit of `others`, all over readings.
double energy(const Whitener& whiten, const Eigen::VectorXd& effect, const Eigen::MatrixXd& others);

}  // namespace muster::exam
