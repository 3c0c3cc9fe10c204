// What the legs of hexapods weigh on their bodies, against Simbody's own operators on one State that has all robots:
// the mass matrix by a product a column, each for all robots at once, and what motion asks for by one inverse dynamics.
// Counters: us_* of a robot; speed above 1: ours is faster; off: the largest difference of accelerations, relative.
#include <benchmark/benchmark.h>

#include <random>
#include <stdexcept>

#include "cpu_seconds.hpp"
#include "plugins/physics_simbody/legs.hpp"
#include "plugins/physics_simbody/robot_models.hpp"

namespace {

using namespace muster;
using bench::cpu_seconds;
using namespace muster::simbody;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int n = unknowns_with_legs;
using Rates = VelocityOf<n>;
using Mass = MassMatrixOf<n>;

// Robots somewhere, turned somehow, with legs at any angle and everything in motion.
class Hexapods {
 public:
  explicit Hexapods(int count)
      : rdk_(description::read_robot(MUSTER_SOURCE_DIR "/plugins/robots/models/rdk.urdf")), model_(rdk_) {
    std::vector<NamedRobot> robots;
    for (int i = 0; i < count; ++i) robots.push_back({std::string("r").append(std::to_string(i)), &rdk_});
    crew_ = std::make_unique<RobotModels>(robots);
    state_ = crew_->system().state;
    std::mt19937 random(7);
    const auto draw = [&] { return static_cast<double>(random()) / 2147483648.0 - 1; };
    for (int i = 0; i < count; ++i) {
      const auto q = Eigen::Quaterniond(draw(), draw(), draw(), draw()).normalized();
      const double values[] = {q.w(), q.x(), q.y(), q.z(), draw(), draw(), draw()};
      const int first = (*crew_)[i].bodies.body.getFirstQIndex(state_);
      for (int k = 0; k < 7; ++k) state_.updQ()[first + k] = values[k];
      LegAngles angle;
      for (int k = 0; k < 6; ++k) state_.updQ()[leg(i, k).getFirstQIndex(state_)] = angle[k] = 3 * draw();
      for (int k = 0; k < n; ++k) state_.updU()[slot(i, k)] = 5 * draw();
      to_world_.push_back(q.toRotationMatrix());
      angle_.push_back(angle);
    }
    for (int i = 0; i < count; ++i) rates_.push_back(of(state_.getU(), i));
  }

  // Accelerations without contacts and motors, in the bodies' frames.
  std::vector<Rates> ours(double& seconds) const {
    std::vector<LeggedMass> weighed(angle_.size());
    const double before = cpu_seconds();
    for (std::size_t i = 0; i < angle_.size(); ++i)
      weighed[i] = weigh(model_, angle_[i], rates_[i], to_world_[i].transpose() * Vector3d(0, 0, -gravity));
    seconds += cpu_seconds() - before;
    std::vector<Rates> result;
    for (const LeggedMass& w : weighed) result.push_back(w.mass.ldlt().solve(w.force));
    return result;
  }

  std::vector<Rates> simbodys(double& seconds) {
    const auto& matter = crew_->system().matter;
    const auto count = static_cast<int>(angle_.size());
    std::vector<SimTK::Vector> columns(n);
    SimTK::Vector bias, zero(state_.getNU(), 0.0);
    const double before = cpu_seconds();
    state_.invalidateAllCacheAtOrAbove(SimTK::Stage::Position);
    crew_->system().system.realize(state_, SimTK::Stage::Dynamics);
    for (int k = 0; k < n; ++k) {
      SimTK::Vector units(state_.getNU(), 0.0);
      for (int i = 0; i < count; ++i) units[slot(i, k)] = 1;
      matter.multiplyByM(state_, units, columns[k]);
    }
    matter.calcResidualForceIgnoringConstraints(
        state_, crew_->system().system.getMobilityForces(state_, SimTK::Stage::Dynamics),
        crew_->system().system.getRigidBodyForces(state_, SimTK::Stage::Dynamics), zero, bias);
    seconds += cpu_seconds() - before;
    std::vector<Rates> result;
    for (int i = 0; i < count; ++i) {
      Mass mass;
      Rates force;
      for (int c = 0; c < n; ++c) {
        for (int r = 0; r < n; ++r) mass(r, c) = columns[c][slot(i, r)];
        force[c] = -bias[slot(i, c)];
      }
      result.push_back(in_body(mass.ldlt().solve(force), i));
    }
    return result;
  }

 private:
  const SimTK::MobilizedBody::Pin& leg(int robot, int k) const { return (*crew_)[robot].bodies.legs[k]; }
  int slot(int robot, int k) const {
    return k < 6 ? (*crew_)[robot].bodies.body.getFirstUIndex(state_) + k
                 : int(leg(robot, k - 6).getFirstUIndex(state_));
  }
  Rates in_body(Rates u, int robot) const {
    const Matrix3d turn = to_world_[robot].transpose();
    u.head<3>() = (turn * u.head<3>()).eval();
    u.segment<3>(3) = (turn * u.segment<3>(3)).eval();
    return u;
  }
  Rates of(const SimTK::Vector& all, int robot) const {
    Rates u;
    for (int k = 0; k < n; ++k) u[k] = all[slot(robot, k)];
    return in_body(u, robot);
  }

  description::Robot rdk_;
  RobotModel model_;
  std::unique_ptr<RobotModels> crew_;
  SimTK::State state_;
  std::vector<Matrix3d> to_world_;
  std::vector<LegAngles> angle_;
  std::vector<Rates> rates_;
};

void legs_against_operators(benchmark::State& state) {
  Hexapods robots(static_cast<int>(state.range(0)));
  double ours = 0, simbodys = 0, off = 0;
  for (auto _ : state) {
    const auto mine = robots.ours(ours), theirs = robots.simbodys(simbodys);
    for (std::size_t i = 0; i < mine.size(); ++i) off = std::max(off, (mine[i] - theirs[i]).norm() / theirs[i].norm());
  }
  if (!(off < 1e-9)) throw std::runtime_error("accelerations differ");
  const double each = 1e6 / static_cast<double>(state.iterations()) / static_cast<double>(state.range(0));
  state.counters["us_ours"] = ours * each;
  state.counters["us_simbody"] = simbodys * each;
  state.counters["speed"] = simbodys / ours;
  state.counters["off"] = off;
}
BENCHMARK(legs_against_operators)->ArgName("robots")->Arg(1)->Arg(10)->Arg(50)->Unit(benchmark::kMicrosecond);

}  // namespace

BENCHMARK_MAIN();
