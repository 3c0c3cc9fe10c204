// What any physics backend must keep, known by nothing but its file and what it claims in the table below.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <map>

#include "description/robot.hpp"
#include "tests/run_world.hpp"

namespace muster::test {
namespace {

using Attributes = std::map<std::string, std::string>;

struct Backend {
  std::string name, plugin;
  Attributes attributes;
  bool has_step = false;  // shorter than the tick
  // Abilities.
  bool height = false;           // falls and lands
  bool slip = false;             // friction is bounded
  bool torque = false;           // motors are
  bool round_friction = false;   // bounded alike in every direction
  bool load_transfer = false;    // friction's bound knows of the weight that friction itself shifts
  bool rotors = false;           // lift and turn a robot
  int order = 0;                 // of convergence; 0: the solver's own error hides it
  double coarsest_of_order = 0;  // the step from which it shows [s]
  int flight_order = 0;          // of convergence in the air
  // Tolerances.
  double fall = 0;       // after 1 s of it [m]
  double rest = 0;       // drift in 2 s [m], [rad]
  double arc = 0;        // of the radius, relative
  double course = 0;     // at the end of 4 s of S-bends in ticks of 10 ms [m]
  double ramp = 0;       // of 1 m of speeding up [m]
  double climb = 0;      // of 5 m in 1 s, by rotors that speed up from rest [m]
  double spin = 0;       // of the momentum of tumbling for 2 s, relative
  double collision = 0;  // of the momentum of two that meet in the air, relative
  double bounce = 0;     // after a fall of 0.3 m [m/s]
  double force = 0;      // of a sliding distance, and of an acceleration at the limit of torque, relative
};
void PrintTo(const Backend& backend, std::ostream* out) { *out << backend.name; }

std::vector<Backend> table() {
  Backend simbody{"simbody", "physics.simbody", {}, true};
  simbody.height = simbody.slip = simbody.torque = simbody.round_friction = simbody.load_transfer = true;
  simbody.rotors = true;
  simbody.order = 2, simbody.coarsest_of_order = 0.08, simbody.flight_order = 4;
  simbody.fall = 1e-6, simbody.rest = 1e-6, simbody.arc = 1e-3, simbody.course = 1e-4, simbody.ramp = 1e-3;
  simbody.climb = 1e-7, simbody.spin = 1e-11, simbody.collision = 1e-6, simbody.bounce = 0.02, simbody.force = 0.01;

  Backend ode{"ode_exact", "physics.ode", {}, true};
  ode.height = ode.slip = ode.torque = ode.rotors = true;
  ode.order = 2, ode.coarsest_of_order = 0.04, ode.flight_order = 1;
  ode.fall = 5e-3, ode.rest = 1e-6, ode.arc = 1e-3, ode.course = 1e-4, ode.ramp = 1e-3, ode.force = 0.01;
  ode.climb = 5e-3, ode.spin = 3e-3, ode.collision = 1e-12, ode.bounce = 0.8;

  Backend quick = ode;
  quick.name = "ode_quick", quick.attributes = {{"solver", "quick"}};
  quick.load_transfer = true;
  quick.order = 0;
  quick.bounce = 0.1;
  quick.rest = 3e-3, quick.arc = 1e-2, quick.course = 5e-3, quick.ramp = 0.015, quick.force = 0.02;

  Backend planar{"planar", "physics.planar", {}};
  planar.order = 2, planar.coarsest_of_order = 0.08;
  planar.rest = 1e-12, planar.arc = 1e-9, planar.course = 1e-4, planar.ramp = 1e-6;
  return {simbody, ode, quick, planar};
}

// Of the table, what was built.
std::vector<Backend> backends() {
  std::vector<Backend> result;
  for (const Backend& backend : table()) {
    std::string file = backend.plugin;
    file[file.find('.')] = '_';
    if (std::filesystem::exists(MUSTER_PLUGINS_DIR "/" + file + ".so")) result.push_back(backend);
  }
  return result;
}

InstanceDeclaration instance(const Backend& backend, const Attributes& more = {}) {
  InstanceDeclaration made;
  made.plugin = backend.plugin;
  for (const Attributes& list : {backend.attributes, more}) {
    for (const auto& [name, value] : list) made.attributes.push_back({name, value, {}, {}});
  }
  return made;
}

// No steps shorter than the tick.
Attributes whole_ticks(const Backend& backend) { return backend.has_step ? Attributes{{"step", "0.1"}} : Attributes{}; }

std::string print(const Attributes& attributes) {
  std::string text;
  for (const auto& [name, value] : attributes) text += ' ' + name + "='" + value + '\'';
  return text;
}

struct State {
  Pose pose;
  Twist twist;
  double distance(double x, double y) const { return std::hypot(pose.x - x, pose.y - y); }
  double speed() const { return std::hypot(twist.vx, twist.vy, twist.vz); }
};

State state(const Simulation& run, const std::string& robot = "a") {
  return {row<Pose>(run, "robot/" + robot + "/pose"), row<Twist>(run, "robot/" + robot + "/twist")};
}

template <class Row>
bool same_bits(const Row& a, const Row& b) {
  return std::memcmp(&a, &b, sizeof(Row)) == 0;
}

const std::string models = MUSTER_SOURCE_DIR "/plugins/robots/models/";
constexpr double gravity = 9.81, radius = 0.05, half_base = 0.105;
const std::string one = "<robot name='a' at='0 0 0'";

// Robots as <conformance.start> hands them over to the backend, after the first tick.
class Started : public Simulation {
 public:
  Started(const Folder& folder, int workers, InstanceDeclaration backend)
      : Simulation(read_world(folder.path(), standard()), standard(),
                   {{MUSTER_BUILD_DIR "/tests/conformance", MUSTER_PLUGINS_DIR}, workers, {}}) {
    step();
    swap("physics", std::move(backend));
  }
};

class Physics {
 protected:
  Started started(const Backend& backend, const std::string& robots, const Attributes& start, const Attributes& course,
                  double dt = 0.01, int workers = 1, const Attributes& more = {}) const {
    folder.write("world.xml", "<world dt='" + std::to_string(dt) + "' until='600' seed='1'>" + robots +
                                  "<conformance.start name='physics'" + print(start) + "/><conformance.course" +
                                  print(course) + "/></world>");
    return {folder, workers, instance(backend, more)};
  }

