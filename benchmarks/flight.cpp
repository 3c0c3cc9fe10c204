// Quadrotors in the air, against the engine that robot simulators use and against the limit: 100 Hummingbirds fly 10 s
// on rotor rates that change every 0.1 s, all sides in one run, by the CPU time of this process, with the places where
// they end held against steps of half a millisecond. Goals (the project's): at most 0.2 mm off at 40 times the
// speed of a general engine's fourth-order method. Counters: us_* of a robot-step, mm_* the worst robot's error in the
// end, speed ratios (above 1: ours is better), real_time: simulated over CPU time.
#include <benchmark/benchmark.h>
#ifdef MUSTER_HAS_MUJOCO
#include <mujoco/mujoco.h>
#endif

#include <array>
#include <fstream>
#include <limits>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>

#include "bare_flight.hpp"
#include "cpu_seconds.hpp"
#include "kernel/simulation.hpp"
#include "plugins/physics_ode/library.hpp"
#include "plugins/physics_simbody/world.hpp"
#include "text/temporary_folder.hpp"

namespace {

using namespace muster;
using bench::BareFlight;
using bench::cpu_seconds;
using Place = Eigen::Vector3d;

constexpr int birds = 100, ticks = 100;
constexpr double tick = 0.1;

const description::Robot& hummingbird() {
  static const auto robot = description::read_robot(MUSTER_SOURCE_DIR "/plugins/robots/models/hummingbird.urdf");
  return robot;
}

// Asked for from tick k on: hover, some climbing and sinking, and turns about all axes.
std::array<double, 4> asked(int bird, int k) {
  const double t = tick * (k + 0.5), hover = 453.3;
  const double climb = 5 * std::sin(2 * t + bird), roll = 0.4 * std::sin(3 * t + bird);
  const double pitch = 0.4 * std::cos(2.3 * t + bird), turn = 2 * std::sin(1.1 * t);
  return {hover + climb - pitch + turn, hover + climb + roll - turn, hover + climb + pitch + turn,
          hover + climb - roll - turn};
}

Place start(int bird) {
  const int column = bird % 10, row = bird / 10;
  return {200.0 * column, 200.0 * row, 1000};
}

struct Flown {
  double seconds = std::numeric_limits<double>::infinity();  // of CPU time, the best so far
  std::vector<Place> centres;                                // of mass, in the end
  void again(const Flown& o) { seconds = std::min(seconds, o.seconds), centres = o.centres; }
};

// Steps inside a tick: `parts`.
Flown bare(int parts) {
  const BareFlight flight(hummingbird());
  const Place centre = whole_mass(hummingbird()).centre;
  std::vector<BareFlight::State> states;
  std::vector<BareFlight::Rotors> rotors(birds, {453.3, 453.3, 453.3, 453.3});
  for (int i = 0; i < birds; ++i) {
    const Place at = start(i) + centre;
    states.push_back({at.x(), at.y(), at.z(), 0, 0, 0, 1, 0, 0, 0, 0, 0, 0});
  }
  const double before = cpu_seconds();
  for (int k = 0; k < ticks; ++k) {
    for (int i = 0; i < birds; ++i) {
      const auto rates = asked(i, k);
      for (int n = 0; n < parts; ++n) flight.step(tick / parts, rates, rotors[i], states[i]);
    }
  }
  Flown result{cpu_seconds() - before, {}};
  for (const auto& s : states) result.centres.emplace_back(s[0], s[1], s[2]);
  return result;
}

Flown ours(int parts) {
  std::vector<simbody::NamedRobot> robots;
  std::vector<simbody::RobotState> states;
  for (int i = 0; i < birds; ++i) {
    robots.push_back({"r" + std::to_string(i), &hummingbird()});
    states.push_back(simbody::at_rest(start(i).x(), start(i).y(), 0));
    states.back().pose[2] = start(i).z();
    states.back().rotors = {453.3, 453.3, 453.3, 453.3};
  }
  const auto engine = simbody::make_engine(robots, simbody::Integrator::midpoint, tick / parts);
  std::vector<simbody::Command> commands(birds);
  const double before = cpu_seconds();
  for (int k = 0; k < ticks; ++k) {
    for (int i = 0; i < birds; ++i) commands[i].rotors = asked(i, k);
    engine->step(tick, commands, states);
  }
  Flown result{cpu_seconds() - before, {}};
  for (const auto& s : states) {
    const Eigen::Quaterniond q(s.pose[3], s.pose[4], s.pose[5], s.pose[6]);
    result.centres.push_back(Place(s.pose[0], s.pose[1], s.pose[2]) + q * whole_mass(hummingbird()).centre);
  }
  return result;
}

// Bodies that live in ODE from step to step, as a program without a kernel has them.
Flown ode(int parts) {
  const ode::Library library;
  const ode::OwnThread thread;
  const std::unique_ptr<dxWorld, ode::Destroy> world(dWorldCreate());
  thread.carry(world.get());
  dWorldSetGravity(world.get(), 0, 0, -9.81);
  const auto& drive = *hummingbird().quadrotor;
  const description::Mass whole = whole_mass(hummingbird());
  std::vector<dBodyID> bodies;
  std::vector<description::RotorRates> rotors(birds, {453.3, 453.3, 453.3, 453.3});
  for (int i = 0; i < birds; ++i) {
    dMass mass;
    const auto& m = whole.inertia;
    dMassSetParameters(&mass, whole.mass, 0, 0, 0, m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2));
    bodies.push_back(dBodyCreate(world.get()));
    dBodySetMass(bodies[i], &mass);
    const Place at = start(i) + whole.centre;
    dBodySetPosition(bodies[i], at.x(), at.y(), at.z());
    dBodySetFiniteRotationMode(bodies[i], 1);
  }
  const double h = tick / parts, before = cpu_seconds();
  const auto half = drive.decay(h / 2);
  for (int k = 0; k < ticks; ++k) {
    for (int n = 0; n < parts; ++n) {
      for (int i = 0; i < birds; ++i) {
        const auto rates = asked(i, k);
        rotors[i] = drive.later(rotors[i], rates, half);
        dVector3 v, w;
        const dReal *speed = dBodyGetLinearVel(bodies[i]), *spin = dBodyGetAngularVel(bodies[i]);
        dBodyVectorFromWorld(bodies[i], speed[0], speed[1], speed[2], v);
        dBodyVectorFromWorld(bodies[i], spin[0], spin[1], spin[2], w);
        const Place turning(w[0], w[1], w[2]);
        const auto [force, torque] =
            drive.wrench(rotors[i], Place(v[0], v[1], v[2]) - turning.cross(whole.centre), turning);
        const Place about_centre = torque - whole.centre.cross(force);
        dBodyAddRelForce(bodies[i], force.x(), force.y(), force.z());
        dBodyAddRelTorque(bodies[i], about_centre.x(), about_centre.y(), about_centre.z());
        rotors[i] = drive.later(rotors[i], rates, half);
      }
      dWorldStep(world.get(), h);
    }
  }
  Flown result{cpu_seconds() - before, {}};
  for (dBodyID body : bodies) {
    const dReal* p = dBodyGetPosition(body);
    result.centres.emplace_back(p[0], p[1], p[2]);
  }
  return result;
}

