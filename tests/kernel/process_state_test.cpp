// What a plugin changes in the process that it shares with all others is told, and put back where that is possible.
#include <sys/resource.h>
#include <sys/stat.h>

#include <csignal>
#include <filesystem>

#include "toy_world.hpp"

namespace muster {
namespace {

using ProcessState = ToyWorld;
const std::string moving =
    two_robots + "<toy.copy_physics name='m' to='robot/*/pose' columns='" + pose + "' own='true'/>\n";

TEST_F(ProcessState, ChangeInAStepIsThePluginsFault) {
  const auto fault = [&](const std::string& how) {
    Simulation sim = run(moving + "<toy.ends name='mine' how='" + how + "' tick='4'/>\n");
    step(sim, 3);
    const std::string error = error_of([&] { step(sim); });
    const std::string begin = "3 world.xml:5:1: mine (toy.ends): step failed at tick 4 (t = 2 s): ";
    const std::string end = " for the whole process; expected it to leave that as it was";
    EXPECT_TRUE(error.starts_with(begin) && error.ends_with(end)) << error;
    return error.size() > begin.size() + end.size()
               ? error.substr(begin.size(), error.size() - begin.size() - end.size())
               : "";
  };
  const auto folder_before = std::filesystem::current_path();
  EXPECT_EQ(fault("handler"), "takes the handler of SIGINT");
  EXPECT_EQ(std::signal(SIGINT, SIG_DFL), SIG_DFL);
  EXPECT_EQ(fault("folder"), "changes the working directory to /");
  EXPECT_EQ(std::filesystem::current_path(), folder_before);
  const mode_t mask = ::umask(022);
  EXPECT_EQ(fault("umask"), "changes the umask to 0777");
  EXPECT_EQ(::umask(mask), mode_t{022}) << "put back";
  struct rlimit before {};
  struct rlimit after {};
  ASSERT_EQ(::getrlimit(RLIMIT_AS, &before), 0);
  EXPECT_EQ(fault("limit"), "changes the limit RLIMIT_AS");
  ASSERT_EQ(::getrlimit(RLIMIT_AS, &after), 0);
  EXPECT_EQ(after.rlim_cur, before.rlim_cur);
}

TEST_F(ProcessState, ChangeInCreateIsThePluginsFault) {
  EXPECT_EQ(error_of_world(moving + "<toy.ends name='mine' how='handler' where='create'/>\n"),
            "3 world.xml:5:1: mine (toy.ends): create failed: takes the handler of SIGINT for the whole process; "
            "expected it to leave that as it was");
}

// Cells of others, and those beside its own.
TEST_F(ProcessState, WritesBesideItsCellsAreThePluginsFault) {
  const std::string cells = "; expected writes into the cells of its own rows alone, until step() returns";
  const auto fault = [&](const std::string& how, int tick) {
    Simulation sim = run(moving + "<toy.ends name='mine' how='" + how + "' tick='" + std::to_string(tick) + "'/>\n");
    const std::string error = error_of([&] { step(sim, tick + 1); });
    EXPECT_TRUE(error.ends_with(cells)) << error;
    const std::string begin = "3 world.xml:5:1: mine (toy.ends): step failed at tick ";
    EXPECT_TRUE(error.starts_with(begin)) << error;
    return error.substr(begin.size(), error.size() - cells.size() - begin.size());
  };
  EXPECT_EQ(fault("behind", 3), "3 (t = 1.5 s): writes behind the last cell of \"self/count\"");
  EXPECT_EQ(fault("before", 16), "16 (t = 8 s): writes before the first cell of \"self/count\"");
  EXPECT_EQ(fault("reaches", 512), "512 (t = 256 s): changes what it was given to read of \"robot/*/pose\"");
  EXPECT_EQ(fault("keeps", 5),
            "5 (t = 2.5 s): keeps a pointer beyond its step, and wrote through it into \"self/count\"");
}

// Steps of instances that are gone count: of one made anew the first step is looked at, and the 64th of all, which is
// its 24th; its second is not.
TEST_F(ProcessState, AnInstanceMadeAnewGoesOnFromTheOneBefore) {
  const auto fault = [&](int tick) {
    Simulation sim = run(moving + "<toy.ends name='one' how='never'/>\n");
    const std::shared_ptr<Library> library = sim.instances().back()->library();
    step(sim, 40);
    sim.remove("one");
    EXPECT_EQ(library->steps(), 40u);
    sim.insert(instance("toy.ends", "two", {{"how", "reaches"}, {"tick", std::to_string(tick)}}));
    return error_of([&] { step(sim, 30); });
  };
  const std::string told = "changes what it was given to read of \"robot/*/pose\"";
  EXPECT_NE(fault(41).find(told), std::string::npos);
  EXPECT_EQ(fault(42).find(told), std::string::npos);
  EXPECT_NE(fault(64).find(told), std::string::npos);
}

}  // namespace
}  // namespace muster
