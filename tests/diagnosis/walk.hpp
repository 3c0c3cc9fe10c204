// A robot on a straight path that receives from one station: readings of known law, field and bursts.
#pragma once

#include <cmath>
#include <muster/random.hpp>

#include "diagnosis/radio/links/link_rows.hpp"

namespace muster::diagnosis {

struct Truth {
  double rician_k = 6, outliers = 0, channel_sd = 0, noise = 0;  // dB; channels: two; noise: normal
};

// With exponential shadowing of 3 dB.
struct Walk {
  LinkReadings readings;
  Eigen::VectorXd residual;  // dB, integers
};

inline Walk drawn(const Truth& truth, int count, double decorrelation = 1.5, int station = 0) {
  Walk result;
  result.readings.tx_at = Eigen::Matrix3Xd::Zero(3, count);
  result.readings.rx_at.resize(3, count);
  result.residual.resize(count);
  const Stream random(combined(key_of("law test"), uint64_t{3} + static_cast<uint64_t>(station)));
  const double k = std::pow(10, truth.rician_k / 10), steady = std::sqrt(k / (1 + k)),
               diffuse = std::sqrt(0.5 / (1 + k));
  constexpr double apart = 0.15, shadowing = 3;  // m, dB
  const double kept = std::exp(-apart / decorrelation);
  double level = shadowing * random.normal(0, 100);
  for (int i = 0; i < count; ++i) {
    const auto row = static_cast<uint64_t>(i);
    result.readings.t.push_back(0.4 * i);
    result.readings.tx.push_back(station);
    result.readings.rx.push_back(9);
    result.readings.rx_at.col(i) << apart * i, 0, 0;
    level = kept * level + shadowing * std::sqrt(1 - kept * kept) * random.normal(row, 101);
    const double re = steady + diffuse * random.normal(row, 0), im = diffuse * random.normal(row, 1);
    double db = 10 * std::log10(re * re + im * im);
    if (random.uniform(row, 2) < truth.outliers) db += 40 * random.uniform(row, 3) - 20;
    if (truth.channel_sd > 0) db += random.uniform(row, 4) < 0.5 ? truth.channel_sd : -truth.channel_sd;
    db += truth.noise * random.normal(row, 5);
    result.residual[i] = std::round(level + db);
  }
  result.residual.array() -= result.residual.mean();
  return result;
}

// Four stations at one place, each with a field of its own.
inline Walk drawn_of_four(const Truth& truth, int count, double decorrelation, int first = 0) {
  Walk all = drawn(truth, count, decorrelation, first);
  for (int station = first + 1; station < first + 4; ++station) {
    const Walk more = drawn(truth, count, decorrelation, station);
    const Eigen::Index from = all.residual.size();
    for (auto list : {&LinkReadings::tx, &LinkReadings::rx})
      (all.readings.*list)
          .insert((all.readings.*list).end(), (more.readings.*list).begin(), (more.readings.*list).end());
    all.readings.t.insert(all.readings.t.end(), more.readings.t.begin(), more.readings.t.end());
    for (auto at : {&LinkReadings::tx_at, &LinkReadings::rx_at}) {
      (all.readings.*at).conservativeResize(3, from + count);
      (all.readings.*at).rightCols(count) = more.readings.*at;
    }
    all.residual.conservativeResize(from + count);
    all.residual.tail(count) = more.residual;
  }
  return all;
}

}  // namespace muster::diagnosis