  static void run_for(Simulation& run, int ticks) {
    for (int i = 0; i < ticks; ++i) run.step();
  }

  // A Scarab with another number in its <differential> element.
  std::string changed(const std::string& attribute, const std::string& value) const {
    std::string urdf = contents(models + "scarab.urdf");
    const auto at = urdf.find(attribute + "=\"") + attribute.size() + 2;
    urdf.replace(at, urdf.find('"', at) - at, value);
    std::filesystem::copy_file(models + "hokuyo.stl", folder / "hokuyo.stl",
                               std::filesystem::copy_options::skip_existing);
    folder.write(attribute + ".urdf", urdf);
    return " model='" + attribute + ".urdf'";
  }

  const Folder folder;
};

class EachBackend : public Physics, public testing::TestWithParam<Backend> {
 protected:
  Started run(const std::string& robots, const Attributes& start, const Attributes& course, int workers = 1) const {
    return started(GetParam(), robots, start, course, 0.01, workers);
  }
};

TEST_P(EachBackend, FallsFreelyOrSaysThatItCannot) {
  Started sim = run("<robot name='a' at='0 0 20' heading='0.5'/>", {{"forward", "1"}, {"rise", "2"}}, {});
  run_for(sim, 100);
  const double z = state(sim).pose.z;
  if (GetParam().height) {
    EXPECT_NEAR(z, 20 + 2 - gravity / 2, GetParam().fall);
    EXPECT_LT(state(sim).distance(std::cos(0.5), std::sin(0.5)), 1e-6);
  } else {
    EXPECT_EQ(z, 20);
    EXPECT_THAT(sim.events().back().message, testing::HasSubstr("it cannot hold changes of height"));
  }
}

TEST_P(EachBackend, StandsStillAtRest) {
  Started sim = run("<robot name='a' at='3 -2 0' heading='1'/>", {}, {});
  run_for(sim, 200);
  EXPECT_LT(state(sim).distance(3, -2), GetParam().rest);
  EXPECT_NEAR(2 * std::atan2(state(sim).pose.qz, state(sim).pose.qw), 1, GetParam().rest);
  EXPECT_LT(state(sim).speed(), 1e-3);
  EXPECT_NEAR(state(sim).pose.z, 0, 1e-4);
}

TEST_P(EachBackend, RollsOnAnArcOfSpeedOverTurnRate) {
  const double v = 0.3, w = 0.5, r = v / w;
  Started sim = run(one + "/>",
                    {{"forward", "0.3"},
                     {"turn", "0.5"},
                     {"left", std::to_string((v - w * half_base) / radius)},
                     {"right", std::to_string((v + w * half_base) / radius)}},
                    {{"v", "0.3"}, {"w", "0.5"}});
  for (int k = 0; k < 400; ++k) {
    sim.step();
    ASSERT_NEAR(state(sim).distance(0, r), r, GetParam().arc * r) << sim.time();
  }
  const State end = state(sim);
  EXPECT_LT(end.distance(r * std::sin(4 * w), r - r * std::cos(4 * w)), 2 * GetParam().arc);
}

// Thrown with its wheels held, a robot slides as far as friction on what its wheels carry lets it: statics with the
// pull at the ground, the inertia at the centre of mass and a smooth caster behind.
TEST_P(EachBackend, SlidesAsFarAsCoulombSays) {
  const double mu = 0.1, v = 0.5;
  const auto thrown = [&](const std::string& heading) {
    Started sim = run(one + " heading='" + heading + "'" + changed("friction", "0.1") + "/>", {{"forward", "0.5"}}, {});
    run_for(sim, 200);
    return state(sim).distance(0, 0);
  };
  if (!GetParam().slip) {
    const Started sim = run(one + "/>", {}, {});
    EXPECT_THAT(sim.events().back().message, testing::HasSubstr("wheel slip"));  // it cannot hold
    return;
  }
  const auto whole = whole_mass(description::read_robot(models + "scarab.urdf"));
  const double caster = 0.08, behind = -whole.centre.x(), high = whole.centre.z();
  const double shifted = GetParam().load_transfer ? mu * high : 0;
  const double pull = mu * gravity * (caster - behind) / (caster - shifted);
  const double expected = v * v / (2 * pull), along = thrown("0");
  EXPECT_NEAR(along, expected, GetParam().force * expected);
  if (GetParam().round_friction) {
    EXPECT_NEAR(thrown("0.7853981633974483"), along, 1e-3 * along);
  } else {  // a pyramid's corner holds more
    EXPECT_NEAR(thrown("0.7853981633974483"), along / std::sqrt(2.0), 0.05 * along);
  }
}

// Two wheels pull with torque over radius; they also spin up themselves.
TEST_P(EachBackend, AcceleratesAsTorqueAllows) {
  if (!GetParam().torque) return;
  const double torque = 0.2, wheel_inertia = 0.00025;
  Started sim = run(one + changed("max_torque", "0.2") + "/>", {}, {{"v", "9"}});
  run_for(sim, 50);
  const double expected = 2 * torque / radius / (8 + 2 * wheel_inertia / (radius * radius));
  EXPECT_NEAR(state(sim).twist.vx / 0.5, expected, GetParam().force * expected);
}

// Held over the tick or with a slope: the same commands at the ticks' ends, half a tick apart.
TEST_P(EachBackend, TakesHeldAndRatedCommandsInMidStep) {
  std::map<std::string, double> way;
  for (const std::string rated : {"true", "false"}) {
    Started sim =
        started(GetParam(), one + "/>", {}, {{"a", "0.5"}, {"rated", rated}}, 0.01, 1, whole_ticks(GetParam()));
    run_for(sim, 200);
    way[rated] = state(sim).pose.x;
  }
  EXPECT_NEAR(way["true"], 1, GetParam().ramp);
  EXPECT_NEAR(way["true"] - way["false"], 0.005, 1e-3);
}

// Ideal wheels on the course v = 0.25 + 0.15 sin(1.3 t), w = 0.8 sin(0.9 t), by fine quadrature.
std::array<double, 2> ideal_course(double until) {
  const int n = 100000;
  const double h = until / n;
  double x = 0, y = 0;
  for (int k = 0; k < n; ++k) {
    const double t = (k + 0.5) * h, heading = 0.8 / 0.9 * (1 - std::cos(0.9 * t)), v = 0.25 + 0.15 * std::sin(1.3 * t);
    x += h * v * std::cos(heading);
    y += h * v * std::sin(heading);
  }
  return {x, y};
}

const Attributes bends = {{"v", "0.25"}, {"dv", "0.15"}, {"dw", "0.8"}},
                 rolling = {{"forward", "0.25"}, {"left", "5"}, {"right", "5"}};

State after_bends(Started sim, double h) {
  for (int k = 0; k < std::lround(4 / h); ++k) sim.step();
  return state(sim);
}

TEST_P(EachBackend, FollowsIdealWheels) {
  const auto [x, y] = ideal_course(4);
  EXPECT_LT(after_bends(run(one + "/>", rolling, bends), 0.01).distance(x, y), GetParam().course);
}

TEST_P(EachBackend, ConvergesInItsOrder) {
  if (GetParam().order == 0) return;
  const auto [x, y] = ideal_course(4);
  std::vector<double> errors;
  for (const double share : {1.0, 0.5, 0.25}) {
    const double h = share * GetParam().coarsest_of_order;
    const State end = after_bends(started(GetParam(), one + "/>", rolling, bends, h, 1, whole_ticks(GetParam())), h);
    errors.push_back(end.distance(x, y));
  }
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), GetParam().order, 0.3) << errors[0] << ' ' << errors[1];
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), GetParam().order, 0.3) << errors[1] << ' ' << errors[2];
}

