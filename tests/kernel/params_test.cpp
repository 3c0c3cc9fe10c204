// Parameters, files and providers: inputs that a world gives to its plugins.
#include "toy_world.hpp"

namespace muster {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using Params = ToyWorld;

TEST_F(Params, APathChangesANumberWithoutANewInstance) {
  Simulation sim = run(two_robots + "<toy.copy_radio name='n' to='robot/*/v' add='1'/>\n");
  const Instance* before = sim.instances()[0].get();
  step(sim);
  sim.set_parameter("n/add", 42.5);
  step(sim);
  EXPECT_EQ(cell(sim, "robot/a/v"), 42.5);
  EXPECT_EQ(sim.instances()[0].get(), before);
  EXPECT_EQ(sim.parameter("n/add").value, 42.5);
}

TEST_F(Params, ValuesAreHeldAgainstTheDeclaration) {
  Simulation sim = run(two_robots + "<toy.copy_radio name='n' to='robot/*/v'/>\n<toy.fault name='f'/>\n");
  const auto set = [&](const std::string& path, double value) {
    return error_of([&] { sim.set_parameter(path, value); });
  };
  EXPECT_EQ(set("n/add", 2e6), "parameter \"n/add\": 2e+06 is out of bounds; expected a number from -1e+06 to 1e+06 m");
  EXPECT_EQ(set("n/add", std::numeric_limits<double>::quiet_NaN()),
            "parameter \"n/add\": nan is out of bounds; expected a number from -1e+06 to 1e+06 m");
  EXPECT_EQ(set("f/tick", 2.5), "parameter \"f/tick\": 2.5 is no integer; expected an integer from 0 to 1000");
  EXPECT_EQ(
      set("n/robot", 1),
      "\"n/robot\" is the name of a robot, and no parameter: numbers, flags and choices are; expected robot=\"...\" "
      "in the world, at world.xml:4:1, or beside this run one with another (muster compare WORLD "
      "n=toy.copy_radio:robot=VALUE; in a sweep <vary instance=\"n\" plugins=\"toy.copy_radio:robot=VALUE ...\"/>)");
  EXPECT_EQ(set("robot/a/at", 1),
            "\"robot/a/at\" is 3 numbers, and no parameter: single numbers, flags and choices are; expected "
            "at=\"...\" of <robot>, at world.xml:2:1");
  EXPECT_EQ(set("robot/a/model", 1),
            "\"robot/a/model\" is a text, and no parameter: single numbers, flags and choices are; expected "
            "model=\"...\" of <robot>, at world.xml:2:1");
  EXPECT_EQ(set("n/ad", 1),
            "there is no parameter \"n/ad\"; expected one of n/as, n/flags, n/read_flags, n/own, n/add, n/times; "
            "did you mean \"n/as\"?");
  EXPECT_EQ(sim.parameter("n/add").value, 0);
}

TEST_F(Params, MaterialsByTheirPath) {
  Simulation sim =
      run("<material name='brick' loss='6'/>\n<robot name='a' at='0 0 0'/>\n<wall name='w' from='0 0' to='1 0' "
          "material='brick'/>\n"
          "<toy.copy_radio name='n' from='material/*/loss' columns='loss[dB]' to='material/*/seen'/>\n");
  step(sim);
  EXPECT_EQ(cell(sim, "material/brick/seen"), 6);
  sim.set_parameter("material/brick/loss", 8);
  step(sim);
  EXPECT_EQ(cell(sim, "material/brick/seen"), 8);
  EXPECT_THAT(error_of([&] { sim.set_parameter("wall/w/from", 3); }),
              HasSubstr("\"wall/w/from\" is 2 numbers, and no parameter"));
  EXPECT_EQ(error_of([&] { sim.set_parameter("material/brick/loss", -1); }),
            "parameter \"material/brick/loss\": -1 is out of bounds; expected a number from 0 to 100 dB");
}

TEST_F(Params, FileTables) {
  put("data.csv", "robot,x[m],t[s],battery[V]\na,1.5,0,3\nb,2,,3\na,0.25,1,3\n");
  Simulation sim = run(two_robots + "<toy.file name='f' data='data.csv'/>\n");
  step(sim);
  EXPECT_THAT(column(sim, "robot/*/total", 0), ElementsAre(1.75, 2));
  EXPECT_THAT(column(sim, "robot/*/total", 1), ElementsAre(2, 1));
  EXPECT_THAT(column(sim, "robot/*/total", 2), ElementsAre(0, 1));
  put("data.csv", "robot,x[m]\na,1.5\n");
  Simulation untimed = run(two_robots + "<toy.file name='f' data='data.csv'/>\n");
  step(untimed);
  EXPECT_EQ(cell(untimed, "robot/a/total", 2), 1);
}

TEST_F(Params, FileTablesThatDoNotFit) {
  const auto with = [&](const std::string& text) {
    put("data.csv", text);
    return error_of_world(two_robots + "<toy.file name='f' data='data.csv'/>\n");
  };
  EXPECT_EQ(with("robot,x[m]\na,1\nc,2\n"), "data.csv:3:1: no robot is called \"c\"; expected one of a, b");
  EXPECT_THAT(with("robot,x[km]\na,1\n"), HasSubstr("data.csv:1:7: "));
  EXPECT_THAT(with("robot,y[m]\na,1\n"), HasSubstr("data.csv:1:1: "));
  EXPECT_THAT(with("robot,x[m]\na,1,5\n"), HasSubstr("data.csv:2:"));
  EXPECT_THAT(with("robot,x[m]\na,nan\n"), HasSubstr("data.csv:2:3: "));
  EXPECT_EQ(error_of_world(two_robots + "<toy.file name='f' data='dada.csv'/>\n"),
            "world.xml:4:26: attribute \"data\": there is no file \"dada.csv\"; expected a table with the columns "
            "t[s]? robot:robot x[m]");
  EXPECT_EQ(error_of_world(two_robots + "<toy.file name='f'/>\n"),
            "world.xml:4:1: f (toy.file): has no attribute \"data\", which it needs; expected a path relative to the "
            "world file");
}

// A standard quantity that is read but has no writer brings its provider, from any folder of plugins.
TEST_F(Params, ProvidersJoinWhereTheyAreNeeded) {
  std::filesystem::copy(MUSTER_BUILD_DIR "/tests/toys/toy_list.so", folder);
  static Standard other = standard();
  for (auto& set : other.sets) {
    for (auto& quantity : set.quantities) {
      if (std::string(quantity.provider) == "radio.links") quantity.provider = "toy.list";
    }
  }
  const std::string reader =
      two_robots + "<toy.copy_sense name='r' from='endpoint/*/radio' from_columns='radio:radio t[s]' to='self/x'/>\n";
  Simulation sim(world(reader), other, options());
  ASSERT_EQ(sim.instances().size(), 2u);
  EXPECT_EQ(sim.instances()[1]->name(), "toy.list");
  step(sim, 3);
  EXPECT_EQ(sim.table("endpoint/*/radio").rows(), 4u);
  const std::string record = two_robots + "<record table='endpoint/*/radio'/>\n";
  EXPECT_EQ(Simulation(world(record), other, options()).instances().at(0)->name(), "toy.list");
  EXPECT_EQ(Simulation(world(record + "<toy.list name='mine'/>\n"), other, options()).instances().size(), 1u);
  Simulation named(world(reader + "<toy.list name='mine'/>\n"), other, options());
  EXPECT_EQ(named.instances().size(), 2u);
  for (auto& set : other.sets) {
    for (auto& quantity : set.quantities) {
      if (std::string(quantity.provider) == "toy.list") quantity.provider = "radio.links";
    }
  }
  EXPECT_THAT(error_of_world(reader), HasSubstr("3 world.xml: plugin \"radio.links\": radio_links.so not found"));
}

}  // namespace
}  // namespace muster