#ifdef MUSTER_HAS_MUJOCO
// Its Runge-Kutta method of fourth order, without contacts and constraints, all birds in one model: a hundred models of
// one bird take 1.2 times as long.
class Mujoco {
 public:
  Mujoco() : model_(loaded()), data_(mj_makeData(model_.get())) { mjcb_passive = push; }
  ~Mujoco() { mjcb_passive = nullptr; }

  Flown fly(int parts) {
    model_->opt.timestep = tick / parts;
    mj_resetData(model_.get(), data_.get());
    for (int i = 0; i < birds; ++i) Eigen::Map<Place>(data_->qpos + 7 * i) = start(i);
    const auto& drive = *hummingbird().quadrotor;
    const auto through = drive.decay(tick);
    now_.rates.fill({453.3, 453.3, 453.3, 453.3});
    const double before = cpu_seconds();
    for (int k = 0; k < ticks; ++k) {
      now_.since = data_->time;
      for (int i = 0; i < birds; ++i) now_.asked[i] = asked(i, k);
      for (int n = 0; n < parts; ++n) mj_step(model_.get(), data_.get());
      for (int i = 0; i < birds; ++i) now_.rates[i] = drive.later(now_.rates[i], now_.asked[i], through);
    }
    Flown result{cpu_seconds() - before, {}};
    for (int i = 0; i < birds; ++i) {
      const double* at = data_->qpos + 7 * i;
      const Eigen::Quaterniond q(at[3], at[4], at[5], at[6]);
      result.centres.push_back(Place(at[0], at[1], at[2]) + q * whole_mass(hummingbird()).centre);
    }
    return result;
  }

 private:
  struct Remove {
    void operator()(mjModel* m) const { mj_deleteModel(m); }
    void operator()(mjData* d) const { mj_deleteData(d); }
  };
  using Model = std::unique_ptr<mjModel, Remove>;
  struct Now {
    double since;  // s: when these rates were there, and asked for
    std::array<description::RotorRates, birds> rates, asked;
  };