const std::string two = one + " heading='0.3'/><robot name='b' at='3 1 0' heading='2'/>";

// Hard enough that wheels slip: what a solver remembers counts.
std::string slippery(const std::string& model) { return one + model + "/><robot name='b' at='3 1 0'" + model + "/>"; }
const Attributes wild = {{"v", "0.4"}, {"dv", "0.3"}, {"a", "0.2"}, {"dw", "3"}};

TEST_P(EachBackend, GivesTheSameBitsForAnyWorkersAndAfterRemaking) {
  const std::string robots = slippery(changed("friction", "0.05"));
  Started straight = run(robots, {}, wild);
  run_for(straight, 100);
  for (const int workers : {2, 3}) {
    Started other = run(robots, {}, wild, workers);
    run_for(other, 100);
    EXPECT_EQ(straight.digest(), other.digest()) << workers;
  }
  Started remade = run(robots, {}, wild);
  while (remade.tick() < straight.tick()) {
    if (remade.tick() % 17 == 5) remade.remake("physics");
    remade.step();
  }
  EXPECT_EQ(straight.digest(), remade.digest());
}

TEST_P(EachBackend, RestoredInMidRunItGoesOnWithTheSameBits) {
  const std::string robots = slippery(changed("friction", "0.05"));
  Started sim = run(robots, {}, wild), again = run(robots, {}, wild);
  run_for(sim, 40);
  sim.snapshot().save(folder / "then");
  run_for(sim, 40);
  EXPECT_NE(sim.digest(), again.digest());
  again.restore(Snapshot::load(folder / "then"));
  run_for(again, 40);
  EXPECT_EQ(sim.digest(), again.digest());
}

