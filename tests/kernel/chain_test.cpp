// A chain that gains and loses stages in mid-run: values, and states of writers, are unchanged.
#include "toy_world.hpp"

namespace muster {
namespace {

using testing::ElementsAre;
using Chains = ToyWorld;

const std::string commanded =
    two_robots +
    "<toy.copy_control name='ask' to='robot/*/command' columns='v[m/s] w[rad/s]' own='true' add='1' every='4'/>\n"
    "<toy.copy_physics name='drive' from='robot/*/command' from_columns='v[m/s] w[rad/s]' columns='d e' "
    "to='robot/*/driven'/>\n";
const std::string as_commands = "v[m/s] w[rad/s]";

TEST_F(Chains, AModifierInsertedIntoACommandChain) {
  Simulation sim = run(commanded);
  step(sim, 5);
  EXPECT_EQ(cell(sim, "robot/a/driven"), 1);
  sim.insert(instance("toy.copy_actuate", "clip",
                      {{"as", "modify"}, {"to", "robot/*/command"}, {"columns", as_commands}, {"times", "0.5"}}));
  step(sim);  // the writer is not due: the stage sees what it wrote before
  EXPECT_EQ(cell(sim, "robot/a/command@base"), 1);
  EXPECT_EQ(cell(sim, "robot/a/driven"), 0.5);
  step(sim, 2);
  EXPECT_EQ(cell(sim, "robot/a/command@base"), 2);  // the writer went on from its own value
  EXPECT_EQ(cell(sim, "robot/a/driven"), 1);
  sim.insert(instance("toy.copy_actuate", "trim",
                      {{"as", "modify"}, {"to", "robot/*/command"}, {"columns", as_commands}, {"add", "10"}}));
  EXPECT_EQ(cell(sim, "robot/a/command@clip"), 1);
  step(sim);
  EXPECT_EQ(cell(sim, "robot/a/command@trim"), 11);
  EXPECT_EQ(cell(sim, "robot/a/driven"), 11);
  sim.insert(instance("toy.copy_actuate", "early",
                      {{"as", "modify"}, {"to", "robot/*/command"}, {"columns", as_commands}, {"add", "100"}}),
             "clip");
  step(sim);
  EXPECT_EQ(cell(sim, "robot/a/driven"), (2 + 100) * 0.5 + 10);
  sim.remove("trim");
  step(sim);
  EXPECT_EQ(cell(sim, "robot/a/driven"), (2 + 100) * 0.5);
  sim.remove("early");
  sim.remove("clip");
  EXPECT_EQ(cell(sim, "robot/a/command"), 2);
  step(sim);  // tick 12: the writer steps
  EXPECT_EQ(cell(sim, "robot/a/driven"), 3);
  EXPECT_THAT(messages(sim), ElementsAre("5 clip: inserted toy.copy_actuate/1", "8 trim: inserted toy.copy_actuate/1",
                                         "9 early: inserted toy.copy_actuate/1", "10 trim: removed",
                                         "11 : dropped robot/*/command@early, which nobody writes any more",
                                         "11 early: removed", "11 clip: removed"));
}

TEST_F(Chains, AStageThatIsSeldomDueKeepsItsValueWhenAnotherFollows) {
  Simulation sim = run(two_robots +
                       "<toy.copy_control name='ask' to='robot/*/q' own='true' add='1' every='4'/>\n"
                       "<toy.copy_actuate name='seldom' as='modify' to='robot/*/q' times='3' every='4'/>\n");
  step(sim, 5);
  EXPECT_EQ(cell(sim, "robot/a/q"), 3);
  sim.insert(instance("toy.copy_actuate", "often", {{"as", "modify"}, {"to", "robot/*/q"}, {"add", "1"}}));
  step(sim);
  EXPECT_EQ(cell(sim, "robot/a/q@seldom"), 3);
  EXPECT_EQ(cell(sim, "robot/a/q"), 4);
}

TEST_F(Chains, AValueOfTheWorldIsModified) {
  Simulation sim =
      run("<material name='brick' loss='6'/>\n<material name='wood' loss='2'/>\n"
          "<toy.copy_physics name='wet' as='modify' to='material/brick/loss' columns='loss[dB]' add='1'/>\n"
          "<toy.copy_radio name='reader' from='material/*/loss' columns='loss[dB]' to='material/*/seen'/>\n");
  step(sim);
  EXPECT_THAT(column(sim, "material/*/seen"), ElementsAre(7, 2));
  sim.set_parameter("material/brick/loss", 10);
  step(sim, 3);
  EXPECT_THAT(column(sim, "material/*/seen"), ElementsAre(11, 2));
  EXPECT_EQ(sim.parameter("material/brick/loss").value, 10);
}

}  // namespace
}  // namespace muster
