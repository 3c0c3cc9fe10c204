// Motion, against the engine that robot simulators use: both sides in one run, by the CPU time of this process, with
// the places where robots end held against the exact unicycle. Goals (the project's): at 10 ms 4 times as fast as ODE's
// dWorldStep and 8 times as exact; 12 times as fast at equal error; 100 times as fast as the usual setting of Gazebo;
// 200 robots at 60 times real time; 3 % of a step for the plugin boundary. Counters: us_* of a robot-step, mm_* the
// worst robot's error in the end, speed and error ratios (above 1: ours is better), real_time: simulated over CPU time.
#include <benchmark/benchmark.h>

#include <fstream>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>

#include "cpu_seconds.hpp"
#include "hexapods.hpp"
#include "kernel/simulation.hpp"
#include "plugins/physics_simbody/world.hpp"
#include "raw_ode.hpp"
#include "smooth_coulomb.hpp"
#include "text/number.hpp"
#include "text/temporary_folder.hpp"

namespace {

using namespace muster;
using bench::Arc;
using bench::cpu_seconds;

const description::Robot& scarab() {
  static const auto robot = description::read_robot(MUSTER_SOURCE_DIR "/plugins/robots/models/scarab.urdf");
  return robot;
}

std::vector<Arc> arcs(int count) {
  std::vector<Arc> result;
  for (int i = 0; i < count; ++i) result.push_back(bench::arc(i));
  return result;
}

// Where ideal wheels take a robot, by Simpson's rule on steps that no kink of the course lies in.
std::array<double, 2> ideal(const Arc& arc) {
  constexpr int steps = 20000;
  constexpr double h = bench::until / steps;
  double x = arc.x, y = arc.y, heading = arc.heading;
  for (int k = 0; k < steps; ++k) {
    const double t = k * h, w0 = arc.w(t), w1 = arc.w(t + h / 2), w2 = arc.w(t + h);
    const double middle = heading + h / 24 * (5 * w0 + 8 * w1 - w2), end = heading + h / 6 * (w0 + 4 * w1 + w2);
    const double v0 = arc.v(t), v1 = 4 * arc.v(t + h / 2), v2 = arc.v(t + h);
    x += h / 6 * (v0 * std::cos(heading) + v1 * std::cos(middle) + v2 * std::cos(end));
    y += h / 6 * (v0 * std::sin(heading) + v1 * std::sin(middle) + v2 * std::sin(end));
    heading = end;
  }
  return {x, y};
}

struct Outcome {
  double seconds = std::numeric_limits<double>::infinity();  // of CPU time, the best so far
  double error = 0;                                          // [m], of the robot that is furthest off
  void again(const Outcome& o) { seconds = std::min(seconds, o.seconds), error = o.error; }
};

template <class Place>
double worst(const std::vector<Arc>& course, Place place) {
  double most = 0;
  for (std::size_t i = 0; i < course.size(); ++i) {
    const auto truth = ideal(course[i]);
    const auto end = place(i);
    most = std::max(most, std::hypot(end[0] - truth[0], end[1] - truth[1]));
  }
  return most;
}

std::vector<simbody::RobotState> standing(const std::vector<Arc>& course) {
  std::vector<simbody::RobotState> states;
  for (const Arc& arc : course) states.push_back(simbody::at_rest(arc.x, arc.y, arc.heading));
  return states;
}

std::unique_ptr<simbody::Engine> engine(const description::Robot& robot, std::size_t count, double step) {
  std::vector<simbody::NamedRobot> robots;
  for (std::size_t i = 0; i < count; ++i) robots.push_back({"r" + std::to_string(i), &robot});
  return simbody::make_engine(robots, simbody::Integrator::midpoint, step);
}

void drive(simbody::Engine& engine, const std::vector<Arc>& course, int steps,
           std::vector<simbody::RobotState>& states) {
  const double h = bench::until / steps;
  std::vector<simbody::Command> commands(course.size());
  for (int k = 0; k < steps; ++k) {
    const double begin = k * h, end = (k + 1) * h;
    for (std::size_t i = 0; i < course.size(); ++i) {
      const auto left = bench::rated(course[i].left(begin), course[i].left(end), h);
      const auto right = bench::rated(course[i].right(begin), course[i].right(end), h);
      commands[i] = {left.rate, right.rate, left.slope, right.slope};
    }
    engine.step(h, commands, states);
  }
}

Outcome ours(const std::vector<Arc>& course, int steps) {
  const auto made = engine(scarab(), course.size(), 1);
  auto states = standing(course);
  const double start = cpu_seconds();
  drive(*made, course, steps, states);
  const double seconds = cpu_seconds() - start;
  return {seconds, worst(course, [&](std::size_t i) { return std::array{states[i].pose[0], states[i].pose[1]}; })};
}

bench::RawOde ode_of(const description::Robot& robot, const std::vector<Arc>& course, int iterations) {
  std::vector<bench::RawOde::Start> starts;
  for (const Arc& arc : course) starts.push_back({arc.x, arc.y, arc.heading});
  std::vector<scene::Slab> walls;  // that nobody reaches
  for (int i = 0; i < 8; ++i) {
    const int column = i % 3, row = i / 3;
    const double x = bench::apart * (column + 0.5), y = bench::apart * (row + 0.5);
    walls.push_back({x, y, 0.5, i % 2 ? 1.0 : 0.0, i % 2 ? 0.0 : 1.0, 4, 0.2, 1});
  }
  return {robot, starts, walls, iterations};
}

void drive(bench::RawOde& ode, const std::vector<Arc>& course, int steps) {
  const double h = bench::until / steps;
  for (int k = 0; k < steps; ++k) {
    const double middle = (k + 0.5) * h;
    ode.step(h, [&](std::size_t i) { return std::array{course[i].left(middle), course[i].right(middle)}; });
  }
}

Outcome theirs(const std::vector<Arc>& course, int steps, int iterations = 0) {
  bench::RawOde ode = ode_of(scarab(), course, iterations);
  const double start = cpu_seconds();
  drive(ode, course, steps);
  const double seconds = cpu_seconds() - start;
  return {seconds, worst(course, [&](std::size_t i) { return ode.pose(i); })};
}

double us(const Outcome& outcome, std::size_t robots, int steps) {
  return 1e6 * outcome.seconds / (static_cast<double>(robots) * steps);
}

void require(bool holds, const char* what) {
  if (!holds) throw std::logic_error(what);
}

// Argument: robots.
void at_10_ms_against_ode(benchmark::State& state) {
  const auto course = arcs(static_cast<int>(state.range(0)));
  constexpr int steps = 1000;
  Outcome we, they;
  for (auto _ : state) we.again(ours(course, steps)), they.again(theirs(course, steps));
  require(we.error < 1e-4 && they.error < 1e-2, "somebody lost the way");
  state.counters["us_ours"] = us(we, course.size(), steps);
  state.counters["us_ode"] = us(they, course.size(), steps);
  state.counters["mm_ours"] = 1e3 * we.error;
  state.counters["mm_ode"] = 1e3 * they.error;
  state.counters["speed"] = they.seconds / we.seconds;
  state.counters["error"] = they.error / we.error;
  state.counters["real_time"] = bench::until / we.seconds;
  state.counters["real_time_ode"] = bench::until / they.seconds;
}
BENCHMARK(at_10_ms_against_ode)
    ->ArgName("robots")
    ->Arg(50)
    ->Arg(200)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(5)
    ->MeasureProcessCPUTime();

// 50 iterations of the quick solver at 1 ms, against ours at 10 ms.
void against_gazebos_setting(benchmark::State& state) {
  const auto course = arcs(50);
  Outcome we, they;
  for (auto _ : state) {
    for (int i = 0; i < 5; ++i) we.again(ours(course, 1000));
    they.again(theirs(course, 10000, 50));
  }
  require(we.error < 1e-4 && they.error < 0.1, "somebody lost the way");
  state.counters["mm_ours"] = 1e3 * we.error;
  state.counters["mm_ode"] = 1e3 * they.error;
  state.counters["speed"] = they.seconds / we.seconds;
  state.counters["error"] = they.error / we.error;
  state.counters["real_time"] = bench::until / we.seconds;
  state.counters["real_time_ode"] = bench::until / they.seconds;
}
BENCHMARK(against_gazebos_setting)->Unit(benchmark::kMillisecond)->Iterations(1)->MeasureProcessCPUTime();

std::vector<std::array<double, 2>> ends_of_ours(const description::Robot& robot, const std::vector<Arc>& course,
                                                int steps) {
  const auto made = engine(robot, course.size(), 1);
  auto states = standing(course);
  drive(*made, course, steps, states);
  std::vector<std::array<double, 2>> result;
  for (const auto& state : states) result.push_back({state.pose[0], state.pose[1]});
  return result;
}

std::vector<std::array<double, 2>> ends_of_ode(const description::Robot& robot, const std::vector<Arc>& course,
                                               int steps) {
  bench::RawOde ode = ode_of(robot, course, 0);
  drive(ode, course, steps);
  std::vector<std::array<double, 2>> result;
  for (std::size_t i = 0; i < course.size(); ++i) result.push_back({ode.pose(i)[0], ode.pose(i)[1]});
  return result;
}

// Wheels that slip. Argument: friction in thousandths. percent_*: how far the worst of 50 robots ends from where
// Coulomb's isotropic law has it, of how far slip takes the worst one from its course (mm_slipped); uncertain: of that
// law's own integration.
void slip_against_coulomb(benchmark::State& state) {
  description::Robot robot = scarab();
  robot.drive->friction = 1e-3 * static_cast<double>(state.range(0));
  const auto course = arcs(50);
  const auto law = [&](std::size_t i, const bench::SmoothCoulomb::Fineness& fineness) {
    return bench::SmoothCoulomb(robot, robot.drive->friction, fineness).drive(course[i]);
  };
  for (auto _ : state) {
    const auto we = ends_of_ours(robot, course, 1000), we_fine = ends_of_ours(robot, course, 10000),
               they = ends_of_ode(robot, course, 1000), they_fine = ends_of_ode(robot, course, 10000);
    std::map<std::string, double> most;
    for (std::size_t i = 0; i < course.size(); ++i) {
      const auto truth = law(i, {});
      const auto see = [&](const std::string& what, const std::array<double, 2>& end) {
        most[what] = std::max(most[what], std::hypot(end[0] - truth[0], end[1] - truth[1]));
      };
      see("slipped", ideal(course[i]));
      see("uncertain", law(i, bench::SmoothCoulomb::Fineness().coarser()));
      see("ours_10_ms", we[i]);
      see("ours_1_ms", we_fine[i]);
      see("ode_10_ms", they[i]);
      see("ode_1_ms", they_fine[i]);
    }
    require(most["uncertain"] < 0.01 * most["slipped"], "the law is not known well enough");
    state.counters["mm_slipped"] = 1e3 * most["slipped"];
    for (const auto& [what, error] : most) {
      if (what != "slipped") state.counters["percent_" + what] = 100 * error / most["slipped"];
    }
  }
}
BENCHMARK(slip_against_coulomb)
    ->ArgName("friction")
    ->Arg(30)
    ->Arg(50)
    ->Arg(100)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(1)
    ->MeasureProcessCPUTime();

// The fewest steps that stay below a limit of error. Kinks of the course lie between steps.
template <class Run>
int fewest_steps(double limit, Run run) {
  for (int a_half_second = 5; a_half_second <= 2000; a_half_second += 1 + a_half_second / 12) {
    const int steps = 20 * a_half_second;
    if (run(steps).error <= limit) return steps;
  }
  throw std::logic_error("no step is short enough");
}

// Argument: the limit of error in micrometres.
void at_equal_error_against_ode(benchmark::State& state) {
  const double limit = 1e-6 * static_cast<double>(state.range(0));
  const auto course = arcs(50);
  const int our_steps = fewest_steps(limit, [&](int steps) { return ours(course, steps); });
  const int their_steps = fewest_steps(limit, [&](int steps) { return theirs(course, steps); });
  Outcome we, they;
  for (auto _ : state) we.again(ours(course, our_steps)), they.again(theirs(course, their_steps));
  require(we.error <= limit && they.error <= limit, "an error changed");
  state.counters["ms_step_ours"] = 1e3 * bench::until / our_steps;
  state.counters["ms_step_ode"] = 1e3 * bench::until / their_steps;
  state.counters["mm_ours"] = 1e3 * we.error;
  state.counters["mm_ode"] = 1e3 * they.error;
  state.counters["speed"] = they.seconds / we.seconds;
  state.counters["real_time"] = bench::until / we.seconds;
}
BENCHMARK(at_equal_error_against_ode)
    ->ArgName("um")
    ->Arg(350)
    ->Arg(1000)
    ->Unit(benchmark::kMillisecond)
    ->Iterations(5)
    ->MeasureProcessCPUTime();

Simulation world_of(const std::vector<Arc>& course, const std::string& backend) {
  const TemporaryFolder folder;
  std::ofstream file(folder.path() / "world.xml");
  file << "<world dt=\"0.01\" until=\"" << bench::until << "\">\n";
  for (std::size_t i = 0; i < course.size(); ++i) {
    file << "<robot name=\"r" << i << "\" at=\"" << print_real(course[i].x) << ' ' << print_real(course[i].y)
         << " 0\" heading=\"" << print_real(course[i].heading) << "\"/>\n";
  }
  file << "<bench.arcs/>" << backend << "</world>\n";
  file.close();
  return {read_world(folder.path(), standard()), standard(), {{MUSTER_BENCH_PLUGINS, MUSTER_PLUGINS_DIR}, 1, {}}};
}

// What a kernel, a blackboard and a plugin's border cost around the engine; the engine alone does the same, bit for
// bit. Arguments: robots; steps of the engine in a tick of 10 ms. boundary: the share that comes on top.
void boundary(benchmark::State& state) {
  const auto course = arcs(static_cast<int>(state.range(0)));
  const double step = 0.01 / static_cast<double>(state.range(1));
  const std::string backend = "<physics.simbody step=\"" + print_real(step) + "\"/>";
  constexpr int ticks = 1000;
  Outcome alone, whole;
  for (auto _ : state) {
    const auto made = engine(scarab(), course.size(), step);
    auto states = standing(course);
    double start = cpu_seconds();
    drive(*made, course, ticks, states);
    alone.again({cpu_seconds() - start, 0});

    Simulation run = world_of(course, backend);
    start = cpu_seconds();
    while (!run.done()) run.step();
    whole.again({cpu_seconds() - start, 0});
    const TableView pose = run.table("robot/*/pose");
    for (std::size_t i = 0; i < course.size(); ++i) {
      for (std::size_t c = 0; c < 7; ++c) require(pose.at(i, c) == states[i].pose[c], "the world went another way");
    }
  }
  state.counters["us_alone"] = us(alone, course.size(), ticks);
  state.counters["us_whole"] = us(whole, course.size(), ticks);
  state.counters["boundary"] = whole.seconds / alone.seconds - 1;
}
BENCHMARK(boundary)
    ->ArgNames({"robots", "steps"})
    ->Args({50, 1})
    ->Args({200, 1})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(25)
    ->MeasureProcessCPUTime();
BENCHMARK(boundary)
    ->ArgNames({"robots", "steps"})
    ->Args({50, 10})
    ->Unit(benchmark::kMillisecond)
    ->Iterations(7)
    ->MeasureProcessCPUTime();

// Whole worlds of 50 robots in ticks of 10 ms, with each backend.
void world_with(benchmark::State& state, const std::string& backend) {
  const auto course = arcs(50);
  Outcome whole;
  for (auto _ : state) {
    Simulation run = world_of(course, backend);
    const double start = cpu_seconds();
    while (!run.done()) run.step();
    const double seconds = cpu_seconds() - start;
    const TableView pose = run.table("robot/*/pose");
    whole.again({seconds, worst(course, [&](std::size_t i) { return std::array{pose.at(i, 0), pose.at(i, 1)}; })});
  }
  require(whole.error < 0.1, "the world lost its way");
  state.counters["us_robot_tick"] = us(whole, course.size(), 1000);
  state.counters["mm"] = 1e3 * whole.error;
  state.counters["real_time"] = bench::until / whole.seconds;
}

void add_world(const std::string& name, const std::string& backend, int iterations) {
  benchmark::RegisterBenchmark(("world_with/" + name).c_str(), world_with, backend)
      ->Unit(benchmark::kMillisecond)
      ->Iterations(iterations)
      ->MeasureProcessCPUTime();
}

}  // namespace

int main(int argc, char** argv) {
  add_world("simbody", "<physics.simbody step='0.01'/>", 5);
  add_world("simbody_1ms", "<physics.simbody/>", 2);
  add_world("ode_exact", "<physics.ode step='0.01'/>", 5);
  add_world("ode_exact_1ms", "<physics.ode/>", 1);
  add_world("ode_quick_1ms", "<physics.ode solver='quick'/>", 1);
  add_world("planar", "<physics.planar/>", 5);
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
}
