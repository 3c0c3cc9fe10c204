#include "tests/diagnosis/inference/causes.hpp"

#include <algorithm>
#include <cmath>
#include <set>

namespace muster::synthetic {
namespace {

using Eigen::VectorXd;
using inference::Candidate;
using inference::Piece;

VectorXd theta(std::initializer_list<double> values) {
  VectorXd result(static_cast<Index>(values.size()));
  std::copy(values.begin(), values.end(), result.begin());
  return result;
}

// Captures the world by reference: it must outlive the problem.
Eigen::ArrayXd is_tx(const World& w, double tx) {
  Eigen::ArrayXd result(w.readings.size());
  for (Index i = 0; i < result.size(); ++i)
    result[i] = w.readings.tx[static_cast<std::size_t>(i)] == static_cast<int>(tx);
  return result;
}

std::vector<VectorXd> one_a_transmitter(const World& w) {
  std::vector<VectorXd> grid;
  grid.reserve(static_cast<std::size_t>(w.recipe.transmitters));
  for (int k = 0; k < w.recipe.transmitters; ++k) grid.push_back(theta({static_cast<double>(k)}));
  return grid;
}

Candidate offset(const World& w, bool of_tx) {
  Candidate c;
  c.id = of_tx ? "tx_offset" : "rx_offset";
  c.covariates = {of_tx ? "tx" : "rx"};
  c.role.time_like = !of_tx;
  c.role.slow = of_tx;
  if (of_tx) c.role.replaces = {"txbearing"};
  c.design.grid = of_tx ? one_a_transmitter(w) : std::vector<VectorXd>{theta({101})};
  c.design.columns = [&w, of_tx](const VectorXd& t) -> Eigen::MatrixXd {
    if (of_tx) return is_tx(w, t[0]);
    VectorXd result(w.readings.size());
    for (Index i = 0; i < result.size(); ++i)
      result[i] = w.readings.rx[static_cast<std::size_t>(i)] == static_cast<int>(t[0]);
    return result;
  };
  return c;
}

Candidate antenna_rx(const World& w) {
  Candidate c;
  c.id = "antenna_rx";
  c.covariates = {"bearing"};
  c.role.replaces = {"bearing", "heading"};
  c.design.width = 2;
  c.design.grid = {VectorXd()};
  c.design.columns = [&w](const VectorXd&) {
    Eigen::MatrixXd result(w.readings.size(), 2);
    result << w.bearing().array().cos(), w.bearing().array().sin();
    return result;
  };
  return c;
}

Candidate antenna_tx(const World& w) {
  Candidate c;
  c.id = "antenna_tx";
  c.covariates = {"txbearing"};
  c.role.replaces = {"txbearing"};
  c.design.width = 2;
  c.role.slow = true;
  c.design.grid = one_a_transmitter(w);
  c.design.columns = [&w](const VectorXd& t) {
    const Eigen::Matrix3Xd from = w.readings.rx_at - w.readings.tx_at;
    const Eigen::ArrayXd length = from.colwise().norm().transpose().cwiseMax(1e-3);
    Eigen::MatrixXd result(w.readings.size(), 2);
    result << from.row(0).transpose().array() / length * is_tx(w, t[0]),
        from.row(1).transpose().array() / length * is_tx(w, t[0]);
    return result;
  };
  return c;
}

// theta: time [s], transmitter or -1 for all.
Candidate step(const World& w) {
  Candidate c;
  c.id = "step";
  c.covariates = {"time"};
  c.role.replaces = {"time", "time_per_tx"};
  c.role.time_like = true;
  const double last = w.time.maxCoeff();
  for (int tx = -1; tx < w.recipe.transmitters; ++tx) {
    for (int k = 0; k < 29; ++k) c.design.grid.push_back(theta({last * (0.08 + 0.03 * k), static_cast<double>(tx)}));
  }
  c.design.columns = [&w](const VectorXd& t) -> Eigen::MatrixXd {
    const Eigen::ArrayXd on = (w.time.array() > t[0]).cast<double>();
    return t[1] < 0 ? on : Eigen::ArrayXd(on * is_tx(w, t[1]));
  };
  c.refinement.lower = theta({0.08 * last, -1});  // near the ends it is an offset
  c.refinement.upper = theta({0.92 * last, 1e3});
  c.refinement.step = theta({0.012 * last, 0});
  c.refinement.evaluations = 35;
  c.refinement.charge = 0.7;
  return c;
}

Candidate drift(const World& w) {
  Candidate c;
  c.id = "drift";
  c.covariates = {"time"};
  c.role.replaces = {"time", "time_per_tx"};
  c.role.time_like = true;
  for (int tx = -1; tx < w.recipe.transmitters; ++tx) c.design.grid.push_back(theta({static_cast<double>(tx)}));
  c.design.columns = [&w](const VectorXd& t) -> Eigen::MatrixXd {
    const Eigen::ArrayXd u = w.time.array() / w.time.maxCoeff();
    return t[0] < 0 ? u : Eigen::ArrayXd(u * is_tx(w, t[0]));
  };
  return c;
}

Candidate dual_slope(const World& w) {
  Candidate c;
  c.id = "dual_slope";
  c.covariates = {"logd"};
  c.role.replaces = {"logd", "level"};
  c.role.slow = c.role.level_like = true;
  for (int k = 0; k < 12; ++k) c.design.grid.push_back(theta({std::log(2.5) + k * std::log(4.8) / 11}));
  c.design.columns = [&w](const VectorXd& t) -> Eigen::MatrixXd {
    return (w.distance().array().log10() - t[0] / std::log(10.0)).max(0.0);
  };
  c.refinement.lower = theta({std::log(1.5)});
  c.refinement.upper = theta({std::log(15.0)});
  c.refinement.step = theta({0.12});
  c.refinement.evaluations = 35;
  c.refinement.charge = 0.5;
  return c;
}

// theta: lower left corner of a room of 6 x 5 m.
Candidate room_clutter(const World& w) {
  Candidate c;
  c.id = "room_clutter";
  c.covariates = {"position"};
  c.role.replaces = {"position"};
  c.design.sign = -1;
  c.role.slow = true;
  for (double x = 0; x + 6 <= w.recipe.width; x += 6) {
    for (double y = 0; y + 5 <= w.recipe.height; y += 5) c.design.grid.push_back(theta({x, y}));
  }
  c.design.columns = [&w](const VectorXd& t) -> Eigen::MatrixXd {
    const auto x = w.readings.rx_at.row(0).array(), y = w.readings.rx_at.row(1).array();
    return (x >= t[0] && x < t[0] + 6 && y >= t[1] && y < t[1] + 5).cast<double>().transpose();
  };
  return c;
}

Segment segment_of(const VectorXd& t) {
  const double x = t[2] / 2 * std::cos(t[3]), y = t[2] / 2 * std::sin(t[3]);
  return {t[0] - x, t[1] - y, t[0] + x, t[1] + y};
}

VectorXd wall_of(const Segment& s) {
  const double dx = s[2] - s[0], dy = s[3] - s[1];
  return theta({(s[0] + s[2]) / 2, (s[1] + s[3]) / 2, std::hypot(dx, dy), std::atan2(dy, dx)});
}

// The two most distant ends of every pair of walls found.
std::vector<VectorXd> spans(const std::vector<Piece>& pieces) {
  std::vector<VectorXd> result;
  std::vector<Segment> walls;
  walls.reserve(pieces.size());
  for (const Piece& piece : pieces) {
    walls.push_back(piece.id == "unmapped_wall"
                        ? segment_of(piece.theta)
                        : Segment{piece.theta[0], piece.theta[1], piece.theta[0], piece.theta[1]});
  }
  for (std::size_t i = 0; i < walls.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      const std::array<std::array<double, 2>, 4> ends{{{walls[i][0], walls[i][1]},
                                                       {walls[i][2], walls[i][3]},
                                                       {walls[j][0], walls[j][1]},
                                                       {walls[j][2], walls[j][3]}}};
      Segment longest{0, 0, 0, 0};
      for (const auto& a : ends) {
        for (const auto& b : ends) {
          if (std::hypot(a[0] - b[0], a[1] - b[1]) > std::hypot(longest[2] - longest[0], longest[3] - longest[1]))
            longest = {a[0], a[1], b[0], b[1]};
        }
      }
      result.push_back(wall_of(longest));
    }
  }
  return result;
}

// Number of times that robots drove across a segment, where no wall can be.
int driven_across(const World& w, const Segment& s) {
  int count = 0;
  std::array<Index, 2> before{-1, -1};
  for (Index i = 0; i < w.readings.size(); ++i) {
    if (w.readings.tx[static_cast<std::size_t>(i)] != 0) continue;
    Index& last = before[static_cast<std::size_t>(w.readings.rx[static_cast<std::size_t>(i)] - 100)];
    if (last >= 0) {
      const auto a = w.readings.rx_at.col(last), b = w.readings.rx_at.col(i);
      count += crosses(a.x(), a.y(), b.x(), b.y(), s);
    }
    last = i;
  }
  return count;
}

bool worth_a_place(const VectorXd& column) {
  const double share = (column.array() > 0).cast<double>().mean();
  return share > 0.02;
}

Candidate unmapped_wall(const World& w) {
  Candidate c;
  c.id = "unmapped_wall";
  c.covariates = {"map"};
  c.role.over_sites = true;
  c.role.replaces = {"position", "txbearing"};
  c.design.sign = -1;
  c.role.pieces = "place";
  c.refinement.starts = 8;
  c.refinement.charge = 4.5;
  c.design.columns = [&w](const VectorXd& t) -> Eigen::MatrixXd { return crossings(w.readings, segment_of(t)); };
  c.refinement.admitted = [&w](const VectorXd& t) {
    return std::pow(0.8, std::min(driven_across(w, segment_of(t)), 10));
  };
  c.role.spanning = spans;
  for (const double length : {2.0, 3.5, 5.0}) {
    for (double x = 0.75; x < w.recipe.width; x += 1) {
      for (double y = 0.75; y < w.recipe.height; y += 1) {
        for (const double angle : {0.0, M_PI / 2}) {
          const VectorXd t = theta({x, y, length, angle});
          if (driven_across(w, segment_of(t)) == 0 && worth_a_place(crossings(w.readings, segment_of(t))))
            c.design.grid.push_back(t);
        }
      }
    }
  }
  c.refinement.lower = theta({0, 0, 0.8, -4});
  c.refinement.upper = theta({w.recipe.width, w.recipe.height, 9, 4});
  c.refinement.step = theta({0.4, 0.4, 0.8, 0.12});
  return c;
}

// theta: centre and radius of a disk; dB a metre inside.
VectorXd chords(const World& w, const VectorXd& t) {
  VectorXd result(w.readings.size());
  for (Index i = 0; i < result.size(); ++i) {
    const Eigen::Vector2d p = w.readings.rx_at.col(i).head<2>(), d = w.readings.tx_at.col(i).head<2>() - p;
    const Eigen::Vector2d f = p - t.head<2>();
    const double a = d.squaredNorm() + 1e-12, b = 2 * f.dot(d), under = b * b - 4 * a * (f.squaredNorm() - t[2] * t[2]);
    const double root = std::sqrt(std::max(under, 0.0));
    const double from = std::max((-b - root) / (2 * a), 0.0), to = std::min((-b + root) / (2 * a), 1.0);
    result[i] = under > 0 && to > from ? (to - from) * std::sqrt(a) : 0;
  }
  return result;
}

Candidate obstacle(const World& w) {
  Candidate c;
  c.id = "obstacle";
  c.covariates = {"map"};
  c.role.over_sites = true;
  c.role.replaces = {"position", "txbearing"};
  c.design.sign = -1;
  c.role.pieces = "place";
  c.refinement.starts = 5;
  c.refinement.charge = 4;
  c.design.columns = [&w](const VectorXd& t) -> Eigen::MatrixXd { return chords(w, t); };
  for (const double radius : {0.45, 0.8}) {
    for (double x = 0.5; x < w.recipe.width; x += 1) {
      for (double y = 0.5; y < w.recipe.height; y += 1) {
        const Eigen::Vector2d at(x, y);
        const bool driven = (w.readings.rx_at.topRows<2>().colwise() - at).colwise().norm().minCoeff() < 0.7 * radius;
        if (!driven && worth_a_place(chords(w, theta({x, y, radius})))) c.design.grid.push_back(theta({x, y, radius}));
      }
    }
  }
  c.refinement.lower = theta({0, 0, 0.15});
  c.refinement.upper = theta({w.recipe.width, w.recipe.height, 1.5});
  c.refinement.step = theta({0.3, 0.3, 0.2});
  return c;
}

Candidate periodic(const World& w) {
  Candidate c;
  c.id = "periodic";
  c.covariates = {"time"};
  c.role.replaces = {"time"};
  c.role.time_like = true;
  c.design.width = 2;
  const double last = w.time.maxCoeff();
  for (double cycles = 2; cycles < 16; cycles += 0.4) c.design.grid.push_back(theta({2 * M_PI * cycles / last}));
  c.design.columns = [&w](const VectorXd& t) {
    Eigen::MatrixXd result(w.readings.size(), 2);
    result << (t[0] * w.time.array()).cos(), (t[0] * w.time.array()).sin();
    return result;
  };
  c.refinement.lower = theta({2 * M_PI / last});
  c.refinement.upper = theta({40 * M_PI / last});
  c.refinement.step = theta({0.2 * 2 * M_PI / last});
  c.refinement.evaluations = 35;
  c.refinement.charge = 0.7;
  return c;
}

}  // namespace

std::vector<inference::Candidate> causes_of(const World& w) {
  std::vector<Candidate> all{offset(w, true), offset(w, false), antenna_rx(w),   antenna_tx(w),    step(w),    drift(w),
                             periodic(w),     dual_slope(w),    room_clutter(w), unmapped_wall(w), obstacle(w)};
  std::erase_if(all, [](const Candidate& c) { return c.design.grid.empty(); });
  return all;
}

diagnosis::LinkColumns columns_of(const World& w) {
  return {{{"speed", w.speed, false, 4, true}, {"battery", w.battery}, {"temperature", w.temperature}}, {}};
}

inference::Problem problem_of(const World& w, const VectorXd& effect, std::vector<Candidate> causes,
                              const diagnosis::LinkRowLimits& limits, std::vector<int> run) {
  inference::Problem problem;
  problem.layout = std::make_shared<const diagnosis::LinkLayout>(w.readings, limits, std::move(run));
  problem.measured = (w.rssi + effect).array().round();
  problem.base = w.base;
  problem.candidates = std::move(causes);
  problem.smooths = diagnosis::link_smooths(w.readings, columns_of(w), true);
  return problem;
}

}  // namespace muster::synthetic
