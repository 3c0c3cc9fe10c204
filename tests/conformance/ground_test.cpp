// Robots on wheels, on flat ground: requirements for any backend, identified by its file and its claims alone.
#include "tests/conformance/physics_backends.hpp"

namespace muster::test {
namespace {

class OnTheGround : public EachBackend {
 protected:
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

  std::string bouncing(const std::string& model, double restitution) const {
    std::filesystem::copy_file(models + "hokuyo.stl", folder / "hokuyo.stl",
                               std::filesystem::copy_options::skip_existing);
    std::string urdf = contents(models + model + ".urdf");
    urdf.insert(urdf.find("<muster>") + 7, " restitution=\"" + std::to_string(restitution) + "\"");
    folder.write("bouncing.urdf", urdf);
    return " model='bouncing.urdf' heading='0.3'/>";
  }
};

TEST_P(OnTheGround, FallsFreelyOrSaysThatItCannot) {
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

TEST_P(OnTheGround, StandsStillAtRest) {
  Started sim = run("<robot name='a' at='3 -2 0' heading='1'/>", {}, {});
  run_for(sim, 200);
  EXPECT_LT(state(sim).distance(3, -2), GetParam().rest);
  EXPECT_NEAR(2 * std::atan2(state(sim).pose.qz, state(sim).pose.qw), 1, GetParam().rest);
  EXPECT_LT(state(sim).speed(), 1e-3);
  EXPECT_NEAR(state(sim).pose.z, 0, 1e-4);
}

// One that joins later drives as one that was there from the start; before, it is in nobody's way, and stands still.
TEST_P(OnTheGround, ARobotJoinsLater) {
  const std::string late = "<at t='3'><robot name='late' at='0.4 0 0'/></at>";
  Started sim = run(one + "/>" + late, {}, {{"v", "0.3"}}), alone = run(one + "/>", {}, {{"v", "0.3"}});
  const Pose before = state(sim, "late").pose;
  std::vector<State> way;
  for (int i = 0; i < 299; ++i) sim.step(), alone.step(), way.push_back(state(sim));  // and one to start with
  EXPECT_TRUE(same_bits(before, state(sim, "late").pose));
  const auto off = [&](const State& a, const State& b) { return std::hypot(a.pose.x - b.pose.x, a.pose.y - b.pose.y); };
  EXPECT_LE(off(state(sim), state(alone)), GetParam().course);
  EXPECT_GT(state(sim).pose.x, 0.8);  // it has driven through the other's place
  double farthest = 0;
  for (const State& of_a : way) {
    sim.step();
    State shifted = state(sim, "late");
    shifted.pose.x -= 0.4;
    farthest = std::max(farthest, off(shifted, of_a));
  }
  EXPECT_LE(farthest, 0.01);  // a has its first tick from the plugin that starts it
  EXPECT_GT(state(sim, "late").pose.x, 0.4 + 0.8);
}

// A backend with bodies says so where a robot joins in another.
TEST_P(OnTheGround, ARobotThatJoinsInAnotherIsTold) {
  if (!GetParam().height) GTEST_SKIP() << "claims no height";
  Started sim = run(one + "/><at t='1'><robot name='late' at='0.05 0 0'/></at>", {}, {});
  run_for(sim, 90);
  const auto told = [&] {
    return std::count_if(sim.events().begin(), sim.events().end(), [](const Event& event) {
      return event.message.find("robot 'late' starts in robot 'a'") != std::string::npos;
    });
  };
  EXPECT_EQ(told(), 0);
  run_for(sim, 20);
  EXPECT_EQ(told(), 1);
}

TEST_P(OnTheGround, ARunThatARobotJoinsIsTheSameAgain) {
  const std::string late = "<at t='1'><robot name='late' at='0.4 1 0'/></at><at t='2'><leave robot='late'/></at>";
  for (const int half : {50, 120})
    expect_same_bits([&](int workers) { return run(one + "/>" + late, {}, bends, workers); }, half);
}

TEST_P(OnTheGround, RollsOnAnArcOfSpeedOverTurnRate) {
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

// Thrown with its wheels held, a robot slides as far as friction under its wheels' load allows: statics with the pull
// at the ground, the inertia at the centre of mass and a smooth caster behind.
TEST_P(OnTheGround, SlidesAsFarAsCoulombSays) {
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

// A box (a Hummingbird with stopped rotors) thrown along the ground.
TEST_P(OnTheGround, SlidesAsABoxTheSquareOfItsSpeedOverTwiceFrictionAndGravity) {
  if (!GetParam().rotors) GTEST_SKIP() << "claims no rotors";
  const double mu = 0.3, v = 1, expected = v * v / (2 * mu * gravity);  // the default between bodies and ground
  std::vector<double> headings{0};
  if (GetParam().round_friction) headings = {0, 0.3, 0.7853981633974483, 2};
  for (const double heading : headings) {
    Started sim =
        run("<robot name='a' model='hummingbird' at='0 0 0.06' heading='" + std::to_string(heading) + "'/>" + lift(0),
            {{"forward", "1"}}, {});
    run_for(sim, 100);
    const Pose p = state(sim).pose;
    const double along = p.x * std::cos(heading) + p.y * std::sin(heading);
    EXPECT_NEAR(along, expected, GetParam().slide * expected) << heading;
    EXPECT_NEAR(p.y * std::cos(heading), p.x * std::sin(heading), GetParam().slide * expected) << heading;
  }
}

// Successive highest points above its rest height.
std::vector<double> apexes(Started sim, double ground, std::size_t count) {
  std::vector<double> result;
  double before = state(sim).pose.z;
  for (bool rises = false; result.size() < count && sim.time() < 4;) {
    sim.step();
    const double now = state(sim).pose.z;
    if (rises && now < before) result.push_back(before - ground);
    rises = now > before;
    before = now;
  }
  return result;
}

// Dropped flat from 1 m.
TEST_P(OnTheGround, BouncesToTheSquareOfItsRestitutionOrRefuses) {
  if (!GetParam().bounces_on_wheels) {
    try {
      run("<robot name='a' at='0 0 0'" + bouncing("scarab", 0.5), {}, {});
      FAIL() << "nothing was thrown";
    } catch (const Error& error) {
      EXPECT_EQ(error.exit(), Exit::invalid_input);
      EXPECT_THAT(error.what(), testing::HasSubstr(GetParam().bouncing ? "it bounces on wheels"
                                                                       : "it lacks what the world's robots need: robot "
                                                                         "'a' (model 'scarab') needs bouncing "
                                                                         "(<muster restitution=...>)"));
    }
  }
  if (!GetParam().bouncing) GTEST_SKIP() << "claims no bouncing";
  for (const double e : {0.5, 0.9, 1.0}) {
    const auto dropped = [&](const std::string& model, double ground) {
      const std::string at = "0 0 " + std::to_string(1 + ground);
      return apexes(
          started(GetParam(), "<robot name='a' at='" + at + "'" + bouncing(model, e) + lift(0), {}, {}, 0.002), ground,
          2);
    };
    std::vector<std::vector<double>> all{dropped("hummingbird", 0.06)};
    if (GetParam().bounces_on_wheels) all.push_back(dropped("scarab", 0));
    for (const auto& heights : all) {
      ASSERT_EQ(heights.size(), 2u) << e;
      EXPECT_NEAR(heights[0], e * e, GetParam().apex * e * e) << e;
      EXPECT_NEAR(heights[1], e * e * e * e, GetParam().apex * e * e * e * e) << e;
    }
  }
}

// Thrown so that it tumbles over the ground: no higher than its energy allows.
TEST_P(OnTheGround, BouncesWithTheEnergyThatItHas) {
  if (!GetParam().bouncing) GTEST_SKIP() << "claims no bouncing";
  for (const std::string tumble : {"-7", "-2", "3", "8"}) {
    Started sim = run("<robot name='a' at='0 0 1'" + bouncing("hummingbird", 1) + lift(0),
                      {{"forward", "1"}, {"tumble", tumble}, {"turn", "2"}}, {});
    const auto whole = whole_mass(description::read_robot(models + "hummingbird.urdf"));
    const Eigen::Vector3d spin(std::stod(tumble), 0, 2);
    const double highest = 1 + (0.5 * whole.mass + 0.5 * spin.dot(whole.inertia * spin)) / (whole.mass * gravity);
    double seen = 0;
    for (int k = 0; k < 600; ++k) {
      sim.step();
      seen = std::max(seen, state(sim).pose.z);
    }
    EXPECT_LT(seen, highest * 1.001) << tumble;
  }
}

// Two wheels pull with torque over radius; they also spin up themselves.
TEST_P(OnTheGround, AcceleratesAsTorqueAllows) {
  if (!GetParam().torque) GTEST_SKIP() << "claims no torque";
  const double torque = 0.2, wheel_inertia = 0.00025;
  Started sim = run(one + changed("max_torque", "0.2") + "/>", {}, {{"v", "9"}});
  run_for(sim, 50);
  const double expected = 2 * torque / radius / (8 + 2 * wheel_inertia / (radius * radius));
  EXPECT_NEAR(state(sim).twist.vx / 0.5, expected, GetParam().force * expected);
}

// A robot that lands at 2.4 m/s hardly rises again: impacts are plastic, within the solver's accuracy.
TEST_P(OnTheGround, LandsWithoutBouncing) {
  if (!GetParam().height) GTEST_SKIP() << "claims no height";
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

// Held over the tick or with a slope: the same commands at the ticks' ends, half a tick apart.
TEST_P(OnTheGround, TakesHeldAndRatedCommandsInMidStep) {
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

State after_bends(Started sim, double h) {
  for (int k = 0; k < std::lround(4 / h); ++k) sim.step();
  return state(sim);
}

TEST_P(OnTheGround, FollowsIdealWheels) {
  const auto [x, y] = ideal_course(4);
  EXPECT_LT(after_bends(run(one + "/>", rolling, bends), 0.01).distance(x, y), GetParam().course);
}

TEST_P(OnTheGround, ConvergesInItsOrder) {
  if (GetParam().order == 0) GTEST_SKIP() << "claims no order";
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

std::string slippery(const std::string& model) { return one + model + "/><robot name='b' at='3 1 0'" + model + "/>"; }

TEST_P(OnTheGround, GivesTheSameBitsForAnyWorkersAndAfterRemaking) {
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

TEST_P(OnTheGround, RestoredInMidRunItGoesOnWithTheSameBits) {
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

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(OnTheGround);
INSTANTIATE_TEST_SUITE_P(Plugins, OnTheGround, testing::ValuesIn(backends()), test_name);

}  // namespace
}  // namespace muster::test