// A Hummingbird in the air, and what its rotors are asked for.
std::string bird(const std::string& name, const std::string& at) {
  return "<robot name='" + name + "' model='hummingbird' heading='0.4' at='" + at + "'/>";
}
std::string lift(double rate, double swing = 0) {
  return "<conformance.lift rate='" + std::to_string(rate) + "' swing='" + std::to_string(swing) + "'/>";
}

// Rotors that lag speed up from rest, so that thrust grows as (1 - exp(-t / lag))^2: twice integrated.
TEST_P(EachBackend, ClimbsAsItsRotorsSpeedUpOrRefusesWithTheList) {
  const std::string world = bird("a", "1 2 20") + lift(600);
  if (!GetParam().rotors) {
    try {
      run(world, {}, {});
      FAIL() << "nothing was thrown";
    } catch (const Error& error) {
      EXPECT_EQ(error.exit(), Exit::invalid_input);
      EXPECT_THAT(error.what(), testing::HasSubstr("it lacks what the world's robots need: robot 'a' (model "
                                                   "'hummingbird') needs rotors (<quadrotor>), "));
    }
    return;
  }
  Started sim = run(world, {}, {});
  run_for(sim, 100);
  const auto robot = description::read_robot(models + "hummingbird.urdf");
  const double t = 1, lag = robot.quadrotor->lag_up;
  const double rise = t * t / 2 - 2 * lag * (t - lag * (1 - std::exp(-t / lag))) +
                      lag / 2 * (t - lag / 2 * (1 - std::exp(-2 * t / lag)));
  const double up = 4 * robot.quadrotor->thrust_factor * 600 * 600 / whole_mass(robot).mass;
  EXPECT_NEAR(state(sim).pose.z, 20 + up * rise - gravity * t * t / 2, GetParam().climb);
  EXPECT_LT(state(sim).distance(1, 2), 1e-9);
}

