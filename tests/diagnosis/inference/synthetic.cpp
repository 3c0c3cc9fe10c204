#include "tests/diagnosis/inference/synthetic.hpp"

#include <cmath>

#include "diagnosis/inference/noise/reml.hpp"
#include "muster/random.hpp"

namespace muster::synthetic {
namespace {

// A stationary field in the plane: waves with wavelengths from the spectrum of the correlation.
class Waves {
 public:
  Waves(Shape shape, double decorrelation, Stream stream) {
    for (uint64_t k = 0; k < count; ++k) {
      const double way = 2 * M_PI * stream.uniform(k, 0), number = wave_number(shape, decorrelation, stream, k);
      kx_[k] = number * std::cos(way);
      ky_[k] = number * std::sin(way);
      a_[k] = stream.normal(k, 3) / std::sqrt(count);
      b_[k] = stream.normal(k, 4) / std::sqrt(count);
    }
  }
  double at(double x, double y) const {
    double sum = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const double phase = kx_[k] * x + ky_[k] * y;
      sum += a_[k] * std::cos(phase) + b_[k] * std::sin(phase);
    }
    return sum;
  }

 private:
  static constexpr std::size_t count = 250;
  static double wave_number(Shape shape, double d, Stream stream, uint64_t k) {
    const double u = stream.uniform(k, 1);
    if (shape == Shape::gaussian) return std::sqrt(-2 * std::log(u)) / d;
    if (shape == Shape::two_scale) d *= k % 2 == 0 ? 0.4 : 2.5;
    return std::sqrt(1 / (u * u) - 1) / d;  // exp(-r/d) in two dimensions
  }
  std::array<double, count> kx_, ky_, a_, b_;
};

std::vector<Segment> walls_of(const Recipe& r, Stream stream) {
  std::vector<Segment> walls;
  for (uint64_t k = 0; k < 18; ++k) {
    const double x = r.width * stream.uniform(k, 0), y = r.height * stream.uniform(k, 1);
    const double length = 2 + 5 * stream.uniform(k, 2);
    const bool upright = stream.uniform(k, 3) < 0.5;
    walls.push_back(upright ? Segment{x, y, x, y + length} : Segment{x, y, x + length, y});
  }
  return walls;
}

struct Robot {
  double x, y, heading, speed;
};

// Drives straight on with occasional turns, and away from the border.
void drive(Robot& robot, const Recipe& r, double dt, Stream stream, uint64_t tick) {
  if (stream.uniform(tick, 0) < 0.08) robot.heading += 2.4 * (stream.uniform(tick, 1) - 0.5);
  if (stream.uniform(tick, 2) < 0.05) robot.speed = 0.2 + 0.5 * stream.uniform(tick, 3);
  const double x = robot.x + dt * robot.speed * std::cos(robot.heading);
  const double y = robot.y + dt * robot.speed * std::sin(robot.heading);
  if (x < 0.5 || x > r.width - 0.5 || y < 0.5 || y > r.height - 0.5) {
    robot.heading = std::atan2(r.height / 2 - robot.y, r.width / 2 - robot.x) + 2 * (stream.uniform(tick, 4) - 0.5);
    return;
  }
  robot.x = x;
  robot.y = y;
}

void resize(World& w) {
  const Index n = w.recipe.readings;
  w.readings.tx_at.setZero(3, n);
  w.readings.rx_at.setZero(3, n);
  w.rssi.resize(n);
  w.time.resize(n);
  w.speed.resize(n);
  w.battery.resize(n);
  w.temperature.resize(n);
}

void record_drive(World& w, Stream stream) {
  const Recipe& r = w.recipe;
  constexpr double dt = 0.4;  // s between readings of one link
  std::vector<Robot> robots;
  for (uint64_t k = 0; k < static_cast<uint64_t>(r.robots); ++k)
    robots.push_back({r.width * (0.2 + 0.6 * stream.uniform(k, 10)), r.height * (0.2 + 0.6 * stream.uniform(k, 11)),
                      6 * stream.uniform(k, 12), 0.4});
  Index row = 0;
  for (uint64_t tick = 0; row < r.readings; ++tick) {
    for (std::size_t k = 0; k < robots.size(); ++k) {
      drive(robots[k], r, dt, stream.of(k), tick);
      for (int tx = 0; tx < r.transmitters && row < r.readings; ++tx, ++row) {
        const auto at = static_cast<uint64_t>(tx);
        w.readings.tx_at(0, row) = r.width * (0.1 + 0.8 * stream.uniform(at, 20));
        w.readings.tx_at(1, row) = r.height * (0.1 + 0.8 * stream.uniform(at, 21));
        w.readings.rx_at.col(row) << robots[k].x, robots[k].y, 0;
        w.readings.tx.push_back(tx);
        w.readings.rx.push_back(100 + static_cast<int>(k));
        w.readings.t.push_back(dt * static_cast<double>(tick));
        w.readings.rx_yaw.push_back(robots[k].heading);
        w.speed[row] = robots[k].speed;
      }
    }
  }
  w.time = Eigen::Map<const Eigen::VectorXd>(w.readings.t.data(), r.readings);
  const double last = w.time[r.readings - 1];
  w.battery = 12.6 - 1.5 * (w.time.array() / last).pow(1.3);
  w.temperature = 20 + 3 * (w.time.array() * 2 * M_PI * 1.7 / last + 1).sin();
}

}  // namespace

