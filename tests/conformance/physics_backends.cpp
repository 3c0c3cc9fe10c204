#include "tests/conformance/physics_backends.hpp"

namespace muster::test {

std::vector<Backend> table() {
  Backend simbody{"simbody", "physics.simbody", {}, true};
  simbody.smooth = {{"body_friction", "0"}};
  simbody.height = simbody.slip = simbody.torque = simbody.round_friction = simbody.load_transfer = true;
  simbody.rotors = simbody.limbs = simbody.pushed = simbody.bouncing = simbody.bounces_on_wheels = true;
  simbody.order = 2, simbody.coarsest_of_order = 0.08, simbody.flight_order = 4;
  simbody.fall = 1e-6, simbody.rest = 1e-6, simbody.arc = 1e-3, simbody.course = 1e-4, simbody.ramp = 1e-3;
  simbody.climb = 1e-7, simbody.spin = 1e-11, simbody.collision = 1e-12, simbody.bounce = 0.02, simbody.force = 0.01;
  simbody.apex = 1e-3, simbody.slide = 1e-3;
  simbody.pendulum = "hip", simbody.swing = 2e-4;

  Backend ode{"ode_exact", "physics.ode", {}, true};
  ode.smooth = {{"friction", "0"}};
  ode.height = ode.slip = ode.torque = ode.rotors = ode.limbs = ode.bouncing = ode.pushed = true;
  ode.order = 2, ode.coarsest_of_order = 0.04, ode.flight_order = 1;
  ode.fall = 5e-3, ode.rest = 1e-6, ode.arc = 1e-3, ode.course = 1e-4, ode.ramp = 1e-3, ode.force = 0.01;
  ode.climb = 5e-3, ode.spin = 3e-3, ode.collision = 1e-12, ode.bounce = 0.8, ode.parting = 0.2;
  ode.apex = 0.04, ode.slide = 5e-3;
  ode.pendulum = "axle", ode.swing = 3e-3;

  Backend quick = ode;
  quick.name = "ode_quick", quick.attributes = {{"solver", "quick"}};
  quick.load_transfer = true;
  quick.order = 0;
  quick.bounce = 0.1;
  quick.rest = 3e-3, quick.arc = 1e-2, quick.course = 5e-3, quick.ramp = 0.015, quick.force = 0.02;

  Backend mujoco{"mujoco", "physics.mujoco", {}, true};
  mujoco.smooth = {{"friction", "0"}};
  mujoco.height = mujoco.slip = mujoco.torque = mujoco.round_friction = mujoco.load_transfer = true;
  mujoco.rotors = mujoco.limbs = mujoco.bouncing = mujoco.pushed = true;
  mujoco.order = 2, mujoco.coarsest_of_order = 0.08, mujoco.flight_order = 1;
  mujoco.fall = 5e-3, mujoco.rest = 1e-6, mujoco.arc = 1e-3, mujoco.course = 1e-4, mujoco.ramp = 1e-3;
  mujoco.climb = 5e-3, mujoco.spin = 3e-3, mujoco.collision = 1e-12, mujoco.bounce = 0.1, mujoco.force = 0.01;
  mujoco.apex = 0.04, mujoco.slide = 5e-3;
  mujoco.pendulum = "axle", mujoco.swing = 3e-3;

  Backend planar{"planar", "physics.planar", {}};
  planar.order = 2, planar.coarsest_of_order = 0.08;
  planar.rest = 1e-12, planar.arc = 1e-9, planar.course = 1e-4, planar.ramp = 1e-6;
  return {simbody, ode, quick, mujoco, planar};
}

// The built backends of the table, and the given one.
std::vector<Backend> backends() {
  std::vector<Backend> result;
  for (const Backend& backend : table()) {
    std::string file = backend.plugin;
    file[file.find('.')] = '_';
    if (std::filesystem::exists(MUSTER_PLUGINS_DIR "/" + file + ".so")) result.push_back(backend);
  }
  if (const auto given = given_backend()) result.push_back(*given);
  return result;
}

InstanceDeclaration instance(const Backend& backend, const Attributes& more) {
  InstanceDeclaration made;
  made.plugin = backend.plugin;
  for (const Attributes& list : {backend.attributes, more}) {
    for (const auto& [name, value] : list) made.attributes.push_back({name, value, {}, {}});
  }
  return made;
}

// No steps shorter than the tick.
Attributes whole_ticks(const Backend& backend) { return backend.has_step ? Attributes{{"step", "0.1"}} : Attributes{}; }

namespace {

std::string print(const Attributes& attributes) {
  std::string text;
  for (const auto& [name, value] : attributes) text += ' ' + name + "='" + value + '\'';
  return text;
}

}  // namespace

State state(const Simulation& run, const std::string& robot) {
  return {row<Pose>(run, "robot/" + robot + "/pose"), row<Twist>(run, "robot/" + robot + "/twist")};
}

std::string bird(const std::string& name, const std::string& at) {
  return "<robot name='" + name + "' model='hummingbird' heading='0.4' at='" + at + "'/>";
}

std::string lift(double rate, double swing) {
  return "<conformance.lift rate='" + std::to_string(rate) + "' swing='" + std::to_string(swing) + "'/>";
}

Started::Started(const Folder& folder, int workers, InstanceDeclaration backend)
    : Simulation(read_world(folder.path(), standard()), standard(), search(workers)) {
  step();
  swap("physics", std::move(backend));
}

Started Physics::started(const Backend& backend, const std::string& robots, const Attributes& start,
                         const Attributes& course, double dt, int workers, const Attributes& more) const {
  folder.write("world.xml", "<world dt='" + std::to_string(dt) + "' until='600' seed='1'>" + robots +
                                "<conformance.start name='physics'" + print(start) + "/><conformance.course" +
                                print(course) + "/></world>");
  return {folder, workers, instance(backend, more)};
}

void Physics::run_for(Simulation& run, int ticks) {
  for (int i = 0; i < ticks; ++i) run.step();
}

void Physics::expect_same_bits(const std::function<Started(int)>& begun, int half) const {
  Started straight = begun(1);
  run_for(straight, half);
  straight.snapshot().save(folder / "then");
  run_for(straight, half);
  Started three = begun(3);
  run_for(three, 2 * half);
  EXPECT_EQ(straight.digest(), three.digest());
  Started restored = begun(1);
  restored.restore(Snapshot::load(folder / "then"));
  run_for(restored, half);
  EXPECT_EQ(straight.digest(), restored.digest());
  Started remade = begun(1);
  while (remade.tick() < straight.tick()) {
    if (remade.tick() % 17 == 5) remade.remake("physics");
    remade.step();
  }
  EXPECT_EQ(straight.digest(), remade.digest());
}

}  // namespace muster::test