// Lifted beside its centre of mass by rotors that speed up together, it rolls as their thrust's moment says.
TEST_P(EachBackend, RollsWhereItIsLiftedBesideItsCentreOfMass) {
  if (!GetParam().rotors) return;
  std::string urdf = contents(models + "hummingbird.urdf");
  const std::string body = "<mass value=\"0.68\"/>";
  urdf.insert(urdf.find(body), "<origin xyz=\"0 0.002 0\"/>");
  const auto robot = description::read_robot(folder.write("uneven.urdf", urdf).string());
  Started sim = run("<robot name='a' model='uneven.urdf' at='0 0 50'/>" + lift(600), {}, {});
  run_for(sim, 30);
  const auto whole = whole_mass(robot);
  const double t = 0.3, lag = robot.quadrotor->lag_up;
  const double rise = t * t / 2 - 2 * lag * (t - lag * (1 - std::exp(-t / lag))) +
                      lag / 2 * (t - lag / 2 * (1 - std::exp(-2 * t / lag)));
  const double moment = -whole.centre.y() * 4 * robot.quadrotor->thrust_factor * 600 * 600;
  const double roll = moment / whole.inertia(0, 0) * rise;
  const Pose p = state(sim).pose;
  EXPECT_NEAR(2 * std::atan2(p.qx, p.qw), roll, 0.02 * std::abs(roll));
}

TEST_P(EachBackend, TumblesWithItsMomentum) {
  if (!GetParam().rotors) return;
  const auto whole = whole_mass(description::read_robot(models + "hummingbird.urdf"));
  Started sim = run(bird("a", "0 0 50") + lift(0), {{"forward", "1"}, {"tumble", "4"}, {"turn", "3"}}, {});
  const auto turned = [&] {
    const Pose p = state(sim).pose;
    return Eigen::Quaterniond(p.qw, p.qx, p.qy, p.qz);
  };
  const auto momentum = [&]() -> Eigen::Vector3d {
    const Twist t = state(sim).twist;
    return turned() * (whole.inertia * (turned().conjugate() * Eigen::Vector3d(t.wx, t.wy, t.wz)));
  };
  const Eigen::Vector3d before = momentum();
  const Eigen::Quaterniond stood = turned();
  run_for(sim, 200);
  EXPECT_LT((momentum() - before).norm(), GetParam().spin * before.norm());
  EXPECT_GT(turned().angularDistance(stood), 0.1);
}

