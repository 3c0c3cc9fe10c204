#include "diagnosis/inference/state/smooths.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace muster::inference {
namespace {

Eigen::VectorXd scaled(const Eigen::VectorXd& x) {
  const double low = x.minCoeff(), range = x.maxCoeff() - low;
  return range > 0 ? Eigen::VectorXd((x.array() - low) / range) : Eigen::VectorXd::Zero(x.size()).eval();
}

}  // namespace

bool is_time(std::string_view covariate) {
  return covariate == "time" || covariate.starts_with("time*") || covariate.starts_with("time_per_");
}

Eigen::MatrixXd cosines(const Eigen::VectorXd& x, int functions) {
  const Eigen::VectorXd u = scaled(x);
  Eigen::MatrixXd result(x.size(), functions);
  for (int j = 1; j <= functions; ++j) result.col(j - 1) = (M_PI * j * u.array()).cos();
  return result;
}

Eigen::MatrixXd harmonics_of(const Eigen::VectorXd& angle, int harmonics) {
  const auto known = angle.array().isFinite().cast<double>();
  const Eigen::ArrayXd of = angle.array().isFinite().select(angle.array(), 0);
  Eigen::MatrixXd result(angle.size(), 2 * harmonics);
  for (int j = 1; j <= harmonics; ++j) {
    result.col(2 * j - 2) = known * (j * of).cos();
    result.col(2 * j - 1) = (j * of).sin();
  }
  return result;
}

namespace {

// `columns` gives `times` as many functions. Theta is empty, or `times` where they are more.
Candidate smooth(std::vector<std::string> covariates, std::function<Eigen::MatrixXd(int times)> columns,
                 bool grows = true) {
  Candidate c;
  c.id = "~" + covariates.front();
  c.kind = Kind::smooth;
  c.covariates = std::move(covariates);
  const auto times = [](int k) { return Eigen::VectorXd::Constant(1, k); };
  c.design.width = static_cast<int>(columns(1).cols());
  c.design.grid = {Eigen::VectorXd()};
  if (grows) c.design.wider = {times(2), times(4)};
  c.design.columns = [columns = std::move(columns)](const Eigen::VectorXd& theta) {
    return columns(theta.size() == 0 ? 1 : static_cast<int>(theta[0]));
  };
  return c;
}

// A candidate with one of several shapes along a covariate, by its theta; `width` functions each.
Candidate shaped(const std::string& id, const std::string& covariate, int width,
                 std::function<Eigen::MatrixXd(const Eigen::VectorXd&)> columns) {
  Candidate c;
  c.id = id;
  c.kind = Kind::smooth;
  c.covariates = {covariate};
  c.design.width = width;
  c.design.columns = std::move(columns);
  return c;
}

// Scaled to [-1, 1].
Eigen::ArrayXd signed_scale(const Eigen::VectorXd& x) { return 2 * scaled(x).array() - 1; }
Eigen::ArrayXd centred(const Eigen::ArrayXd& x) { return x - x.mean(); }

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

}  // namespace

Candidate smooth_of(const std::string& name, const Eigen::VectorXd& values, int functions) {
  return smooth({name}, [=](int times) { return cosines(values, functions * times); });
}

Candidate smooth_of_angle(const std::string& name, const Eigen::VectorXd& angle, int harmonics) {
  return smooth({name}, [=](int times) { return harmonics_of(angle, harmonics * times); });
}

Candidate smooth_by_level(const std::string& name, const std::vector<int>& level, const Eigen::MatrixXd& functions) {
  Candidate c = shaped("~" + name, name, static_cast<int>(functions.cols()), [=](const Eigen::VectorXd& theta) {
    Eigen::MatrixXd result = functions;
    for (Index i = 0; i < result.rows(); ++i) {
      if (level[static_cast<std::size_t>(i)] != static_cast<int>(theta[0])) result.row(i).setZero();
    }
    return result;
  });
  for (const int k : std::set<int>(level.begin(), level.end()))
    c.design.grid.push_back(Eigen::VectorXd::Constant(1, k));
  c.label = [name](const Eigen::VectorXd& theta) { return name + "/" + std::to_string(static_cast<int>(theta[0])); };
  return c;
}

