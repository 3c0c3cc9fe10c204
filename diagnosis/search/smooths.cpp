#include "diagnosis/search/smooths.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>

namespace muster::search {
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

// The same functions for one level of a factor at a time.
Candidate smooth_by_level(const std::string& name, const std::vector<int>& level, Eigen::MatrixXd functions) {
  Candidate c;
  c.id = "~" + name;
  c.kind = Kind::smooth;
  c.covariates = {name};
  c.width = static_cast<int>(functions.cols());
  std::set<int> levels(level.begin(), level.end());
  for (const int k : levels) c.grid.push_back(Eigen::VectorXd::Constant(1, k));
  const auto shared = std::make_shared<const Eigen::MatrixXd>(std::move(functions));
  const auto of = std::make_shared<const std::vector<int>>(level);
  c.columns = [shared, of](const Eigen::VectorXd& theta) {
    Eigen::MatrixXd result = *shared;
    for (Index i = 0; i < result.rows(); ++i) {
      if ((*of)[static_cast<std::size_t>(i)] != static_cast<int>(theta[0])) result.row(i).setZero();
    }
    return result;
  };
  c.label = [name](const Eigen::VectorXd& theta) { return name + "/" + std::to_string(static_cast<int>(theta[0])); };
  return c;
}

Candidate factor(const std::string& name, const std::vector<int>& level) {
  Candidate c = smooth_by_level(name, level, Eigen::MatrixXd::Ones(static_cast<Index>(level.size()), 1));
  c.observed = true;
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

Candidate by_position(const Eigen::MatrixXd& place) {
  return smooth(
      {"position"},
      [place](int) {
        const Eigen::MatrixXd x = cosines(place.col(0), 5), y = cosines(place.col(1), 3);
        Eigen::MatrixXd result(place.rows(), 23);
        Index k = 0;
        for (Index a = 0; a < 6; ++a) {
          for (Index b = 0; b < 4; ++b) {
            if (a + b == 0 || 2 * a + 3 * b > 12) continue;  // a / 6 + b / 4 <= 1
            result.col(k++) = (a ? Eigen::ArrayXd(x.col(a - 1)) : Eigen::ArrayXd::Ones(place.rows()).eval()) *
                              (b ? Eigen::ArrayXd(y.col(b - 1)) : Eigen::ArrayXd::Ones(place.rows()).eval());
          }
        }
        result.conservativeResize(Eigen::NoChange, k);
        return result;
      },
      false);
}

struct Geometry {
  Eigen::MatrixXd place;  // x, y of the receiver, one row a reading
  Eigen::VectorXd log_distance, bearing, from_tx;

  explicit Geometry(const noise::Readings& r)
      : place(r.rx_at.topRows(2).transpose()), bearing(r.size()), from_tx(r.size()) {
    const Eigen::Matrix3Xd to_tx = r.tx_at - r.rx_at;
    log_distance = to_tx.colwise().norm().transpose().cwiseMax(0.5).array().log10();
    for (Index i = 0; i < r.size(); ++i) {
      const double yaw = r.rx_yaw.empty() ? 0 : r.rx_yaw[static_cast<std::size_t>(i)];
      bearing[i] = std::atan2(to_tx(1, i), to_tx(0, i)) - yaw;
      from_tx[i] = std::atan2(-to_tx(1, i), -to_tx(0, i));
    }
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

void add_time(const Problem& problem, const Geometry& geometry, std::vector<Candidate>& out) {
  const auto& t = problem.readings.t;
  if (t.empty()) return;
  const Eigen::VectorXd time = Eigen::Map<const Eigen::VectorXd>(t.data(), static_cast<Index>(t.size()));
  out.push_back(smooth_of("time", time, 10));
  out.push_back(smooth_by_level("time_per_tx", problem.readings.tx, cosines(time, 5)));
  if (problem.places_known) out.push_back(with_position("time", time, geometry.place));
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
  if (!readings.rx_yaw.empty()) {
    if (problem.places_known) result.push_back(smooth_of_angle("bearing", geometry.bearing, 4));
    const Eigen::Map<const Eigen::VectorXd> yaw(readings.rx_yaw.data(), readings.size());
    result.push_back(smooth_of_angle("heading", yaw, 3));
  }
  if (problem.places_known) {
    result.push_back(smooth_by_level("txbearing", readings.tx, harmonics_of(geometry.from_tx, 3)));
    result.push_back(by_position(geometry.place));
  }
  add_time(problem, geometry, result);
  result.push_back(factor("link", links(readings)));
  for (const Factor& f : problem.factors) result.push_back(factor(f.name, f.level));
  for (const Covariate& c : problem.covariates) {
    result.push_back(c.angle ? smooth_of_angle(c.name, c.values, (c.functions + 1) / 2)
                             : smooth_of(c.name, c.values, c.functions));
    result.back().observed = true;
    if (c.angle || !c.products) continue;
    result.push_back(with_distance(c.name, c.values, geometry.log_distance));
    if (problem.places_known) result.push_back(with_position(c.name, c.values, geometry.place));
  }
  return result;
}

}  // namespace muster::search