// Two that fall and meet on the way, not quite head on: what they push each other sideways adds up to nothing.
TEST_P(EachBackend, KeepsMomentumInACollision) {
  if (!GetParam().rotors) return;
  const auto whole = whole_mass(description::read_robot(models + "hummingbird.urdf"));
  const std::string other = "<robot name='b' model='hummingbird' heading='3.5' at='1 0.12 50'/>";
  Started sim = run(bird("a", "0 0 50") + other + lift(0), {{"forward", "1"}}, {});
  const auto momentum = [&](const std::string& robot) -> Eigen::Vector3d {
    const State s = state(sim, robot);
    const Eigen::Quaterniond q(s.pose.qw, s.pose.qx, s.pose.qy, s.pose.qz);
    const Eigen::Vector3d v(s.twist.vx, s.twist.vy, s.twist.vz), w(s.twist.wx, s.twist.wy, s.twist.wz);
    return whole.mass * (v + w.cross(q * whole.centre));
  };
  const Eigen::Vector3d alone = momentum("a"), both = alone + momentum("b");
  run_for(sim, 120);
  EXPECT_LT((momentum("a") + momentum("b") - both).head<2>().norm(), GetParam().collision * alone.norm());
  EXPECT_GT((momentum("a") - alone).head<2>().norm(), 0.3 * alone.norm());  // they did meet
}

// What lands at 2.4 m/s hardly rises again: impacts are plastic, as far as a solver knows how.
TEST_P(EachBackend, LandsWithoutBouncing) {
  if (!GetParam().height) return;
  Started sim = run("<robot name='a' at='0 0 0.3'/>", {}, {});
  bool landed = false;
  double fastest = 0;
  for (int k = 0; k < 100; ++k) {
    sim.step();
    landed |= state(sim).pose.z < 0.01;
    if (landed) fastest = std::max(fastest, state(sim).twist.vz);
  }
  EXPECT_TRUE(landed);
  EXPECT_LT(fastest, GetParam().bounce);
}

TEST_P(EachBackend, ConvergesInItsOrderInTheAir) {
  if (GetParam().flight_order == 0) return;
  const auto end = [&](double step) {
    Started sim = started(GetParam(), bird("a", "0 0 50") + lift(460, 6), {{"forward", "1"}, {"tumble", "0.5"}}, {},
                          0.2, 1, {{"step", std::to_string(step)}});
    run_for(sim, 10);
    const Pose p = state(sim).pose;
    return Eigen::Vector3d(p.x, p.y, p.z);
  };
  const Eigen::Vector3d truth = end(0.0002);
  std::vector<double> errors;
  const double coarsest = GetParam().flight_order > 2 ? 0.0125 : 0.00625;
  for (const double share : {1.0, 0.5, 0.25}) errors.push_back((end(share * coarsest) - truth).norm());
  EXPECT_NEAR(std::log2(errors[0] / errors[1]), GetParam().flight_order, 0.3) << errors[0] << ' ' << errors[1];
  EXPECT_NEAR(std::log2(errors[1] / errors[2]), GetParam().flight_order, 0.3) << errors[1] << ' ' << errors[2];
}

// One takes off from the ground, one flies beside a Scarab that drives.
const std::string air = bird("a", "0 0 0.06") + bird("b", "3 0 4") + "<robot name='c' at='0 4 0'/>" + lift(470, 20);

TEST_P(EachBackend, GivesTheSameBitsInTheAirForAnyWorkersRemadeAndRestored) {
  if (!GetParam().rotors) return;
  Started straight = run(air, {}, wild);
  run_for(straight, 40);
  straight.snapshot().save(folder / "then");
  run_for(straight, 40);
  Started three = run(air, {}, wild, 3);
  run_for(three, 80);
  EXPECT_EQ(straight.digest(), three.digest());
  Started restored = run(air, {}, wild);
  restored.restore(Snapshot::load(folder / "then"));
  run_for(restored, 40);
  EXPECT_EQ(straight.digest(), restored.digest());
  Started remade = run(air, {}, wild);
  while (remade.tick() < straight.tick()) {
    if (remade.tick() % 17 == 5) remade.remake("physics");
    remade.step();
  }
  EXPECT_EQ(straight.digest(), remade.digest());
}

std::string test_name(const testing::TestParamInfo<Backend>& info) { return info.param.name; }
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(EachBackend);
INSTANTIATE_TEST_SUITE_P(Plugins, EachBackend, testing::ValuesIn(backends()), test_name);