Candidate factor(const std::string& name, const std::vector<int>& level) {
  Candidate c = smooth_by_level(name, level, Eigen::MatrixXd::Ones(static_cast<Index>(level.size()), 1));
  c.role.observed = true;
  return c;
}

Candidate bend(const std::string& name, const Eigen::VectorXd& values) {
  constexpr int bends = 9;
  Candidate c = shaped("bend~" + name, name, 1, [values](const Eigen::VectorXd& theta) {
    return Eigen::MatrixXd((theta[1] * (values.array() - theta[0])).max(0.0).matrix());
  });
  c.role.observed = true;
  std::vector<double> sorted(values.begin(), values.end());
  std::sort(sorted.begin(), sorted.end());
  const auto quantile = [&](int k) { return sorted[(sorted.size() - 1) * static_cast<std::size_t>(k) / bends]; };
  for (int k = 0; k < bends; ++k) {
    c.design.grid.push_back(Eigen::Vector2d(quantile(k), 1));
    if (k > 0)
      c.design.grid.push_back(Eigen::Vector2d(quantile(bends - k), -1));  // from the end on it is the same line
  }
  return c;
}

Candidate product_of(const std::string& name, const Eigen::VectorXd& values, const std::string& other,
                     const Eigen::VectorXd& along) {
  return smooth(
      {name + '*' + other, name, other},
      [=](int) {
        const Eigen::ArrayXd z = centred(signed_scale(values)), d = signed_scale(along);
        Eigen::MatrixXd result(values.size(), 3);
        result << z * centred(d), z * d * d, z * z * d;
        return result;
      },
      false);
}

Candidate product_over(const std::string& name, const Eigen::VectorXd& values, const std::string& plane,
                       const Eigen::MatrixXd& place) {
  return smooth(
      {name + '*' + plane, name, plane},
      [=](int) {
        const Eigen::ArrayXd z = centred(signed_scale(values)), x = signed_scale(place.col(0)),
                             y = signed_scale(place.col(1));
        Eigen::MatrixXd result(values.size(), 5);
        result << z * x, z * y, z * x * y, z * x * x, z * y * y;
        return result;
      },
      false);
}

Candidate smooth_over(const std::string& plane, const Eigen::MatrixXd& place) {
  return smooth(
      {plane}, [place](int) { return surface(place, 5, 3); }, false);
}

Candidate slope_over(const std::string& plane, const Eigen::MatrixXd& place) {
  Candidate c = smooth(
      {plane}, [place](int) { return surface(place, 2, 2); }, false);
  c.id = "slope~" + plane;
  c.role.slow = true;
  return c;
}

Candidate chirp(const std::string& name, const Eigen::VectorXd& time) {
  constexpr double cycles_apart = 0.5, change_apart = 0.5, slowest = 1, fastest = 14;  // cycles over the data
  Candidate c = shaped("chirp~" + name, name, 2, [u = scaled(time)](const Eigen::VectorXd& theta) {
    const Eigen::ArrayXd turns = 2 * M_PI * (theta[0] * u.array() - 2 * theta[1] * u.array() * (1 - u.array()));
    Eigen::MatrixXd result(u.size(), 2);
    result << turns.cos().matrix(), turns.sin().matrix();
    return result;
  });
  for (double cycles = 2; cycles <= 9; cycles += cycles_apart) {
    for (double change = 0.75; change <= 3; change += change_apart) {
      for (const double sign : {-1.0, 1.0}) {
        if (cycles - 2 * change >= slowest && cycles + 2 * change <= fastest)
          c.design.grid.push_back(Eigen::Vector2d(cycles, sign * change));
      }
    }
  }
  return c;
}

}  // namespace muster::inference