bool crosses(double px, double py, double qx, double qy, const Segment& s) {
  const double dx = qx - px, dy = qy - py, ex = s[2] - s[0], ey = s[3] - s[1];
  const double along = dx * ey - dy * ex;
  if (std::abs(along) < 1e-12) return false;
  const double wx = s[0] - px, wy = s[1] - py;
  const double t = (wx * ey - wy * ex) / along, u = (wx * dy - wy * dx) / along;
  return t > 0 && t < 1 && u >= 0 && u <= 1;
}

Eigen::VectorXd crossings(const diagnosis::LinkReadings& readings, const Segment& segment) {
  Eigen::VectorXd result(readings.size());
  for (Index i = 0; i < result.size(); ++i)
    result[i] =
        crosses(readings.rx_at(0, i), readings.rx_at(1, i), readings.tx_at(0, i), readings.tx_at(1, i), segment);
  return result;
}

Eigen::VectorXd World::distance() const {
  return (readings.tx_at - readings.rx_at).colwise().norm().transpose().cwiseMax(0.5);
}

Eigen::VectorXd World::bearing() const {
  Eigen::VectorXd result(readings.size());
  for (Index i = 0; i < result.size(); ++i) {
    const Eigen::Vector3d to = readings.tx_at.col(i) - readings.rx_at.col(i);
    result[i] = std::atan2(to.y(), to.x()) - readings.rx_yaw[static_cast<std::size_t>(i)];
  }
  return result;
}

World world_of(const Recipe& recipe) {
  const Stream stream(combined(key_of("synthetic"), recipe.seed));
  World w{recipe, {}, {}, {}, {}, {}, {}, {}, walls_of(recipe, stream.of(1)), {}};
  resize(w);
  record_drive(w, stream.of(2));
  w.base.setOnes(recipe.readings, 3);
  w.base.col(1) = -10 * w.distance().array().log10();
  w.base.col(2).setZero();
  for (const Segment& wall : w.walls) w.base.col(2) -= crossings(w.readings, wall);
  const Waves common(recipe.shape, recipe.decorrelation, stream.of(3));
  std::vector<Waves> own;
  for (int tx = 0; tx < recipe.transmitters; ++tx)
    own.emplace_back(recipe.shape, recipe.decorrelation, stream.of(100 + static_cast<uint64_t>(tx)));
  const Eigen::Vector3d truth(-35, 2.0, 4.0);
  for (Index i = 0; i < recipe.readings; ++i) {
    const double x = w.readings.rx_at(0, i), y = w.readings.rx_at(1, i);
    const double field = std::sqrt(recipe.shared) * common.at(x, y) +
                         std::sqrt(1 - recipe.shared) *
                             own[static_cast<std::size_t>(w.readings.tx[static_cast<std::size_t>(i)])].at(x, y);
    w.rssi[i] =
        w.base.row(i) * truth + recipe.sigma * field + recipe.fading * stream.of(4).normal(static_cast<uint64_t>(i));
  }
  w.true_theta = Eigen::Vector4d(2 * std::log(recipe.sigma), std::log(recipe.decorrelation),
                                 2 * std::log(recipe.fading), std::log(recipe.shared / (1 - recipe.shared)));
  return w;
}

Recipe varied(uint64_t seed, Index readings) {
  const Stream s(combined(key_of("recipe"), seed));
  Recipe r;
  r.seed = seed;
  r.readings = readings;
  r.transmitters = 3 + static_cast<int>(3 * s.uniform(0));
  r.sigma = 2 + 4 * s.uniform(1);
  r.decorrelation = 1 + 2 * s.uniform(2);
  r.shared = 0.02 + 0.28 * s.uniform(3);
  r.fading = 1.5 + 2.5 * s.uniform(4);
  return r;
}

Eigen::VectorXd scaled_to(const World& world, const Eigen::VectorXd& column, double lambda) {
  const noise::Rows rows = diagnosis::link_rows(world.readings);
  const noise::Field field(diagnosis::link_sites(rows, world.readings));
  const noise::Whitener whitener(field, {noise::Family::exponential, world.true_theta});
  const auto base = noise::basis_of(whitener(rows.mean(world.base)));
  const double energy = base.rest(whitener(rows.mean(column))).squaredNorm();
  return column * std::sqrt(lambda / energy);
}

}  // namespace muster::synthetic
