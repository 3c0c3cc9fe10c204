#include "diagnosis/inference/state/smooths.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "diagnosis/radio/links/moving_end.hpp"

namespace muster::inference {
namespace {

Eigen::VectorXd scaled(const Eigen::VectorXd& x) {
  const double low = x.minCoeff(), range = x.maxCoeff() - low;
  return range > 0 ? Eigen::VectorXd((x.array() - low) / range) : Eigen::VectorXd::Zero(x.size()).eval();
}

Eigen::MatrixXd cosines(const Eigen::VectorXd& x, int functions) {
  const Eigen::VectorXd u = scaled(x);
  Eigen::MatrixXd result(x.size(), functions);
  for (int j = 1; j <= functions; ++j) result.col(j - 1) = (M_PI * j * u.array()).cos();
  return result;
}

Eigen::MatrixXd harmonics_of(const Eigen::VectorXd& angle, int harmonics) {
  Eigen::MatrixXd result(angle.size(), 2 * harmonics);
  for (int j = 1; j <= harmonics; ++j) {
    result.col(2 * j - 2) = (j * angle.array()).cos();
    result.col(2 * j - 1) = (j * angle.array()).sin();
  }
  return result;
}

Candidate smooth(std::vector<std::string> covariates, std::function<Eigen::MatrixXd(int)> wider, bool grows = true) {
  Candidate c;
  c.id = "~" + covariates.front();
  c.kind = Kind::smooth;
  c.covariates = std::move(covariates);
  c.width = static_cast<int>(wider(1).cols());
  c.grid = {Eigen::VectorXd()};
  c.columns = [wider](const Eigen::VectorXd&) { return wider(1); };
  if (grows) c.wider = std::move(wider);
  return c;
}

// One of several shapes along a covariate, by its theta, `width` functions each.
Candidate shaped(const std::string& id, const std::string& covariate, int width,
                 std::function<Eigen::MatrixXd(const Eigen::VectorXd&)> columns) {
  Candidate c;
  c.id = id;
  c.kind = Kind::smooth;
  c.covariates = {covariate};
  c.width = width;
  c.columns = std::move(columns);
  return c;
}

// The same functions for one level of a factor at a time.
Candidate smooth_by_level(const std::string& name, const std::vector<int>& level, const Eigen::MatrixXd& functions) {
  Candidate c = shaped("~" + name, name, static_cast<int>(functions.cols()), [=](const Eigen::VectorXd& theta) {
    Eigen::MatrixXd result = functions;
    for (Index i = 0; i < result.rows(); ++i) {
      if (level[static_cast<std::size_t>(i)] != static_cast<int>(theta[0])) result.row(i).setZero();
    }
    return result;
  });
  for (const int k : std::set<int>(level.begin(), level.end())) c.grid.push_back(Eigen::VectorXd::Constant(1, k));
  c.label = [name](const Eigen::VectorXd& theta) { return name + "/" + std::to_string(static_cast<int>(theta[0])); };
  return c;
}

Candidate factor(const std::string& name, const std::vector<int>& level) {
  Candidate c = smooth_by_level(name, level, Eigen::MatrixXd::Ones(static_cast<Index>(level.size()), 1));
  c.observed = true;
  return c;
}

// Flat up to a bend and straight beyond it, to either side (Friedman 1991): one function where a smooth needs five.
Candidate bend(const std::string& name, const Eigen::VectorXd& values) {
  constexpr int bends = 9;
  Candidate c = shaped("bend~" + name, name, 1, [values](const Eigen::VectorXd& theta) {
    return Eigen::MatrixXd((theta[1] * (values.array() - theta[0])).max(0.0).matrix());
  });
  c.observed = true;
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const auto quantile = [&](int k) { return sorted[(sorted.size() - 1) * static_cast<std::size_t>(k) / bends]; };
  for (int k = 0; k < bends; ++k) {
    c.grid.push_back(Eigen::Vector2d(quantile(k), 1));
    if (k > 0) c.grid.push_back(Eigen::Vector2d(quantile(bends - k), -1));  // from the end on it is the same line
  }
  return c;
}

// From -1 to 1.
Eigen::ArrayXd signed_scale(const Eigen::VectorXd& x) { return 2 * scaled(x).array() - 1; }
Eigen::ArrayXd centred(const Eigen::ArrayXd& x) { return x - x.mean(); }

Candidate with_distance(const std::string& name, const Eigen::VectorXd& values, const Eigen::VectorXd& log_distance) {
  return smooth(
      {name + "*logd", name, "logd"},
      [=](int) {
        const Eigen::ArrayXd z = centred(signed_scale(values)), d = signed_scale(log_distance);
        Eigen::MatrixXd result(values.size(), 3);
        result << z * centred(d), z * d * d, z * z * d;
        return result;
      },
      false);
}

Candidate with_position(const std::string& name, const Eigen::VectorXd& values, const Eigen::MatrixXd& place) {
  return smooth(
      {name + "*position", name, "position"},
      [=](int) {
        const Eigen::ArrayXd z = centred(signed_scale(values)), x = signed_scale(place.col(0)),
                             y = signed_scale(place.col(1));
        Eigen::MatrixXd result(values.size(), 5);
        result << z * x, z * y, z * x * y, z * x * x, z * y * y;
        return result;
      },
      false);
}

// Products of cosines over the place's range: a half-waves along x and b along y, a / (high + 1) + b / (across + 1)
// < 1.
Eigen::MatrixXd surface(const Eigen::MatrixXd& place, int high, int across) {
  const Eigen::MatrixXd x = cosines(place.col(0), high), y = cosines(place.col(1), across);
  const Eigen::ArrayXd flat = Eigen::ArrayXd::Ones(place.rows());
  Eigen::MatrixXd result(place.rows(), 0);
  for (int a = 0; a <= high; ++a) {
    for (int b = 0; b <= across; ++b) {
      if (a + b == 0 || a * (across + 1) + b * (high + 1) >= (high + 1) * (across + 1)) continue;
      result.conservativeResize(Eigen::NoChange, result.cols() + 1);
      result.rightCols(1) = ((a ? x.col(a - 1).array() : flat) * (b ? y.col(b - 1).array() : flat)).matrix();
    }
  }
  return result;
}

Candidate by_position(const Eigen::MatrixXd& place) {
  return smooth(
      {"position"}, [place](int) { return surface(place, 5, 3); }, false);
}

// What bends no more than once over the plan: a field can swallow it, and few functions see it sooner than many.
Candidate slope_over_position(const Eigen::MatrixXd& place) {
  Candidate c = smooth(
      {"position"}, [place](int) { return surface(place, 2, 2); }, false);
  c.id = "slope~position";
  c.slow = true;
  return c;
}

struct Geometry {
  MovingEnds moving;
  Eigen::VectorXd log_distance, from_tx;