using FromTo = std::tuple<Backend, Backend>;
class EachSwap : public Physics, public testing::TestWithParam<FromTo> {};

// One step under the bound that friction sets, from velocities that may stand up to dt before their pose.
void expect_no_jump(const State& a, const State& b, double dt) {
  const double bound = 0.8 * gravity;
  EXPECT_LE(std::hypot(b.twist.vx - a.twist.vx, b.twist.vy - a.twist.vy), bound * dt);
  EXPECT_LE(b.distance(a.pose.x + a.twist.vx * dt, a.pose.y + a.twist.vy * dt), bound * dt * dt);
  EXPECT_LE(std::abs(b.pose.z - a.pose.z), 1e-4);
}

TEST_P(EachSwap, NothingJumps) {
  const auto& [from, to] = GetParam();
  Started sim = started(from, two, rolling, bends);
  run_for(sim, 150);
  const State a = state(sim), b = state(sim, "b");
  sim.swap("physics", instance(to));
  for (const auto& [before, after] : {std::pair(a, state(sim)), std::pair(b, state(sim, "b"))}) {
    EXPECT_TRUE(same_bits(before.pose, after.pose));
    EXPECT_TRUE(same_bits(before.twist, after.twist));
  }
  sim.step();
  expect_no_jump(a, state(sim), 0.01);
  expect_no_jump(b, state(sim, "b"), 0.01);
  run_for(sim, 50);
  EXPECT_GT(row<Wheels>(sim, "robot/a/wheels").left, 10);  // angles went on
}

TEST_P(EachSwap, NothingJumpsInTheAir) {
  const auto& [from, to] = GetParam();
  if (!from.rotors || !to.rotors) return;
  Started sim = started(from, air, {}, wild);
  run_for(sim, 60);
  const State before = state(sim, "b");
  const auto rotors = row<Rotors>(sim, "robot/b/rotors");
  sim.swap("physics", instance(to));
  EXPECT_TRUE(same_bits(before.pose, state(sim, "b").pose));
  EXPECT_TRUE(same_bits(before.twist, state(sim, "b").twist));
  EXPECT_TRUE(same_bits(rotors, row<Rotors>(sim, "robot/b/rotors")));
  sim.step();
  const State after = state(sim, "b");
  const double dt = 0.01, fastest_change = 4 * gravity;  // thrust is at most 3.4 times the weight
  EXPECT_LT(
      std::hypot(after.twist.vx - before.twist.vx, after.twist.vy - before.twist.vy, after.twist.vz - before.twist.vz),
      fastest_change * dt);
  EXPECT_LT(std::hypot(after.pose.x - before.pose.x - before.twist.vx * dt,
                       after.pose.y - before.pose.y - before.twist.vy * dt,
                       after.pose.z - before.pose.z - before.twist.vz * dt),
            fastest_change * dt * dt);
  EXPECT_NEAR(row<Rotors>(sim, "robot/b/rotors").front, rotors.front, 20);
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(EachSwap);
INSTANTIATE_TEST_SUITE_P(Plugins, EachSwap,
                         testing::Combine(testing::ValuesIn(backends()), testing::ValuesIn(backends())),
                         [](const auto& pair) {
                           return std::get<0>(pair.param).name + "_to_" + std::get<1>(pair.param).name;
                         });

// Whatever moves robots without being given a file is in the table.
TEST(Backends, AreAllHeldToThis) {
  std::vector<std::string> known;
  for (const Backend& backend : table()) known.push_back(backend.plugin);
  for (const auto& listed : list_plugins({MUSTER_PLUGINS_DIR})) {
    if (!listed.library) continue;
    const muster_plugin& plugin = listed.library->plugins().back();
    bool needs = plugin.phase != MUSTER_PHYSICS;
    for (uint32_t i = 0; i < plugin.param_count; ++i) needs |= (plugin.params[i].flags & MUSTER_REQUIRED) != 0;
    if (!needs) {
      EXPECT_THAT(known, testing::Contains(std::string(listed.library->id())));
    }
  }
}

}  // namespace
}  // namespace muster::test