  static Model loaded() {
    const description::Mass whole = whole_mass(hummingbird());
    const auto& m = whole.inertia;
    std::ostringstream xml;
    xml.precision(17);
    xml << "<mujoco><option gravity='0 0 -9.81' integrator='RK4'><flag contact='disable' "
           "constraint='disable'/></option>"
        << "<worldbody>";
    for (int i = 0; i < birds; ++i) {
      xml << "<body><freejoint/><inertial mass='" << whole.mass << "' pos='" << whole.centre.transpose()
          << "' fullinertia='" << m(0, 0) << ' ' << m(1, 1) << ' ' << m(2, 2) << ' ' << m(0, 1) << ' ' << m(0, 2) << ' '
          << m(1, 2) << "'/></body>";
    }
    xml << "</worldbody></mujoco>";
    const TemporaryFolder folder;
    const std::string file = (folder.path() / "birds.xml").string();
    std::ofstream(file) << xml.str();
    std::array<char, 500> error{};
    Model model(mj_loadXML(file.c_str(), nullptr, error.data(), error.size()));
    if (!model) throw std::logic_error(error.data());
    return model;
  }

  // Its free joints move in the world's axes and turn in the body's.
  static void push(const mjModel*, mjData* d) {
    const auto& drive = *hummingbird().quadrotor;
    const auto decay = drive.decay(d->time - now_.since);
    for (int i = 0; i < birds; ++i) {
      const double* turn = d->qpos + 7 * i + 3;
      const Eigen::Quaterniond q(turn[0], turn[1], turn[2], turn[3]);
      const Eigen::Map<const Place> speed(d->qvel + 6 * i), spin(d->qvel + 6 * i + 3);
      const auto [force, torque] =
          drive.wrench(drive.later(now_.rates[i], now_.asked[i], decay), q.conjugate() * speed, spin);
      Eigen::Map<Place>(d->qfrc_passive + 6 * i) += q * force;
      Eigen::Map<Place>(d->qfrc_passive + 6 * i + 3) += torque;
    }
  }

  static inline Now now_;
  Model model_;
  std::unique_ptr<mjData, Remove> data_;
};

Flown mujoco(int parts) {
  static Mujoco engine;
  return engine.fly(parts);
}
#endif

const std::vector<Place>& truth() {
  static const std::vector<Place> centres = bare(200).centres;
  return centres;
}

double error(const Flown& flown) {
  double most = 0;
  for (int i = 0; i < birds; ++i) most = std::max(most, (flown.centres[i] - truth()[i]).norm());
  return most;
}

double us(const Flown& flown, int parts) { return 1e6 * flown.seconds / (birds * ticks * parts); }