  explicit Geometry(const noise::Readings& r) : moving(moving_ends(r)), from_tx(r.size()) {
    const Eigen::Matrix3Xd to_rx = r.rx_at - r.tx_at;
    log_distance = to_rx.colwise().norm().transpose().cwiseMax(0.5).array().log10();
    for (Index i = 0; i < r.size(); ++i) from_tx[i] = std::atan2(to_rx(1, i), to_rx(0, i));
  }
};

std::vector<int> links(const noise::Readings& readings) {
  std::map<std::pair<int, int>, int> number;
  for (std::size_t i = 0; i < readings.tx.size(); ++i) number.try_emplace({readings.tx[i], readings.rx[i]}, 0);
  int next = 0;
  for (auto& [link, k] : number) k = next++;
  std::vector<int> result;
  for (std::size_t i = 0; i < readings.tx.size(); ++i) result.push_back(number.at({readings.tx[i], readings.rx[i]}));
  return result;
}

// A swing whose pace changes steadily from one end of the data to the other: no period, though it swings. Theta: cycles
// in all, and how many more of them the second half has.
Candidate chirp(const Eigen::VectorXd& time) {
  constexpr double cycles_apart = 0.5, change_apart = 0.5, slowest = 1, fastest = 14;  // cycles over the data
  Candidate c = shaped("chirp~time", "time", 2, [u = scaled(time)](const Eigen::VectorXd& theta) {
    const Eigen::ArrayXd turns = 2 * M_PI * (theta[0] * u.array() - 2 * theta[1] * u.array() * (1 - u.array()));
    Eigen::MatrixXd result(u.size(), 2);
    result << turns.cos().matrix(), turns.sin().matrix();
    return result;
  });
  for (double cycles = 2; cycles <= 9; cycles += cycles_apart) {
    for (double change = 0.75; change <= 3; change += change_apart) {
      for (const double sign : {-1.0, 1.0}) {
        if (cycles - 2 * change >= slowest && cycles + 2 * change <= fastest)
          c.grid.push_back(Eigen::Vector2d(cycles, sign * change));
      }
    }
  }
  return c;
}

void add_time(const Problem& problem, const Geometry& geometry, std::vector<Candidate>& out) {
  const auto& t = problem.readings.t;
  if (t.empty()) return;
  const Eigen::VectorXd time = Eigen::Map<const Eigen::VectorXd>(t.data(), static_cast<Index>(t.size()));
  for (Candidate c : {smooth_of("time", time, 10), chirp(time)}) {
    c.time_like = true;
    out.push_back(std::move(c));
  }
  out.push_back(smooth_by_level("time_per_tx", problem.readings.tx, cosines(time, 5)));
  if (problem.places_known) out.push_back(with_position("time", time, geometry.moving.place));
}

}  // namespace

Candidate smooth_of(const std::string& name, const Eigen::VectorXd& values, int functions) {
  return smooth({name}, [=](int times) { return cosines(values, functions * times); });
}

Candidate smooth_of_angle(const std::string& name, const Eigen::VectorXd& angle, int harmonics) {
  return smooth({name}, [=](int times) { return harmonics_of(angle, harmonics * times); });
}

std::vector<Candidate> smooths_of(const Problem& problem) {
  const noise::Readings& readings = problem.readings;
  const Geometry geometry(readings);
  std::vector<Candidate> result;
  result.push_back(smooth_of("logd", geometry.log_distance, 6));
  result.back().level_like = true;
  if (!(readings.rx_yaw.empty() && readings.tx_yaw.empty())) {
    if (problem.places_known) result.push_back(smooth_of_angle("bearing", geometry.moving.bearing, 4));
    result.push_back(smooth_of_angle("heading", geometry.moving.heading, 3));
  }
  if (problem.places_known) {
    result.push_back(smooth_by_level("txbearing", readings.tx, harmonics_of(geometry.from_tx, 3)));
    result.push_back(by_position(geometry.moving.place));
    result.push_back(slope_over_position(geometry.moving.place));
  }
  add_time(problem, geometry, result);
  result.push_back(factor("link", links(readings)));
  for (const Factor& f : problem.factors) result.push_back(factor(f.name, f.level));
  for (const Covariate& c : problem.covariates) {
    result.push_back(c.angle ? smooth_of_angle(c.name, c.values, (c.functions + 1) / 2)
                             : smooth_of(c.name, c.values, c.functions));
    result.back().observed = true;
    if (c.angle) continue;
    result.push_back(bend(c.name, c.values));
    if (!c.products) continue;
    result.push_back(with_distance(c.name, c.values, geometry.log_distance));
    if (problem.places_known) result.push_back(with_position(c.name, c.values, geometry.moving.place));
  }
  return result;
}

}  // namespace muster::inference
