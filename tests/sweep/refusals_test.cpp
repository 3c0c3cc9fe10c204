// What a sweep refuses before its first run, word for word, and what has changed since.
#include "swept.hpp"

namespace muster::test {
namespace {

TEST(SweepRefusals, TellThePlaceInTheFile) {
  const SweepFolder folder;
  const std::string head = "<sweep world=\"world.xml\" seeds=\"1 2\">\n";
  struct Fault {
    std::string text, message;
  };
  const std::vector<Fault> faults{
      {"<sweep world=\"wurld.xml\" seeds=\"1\"/>",
       "plan.xml:1:15: \"wurld.xml\" is not there; expected a world's folder or file, from the folder of plan.xml"},
      {head + "<vary set=\"radio.multiwall/tx_powr\" values=\"1\"/></sweep>",
       "plan.xml:2:12: there is no parameter \"radio.multiwall/tx_powr\"; expected one of "
       "radio.multiwall/tx_power, radio.multiwall/l0, radio.multiwall/n, radio.multiwall/model, "
       "radio.multiwall/radius; did "
       "you mean \"radio.multiwall/tx_power\"?"},
      {head + "<vary set=\"radio.multiwall/n\" values=\"2 x\"/></sweep>", "plan.xml:2:41: "},
      {head + "<vary set=\"radio.multiwall/n\" values=\"2 -3\"/></sweep>", "plan.xml:2:41: "},
      {head + "<vary set=\"radio.multiwall/n\" values=\"1.5:0.5:3\"/></sweep>",
       "plan.xml:2:39: values: \"1.5:0.5:3\" is a range, and values are a list with blanks between them; expected "
       "values=\"1.5 2 2.5 3\""},
      {head + "<vary set=\"radio.multiwall/n\" values=\"1.5;2;2.5\"/></sweep>",
       "plan.xml:2:39: values: \"1.5;2;2.5\" has semicolons between values; expected blanks: values=\"1.5 2 2.5\""},
      {head + "<vary set=\"seed\" values=\"2\"/></sweep>",
       "plan.xml:2:12: \"seed\" is no parameter; expected seeds= of <sweep>"},
      {head + "<vary instance=\"fysics\" plugins=\"physics.planar\"/></sweep>",
       "plan.xml:2:17: no instance of world.xml is called \"fysics\"; "},
      {head + "<vary instance=\"physics\" plugins=\"physics.planer\"/></sweep>", "plan.xml:2:35: "},
      {head + "<metric of=\"robot/r/pose/y2\"/></sweep>",
       "plan.xml:2:13: \"robot/r/pose\" has no column \"y2\"; expected one of "},
      {head + "<metric of=\"robot/q/pose/x\"/></sweep>", "plan.xml:2:13: "},
      {head + "<metric of=\"mved\"/></sweep>",
       "plan.xml:2:13: there is no metric \"mved\"; expected one of moved, delivered; did you mean \"moved\"?, or "
       "TABLE/COLUMN such as robot/leader/pose/x"},
      {"<sweep world=\"world.xml\" seeds=\"1\" until=\"x\"/>", "plan.xml:1:43: until: \"x\" is not a number"},
  };
  for (const Fault& fault : faults) {
    folder.write("plan.xml", fault.text);
    const auto outcome = folder.sweep({"plan.xml", "--out", "out"});
    EXPECT_THAT(outcome.exit, testing::AnyOf(2, 3)) << fault.text;
    EXPECT_THAT(outcome.err, testing::StartsWith("muster: error: " + fault.message)) << fault.text;
    EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "out")) << fault.text;
  }
}

// What one of the plugins alone has cannot be varied for all.
TEST(SweepRefusals, OfAParameterThatAnExchangedPluginLacks) {
  const SweepFolder folder;
  folder.write_sweep();
  folder.write("plan.xml",
               "<sweep world=\"world.xml\" seeds=\"1\">\n<vary instance=\"physics\" plugins=\"physics.planar\"/>\n"
               "<vary set=\"physics/step\" values=\"0.001 0.005\"/></sweep>");
  const auto outcome = folder.sweep({"plan.xml", "--out", "out"});
  EXPECT_EQ(outcome.exit, 2);
  EXPECT_THAT(outcome.err,
              testing::StartsWith("muster: error: plan.xml:3:12: there is no parameter \"physics/step\"; "));
  EXPECT_THAT(outcome.err,
              testing::HasSubstr("; that is where physics is physics.planar (plan.xml:2:35): what one plugin "
                                 "alone has is given with it, as plugins=\"PLUGIN:NAME=VALUE\""));
}

