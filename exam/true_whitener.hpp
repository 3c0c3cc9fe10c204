// The true covariance of readings, inverted: what an effect weighs against shadowing and fading.
//
// Readings of one link within 0.4 m of way form a row. First the rows' means are conditioned each on 70 nearby earlier
// ones in random order (Vecchia 1988; Stein, Chi, Welty 2004), then each reading but one of a row on its own row's
// mean, on those of rows nearby and on single readings nearby: means tell what is the same over a station, single
// readings what is narrow. tests/exam compares with the dense covariance.
#pragma once

#include "exam/field.hpp"

namespace muster::exam {

// Of readings without shadowing: fading, channels, outliers, and 1/12 dB^2 of quantisation.
double reading_variance(const ReadingLaw& law);

// Rows alone, by fewer neighbours, do for a fit of few parameters that touch all readings.
enum class Detail { rows, readings };

class Whitener {
 public:
  // For the readings with `use`.
  Whitener(const Data& data, const Noise& noise, const std::vector<char>& use, Detail detail = Detail::readings);

  // Columns over all readings; what is told of those in use becomes independent, of variance 1.
  Eigen::MatrixXd operator()(const Eigen::MatrixXd& columns) const;

  // dB, of each reading in use: how well its level is known from the readings before it, in the order of conditioning.
  std::vector<double> level_deviations() const;

 private:
  friend class FieldDivergence;

  // A mean of readings: of a row, or of one reading alone.
  struct Mean {
    std::vector<int> readings;
    int station = 0;
    int row = 0;  // whose readings they are: its place among means_
    Vec2 at;
    std::vector<Vec2> places;  // of some of its readings
  };
  struct Weights {
    std::vector<double> of;  // one a neighbour, as in neighbours_
    double deviation = 1;    // dB, of what the neighbours leave
  };
  struct Kernel {
    explicit Kernel(const FieldLaw& of) : law(of), table(of) {}
    FieldLaw law;
    CorrelationTable table;
  };

  static Mean mean_of(const Data& data, std::vector<int> readings);
  void gather_rows(const Data& data, const std::vector<char>& use);
  void add_single_readings(const Data& data);
  void find_neighbours(Detail detail);
  // Of two means.
  double covariance(const Kernel& kernel, int one, int other) const;
  // Of a mean's neighbours and, last, of itself.
  Eigen::MatrixXd joint(const Kernel& kernel, int mean) const;
  static Weights weights(const Eigen::MatrixXd& joint);
  const Mean& mean(int k) const { return means_[static_cast<std::size_t>(k)]; }

  Noise noise_;
  double reading_variance_;
  std::size_t rows_ = 0;     // the first of the means
  std::vector<Mean> means_;  // in the order of conditioning
  std::vector<std::vector<int>> neighbours_;
  std::vector<Weights> weights_;
};

// 2 x the Kullback-Leibler divergence of a law of the field from the nearest of those stated, in the means of rows:
// what closer readings tell of it hangs on the law of readings, which nobody states exactly.
class FieldDivergence {
 public:
  // `whitener` has to outlive it.
  FieldDivergence(const Whitener& whitener, const std::vector<FieldLaw>& stated);
  double operator()(const FieldLaw& truth) const;

 private:
  const Whitener& whitener_;
  std::vector<std::vector<Whitener::Weights>> stated_;  // by law and row
};

// Energy of `effect` after the best fit of `others`, all over readings.
double energy(const Whitener& whiten, const Eigen::VectorXd& effect, const Eigen::MatrixXd& others);

}  // namespace muster::exam
