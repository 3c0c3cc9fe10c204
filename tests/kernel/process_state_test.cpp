// What a plugin changes in the process that it shares with all others is told, and put back where that is possible.
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
  const mode_t mask = ::umask(022);
  const auto folder_before = std::filesystem::current_path();
  EXPECT_EQ(fault("umask"), "changes the mask of new files (umask)");
  EXPECT_EQ(::umask(mask), 022);
  EXPECT_EQ(fault("handler"), "takes the handler of SIGINT");
  EXPECT_EQ(std::signal(SIGINT, SIG_DFL), SIG_DFL);
  EXPECT_EQ(fault("folder"), "changes the working directory to /");
  EXPECT_EQ(std::filesystem::current_path(), folder_before);
}

TEST_F(ProcessState, ChangeInCreateIsThePluginsFault) {
  EXPECT_EQ(error_of_world(moving + "<toy.ends name='mine' how='handler' where='create'/>\n"),
            "3 world.xml:5:1: mine (toy.ends): create failed: takes the handler of SIGINT for the whole process; "
            "expected it to leave that as it was");
}

}  // namespace
}  // namespace muster