TEST(SweepRefusals, OfWords) {
  const SweepFolder folder;
  folder.write_sweep();
  const auto refused = [&](const std::vector<std::string>& words, const std::string& message) {
    expect_error(folder.sweep(words), 2, message);
  };
  refused({"plan.xml", "--out", "out", "--index", "1"},
          "--index and --of belong together: the share, from 1, and how many there are");
  refused({"plan.xml", "--out", "out", "--index", "0", "--of", "2"},
          "--index: \"0\" is no share; expected an integer from 1 to 2: shares count from 1 (of an array of Slurm from "
          "0: --index $((SLURM_ARRAY_TASK_ID + 1)))");
  refused({"plan.xml", "--out", "out", "--index", "one", "--of", "2"},
          "--index: \"one\" is no share; expected an integer from 1 to 2");
  refused({"plan.xml", "--out", "out", "--index", "3", "--of", "2"},
          "--index: there is no share 3 of 2; expected one from 1 to 2");
  for (const std::string prints : {"--slurm", "--parallel"}) {  // it had no effect, and no message
    EXPECT_EQ(folder.sweep({"plan.xml", "--out", "out", prints, "4", "--of", "2"}).exit, 2) << prints;
    EXPECT_EQ(folder.sweep({"plan.xml", "--out", "out", prints, "4"}).exit, 0) << prints;
  }
  refused({"plan.xml", "--out", "way.csv"}, "--out: way.csv is a file; expected a folder");
}

void expect_refused_once_changed(const SweepFolder& folder, const std::string& file) {
  const std::string text = folder.read(file);
  folder.write(file, text + '\n');
  expect_error(folder.sweep({"plan.xml", "--out", "out"}), 2,
               file +
                   " is not what it was when the runs in out were begun; expected another folder (--out), so that "
                   "runs of both are not mixed");
  folder.write(file, text);
}

// Runs of one thing are never mixed with runs of another.
TEST(SweepRefusals, OfWhatHasChangedSince) {
  const SweepFolder folder;
  folder.write_sweep();
  ASSERT_EQ(folder.sweep({"plan.xml", "--out", "out", "--index", "1", "--of", "2"}).exit, 0);
  const auto before = folder.ask("out", "SELECT count(*) FROM run");
  for (const char* file : {"plan.xml", "world.xml", "way.csv"}) expect_refused_once_changed(folder, file);
  EXPECT_EQ(folder.ask("out", "SELECT count(*) FROM run"), before);
  EXPECT_EQ(folder.sweep({"plan.xml", "--out", "out"}).exit, 0);
}

// A model is found by its name alone, and an exchanged plugin's file by the sweep's own attribute.
TEST(SweepRefusals, OfFilesThatTheWorldDoesNotNameThatHaveChangedSince) {
  const SweepFolder folder;
  std::string world = folder.read("world.xml");
  folder.write("world.xml", world.replace(world.find("at=\"30 3 0\""), 0, "model=\"mine\" "));
  folder.write("models/mine.urdf", contents(MUSTER_PLUGINS_DIR "/models/scarab.urdf"));
  folder.write("other.csv", "x[m],y[m]\n0,100\n");
  folder.write("plan.xml",
               "<sweep world=\"world.xml\" seeds=\"1\"><vary instance=\"steer\" "
               "plugins=\"control.waypoint control.waypoint:path=other.csv\"/></sweep>");
  const auto first = folder.sweep({"plan.xml", "--out", "out"});
  ASSERT_EQ(first.exit, 0) << first.err;
  for (const char* file : {"models/mine.urdf", "other.csv"}) expect_refused_once_changed(folder, file);
  EXPECT_EQ(folder.sweep({"plan.xml", "--out", "out"}).exit, 0);
}

TEST(SweepRefusals, OfAPluginThatHasChangedSince) {
  const SweepFolder folder;
  folder.write_sweep();
  std::filesystem::create_directory(folder.path() / "mine");
  const auto copy = folder.path() / "mine" / "radio_fading.so";
  std::filesystem::copy_file(std::filesystem::path(MUSTER_PLUGINS_DIR) / "radio_fading.so", copy);
  const std::vector<std::string> words{"plan.xml", "--out", "out", "--plugins", "mine"};
  ASSERT_EQ(folder.sweep(words).exit, 0);
  std::ofstream(copy, std::ios::app) << ' ';
  expect_error(folder.sweep(words), 2,
               "mine/radio_fading.so is not what it was when the runs in out were begun; expected another folder "
               "(--out), so that runs of both are not mixed");
}

}  // namespace
}  // namespace muster::test