void require(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

// Argument: steps in a tick of 0.1 s.
void at_equal_steps(benchmark::State& state) {
  const int parts = static_cast<int>(state.range(0));
  Flown we, limit, they;
  for (auto _ : state) we.again(ours(parts)), limit.again(bare(parts)), they.again(ode(parts));
  require(error(we) < error(limit) + 1e-9 && error(they) < 20, "somebody lost the way");
  state.counters["us_bare"] = us(limit, parts);
  state.counters["us_ode"] = us(they, parts);
  state.counters["mm_ours"] = 1e3 * error(we);
  state.counters["mm_bare"] = 1e3 * error(limit);
  state.counters["mm_ode"] = 1e3 * error(they);
  state.counters["of_bare"] = limit.seconds / we.seconds;
  state.counters["real_time"] = ticks * tick / we.seconds;
  state.counters["real_time_bare"] = ticks * tick / limit.seconds;
  state.counters["real_time_ode"] = ticks * tick / they.seconds;
}
BENCHMARK(at_equal_steps)
    ->ArgName("parts")
    ->Arg(1)
    ->Arg(2)
    ->Arg(4)
    ->Arg(10)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(5)
    ->MeasureProcessCPUTime();

template <class Fly>
int fewest_parts(double limit, Fly fly) {
  for (int parts = 1; parts <= 100; ++parts) {
    if (error(fly(parts)) <= limit) return parts;
  }
  throw std::logic_error("no step is short enough");
}

// Steps as long as an error of 0.2 mm allows. ODE's method of first order would need millions: it takes 0.1 ms.
void within_a_fifth_of_a_millimetre(benchmark::State& state) {
  const int parts = fewest_parts(2e-4, ours), bare_parts = fewest_parts(2e-4, bare), ode_parts = 1000;
  Flown we, limit, they;
  for (auto _ : state) {
    for (int i = 0; i < 20; ++i) we.again(ours(parts)), limit.again(bare(bare_parts));
    they.again(ode(ode_parts));
  }
  require(error(we) <= 2e-4 && error(limit) <= 2e-4, "an error changed");
  state.counters["ms_step_ours"] = 1e3 * tick / parts;
  state.counters["ms_step_bare"] = 1e3 * tick / bare_parts;
  state.counters["ms_step_ode"] = 1e3 * tick / ode_parts;
  state.counters["mm_ours"] = 1e3 * error(we);
  state.counters["mm_bare"] = 1e3 * error(limit);
  state.counters["mm_ode"] = 1e3 * error(they);
  state.counters["speed"] = they.seconds / we.seconds;
  state.counters["of_bare"] = limit.seconds / we.seconds;
  state.counters["real_time"] = ticks * tick / we.seconds;
  state.counters["real_time_bare"] = ticks * tick / limit.seconds;
  state.counters["real_time_ode"] = ticks * tick / they.seconds;
}
BENCHMARK(within_a_fifth_of_a_millimetre)->Unit(benchmark::kMillisecond)->Iterations(1)->MeasureProcessCPUTime();

#ifdef MUSTER_HAS_MUJOCO
// Against the goal's own peer: at steps as long as an error of 0.2 mm allows either side, and at equal ones (10 ms).
void beside_mujoco(benchmark::State& state) {
  constexpr int equal = 10;
  const int parts = fewest_parts(2e-4, ours), mujoco_parts = fewest_parts(2e-4, mujoco);
  Flown we, they, we_at_equal, they_at_equal;
  for (auto _ : state) {
    for (int i = 0; i < 20; ++i) we.again(ours(parts)), we_at_equal.again(ours(equal));
    for (int i = 0; i < 3; ++i) they.again(mujoco(mujoco_parts)), they_at_equal.again(mujoco(equal));
  }
  require(error(we) <= 2e-4 && error(they) <= 2e-4, "an error changed");
  state.counters["ms_step_ours"] = 1e3 * tick / parts;
  state.counters["ms_step_mujoco"] = 1e3 * tick / mujoco_parts;
  state.counters["mm_ours"] = 1e3 * error(we);
  state.counters["mm_mujoco"] = 1e3 * error(they);
  state.counters["us_mujoco"] = us(they, mujoco_parts);
  state.counters["speed"] = they.seconds / we.seconds;
  state.counters["mm_ours_equal"] = 1e3 * error(we_at_equal);
  state.counters["mm_mujoco_equal"] = 1e3 * error(they_at_equal);
  state.counters["speed_equal"] = they_at_equal.seconds / we_at_equal.seconds;
}
BENCHMARK(beside_mujoco)->Unit(benchmark::kMillisecond)->Iterations(1)->MeasureProcessCPUTime();
#endif

// Whole worlds: 100 Hummingbirds that hover, each with its three controllers and seen by cameras, in ticks of 10 ms.
void world_with(benchmark::State& state, const std::string& backend) {
  const TemporaryFolder folder;
  std::ofstream file(folder.path() / "world.xml");
  file << "<world dt=\"0.01\" until=\"10\">\n<robots.mocap/>" << backend << "\n";
  for (int i = 0; i < birds; ++i) {
    const std::string name = "r" + std::to_string(i);
    file << "<robot name=\"" << name << "\" model=\"hummingbird\" at=\"" << 2 * (i % 10) << ' ' << 2 * (i / 10)
         << " 0.06\"/><control.path3d name=\"lead_" << name << "\" robot=\"" << name << "\" path=\"" << name
         << ".csv\"/><control.velocity3d name=\"fly_" << name << "\" robot=\"" << name << "\"/>\n";
    std::ofstream(folder.path() / (name + ".csv")) << "x[m],y[m],z[m]\n"
                                                   << 2 * (i % 10) << ',' << 2 * (i / 10) << ",2\n";
  }
  file << "</world>\n";
  file.close();
  Flown whole;
  for (auto _ : state) {
    Simulation run(read_world(folder.path(), standard()), standard(), {{MUSTER_PLUGINS_DIR}, 1, {}});
    const double before = cpu_seconds();
    while (!run.done()) run.step();
    whole.again({cpu_seconds() - before, {}});
    const TableView pose = run.table("robot/*/pose");
    for (int i = 0; i < birds; ++i) require(std::abs(pose.at(i, 2) - 2) < 0.05, "somebody does not hover");
  }
  state.counters["us_robot_tick"] = 1e6 * whole.seconds / (birds * 1000);
  state.counters["real_time"] = 10 / whole.seconds;
}

}  // namespace

int main(int argc, char** argv) {
  for (const auto& [name, backend] :
       {std::pair("simbody", "<physics.simbody step='0.01'/>"), std::pair("simbody_1ms", "<physics.simbody/>"),
        std::pair("ode_1ms", "<physics.ode/>")}) {
    benchmark::RegisterBenchmark((std::string("world_with/") + name).c_str(), world_with, std::string(backend))
        ->Unit(benchmark::kMillisecond)
        ->Iterations(2)
        ->MeasureProcessCPUTime();
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
}
