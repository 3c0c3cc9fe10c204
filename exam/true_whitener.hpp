// Inverse of the true covariance of readings, which gives the lambda of an effect against shadowing and fading.
//
// Readings of one link within 0.4 m of travel form a row. First each row's mean is conditioned on 70 nearby earlier
// ones in random order (Vecchia 1988; Stein, Chi, Welty 2004). Then each reading of a row but one is conditioned on
// its own row's mean, on means of nearby rows and on nearby single readings. Means carry the wide structure of a
// station, single readings the narrow one. tests/exam compares with the dense covariance.
#pragma once

#include "exam/field.hpp"

namespace muster::exam {

// Variance of readings without shadowing: fading, channels, outliers, and 1/12 dB^2 of quantisation.
double reading_variance(const ReadingLaw& law);

// Rows alone, with fewer neighbours, suffice for a fit of few parameters that concern all readings.
enum class Detail { rows, readings };

class Whitener {
 public:
  // Uses the readings marked in `use`.
  Whitener(const Data& data, const Noise& noise, const std::vector<char>& use, Detail detail = Detail::readings);

  // Whitens columns over all readings: used readings become independent, of variance 1.
  Eigen::MatrixXd operator()(const Eigen::MatrixXd& columns) const;

  // dB, for each used reading: prediction error of its level from earlier readings, in the order of conditioning.
  std::vector<double> level_deviations() const;

 private:
  friend class FieldDivergence;

  // Mean over a row's readings, or a single reading.
  struct Mean {
    std::vector<int> readings;
    int station = 0;
    int row = 0;  // index of its row in means_
    Vec2 at;
    std::vector<Vec2> places;  // of some of its readings
  };
  struct Weights {
    std::vector<double> of;  // one for each neighbour, as in neighbours_
    double deviation = 1;    // dB, of the prediction error
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
  // Covariance of two means.
  double covariance(const Kernel& kernel, int one, int other) const;
  // Covariance matrix of a mean's neighbours and, last, of itself.
  Eigen::MatrixXd joint(const Kernel& kernel, int mean) const;
  static Weights weights(const Eigen::MatrixXd& joint);
  const Mean& mean(int k) const { return means_[static_cast<std::size_t>(k)]; }

  Noise noise_;
  double reading_variance_;
  std::size_t rows_ = 0;     // number of rows, at the front of means_
  std::vector<Mean> means_;  // in the order of conditioning
  std::vector<std::vector<int>> neighbours_;
  std::vector<Weights> weights_;
};

// 2 x the Kullback-Leibler divergence of a field law from the nearest of those stated, in the means of rows. Closer
// readings depend on the law of readings, which worlds declare only approximately.
class FieldDivergence {
 public:
  // `whitener` must outlive it.
  FieldDivergence(const Whitener& whitener, const std::vector<FieldLaw>& stated);
  double operator()(const FieldLaw& truth) const;

 private:
  const Whitener& whitener_;
  std::vector<std::vector<Whitener::Weights>> stated_;  // by law and row
};

// Whitened energy of `effect` left by the best fit of `others`, all over readings.
double energy(const Whitener& whiten, const Eigen::VectorXd& effect, const Eigen::MatrixXd& others);

}  // namespace muster::exam
