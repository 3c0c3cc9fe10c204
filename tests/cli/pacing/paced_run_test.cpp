// muster run --real-time: the same run, at the pace of the clock.
#include <gmock/gmock.h>

#include "tests/cli/errors/program.hpp"

using namespace muster::test;
using testing::HasSubstr;

namespace {

const char* world = R"(<world name="paced" dt="0.05" until="1"><robot name="r" at="0 0 0"/><robots.drive/>)"
                    R"(<control.steady robot="r" v="0.3" w="0.2"/></world>)";

std::string digest_of(const Outcome& outcome) {
  const auto at = outcome.out.find("\"digest\": \"");
  return at == std::string::npos ? "none: " + outcome.err : outcome.out.substr(at, 28);
}

TEST(RealTime, IsTheSameRunAndNoFasterThanTheClock) {
  const ProgramFolder folder;
  folder.write("world.xml", world);
  const auto free = folder.muster({"run", "world.xml", "--json"});
  const auto paced = folder.muster({"run", "world.xml", "--json", "--real-time", "--speed", "2"});
  EXPECT_EQ(free.exit, 0) << free.err;
  EXPECT_EQ(paced.exit, 0) << paced.err;
  EXPECT_EQ(digest_of(paced), digest_of(free));
  EXPECT_GE(paced.wall_seconds, 0.5);  // never earlier; how much later is the computer's affair
}

TEST(RealTime, ASpeedThatCannotBeKeptIsWarnedOf) {
  const ProgramFolder folder;
  folder.write("world.xml", world);
  const auto outcome = folder.muster({"run", "world.xml", "--until", "20000", "--real-time", "--speed", "1000000"});
  EXPECT_EQ(outcome.exit, 0) << outcome.err;
  EXPECT_THAT(outcome.err, HasSubstr("muster: warning: not in real time: this computer was up to "));
}

TEST(RealTime, ASpeedAloneIsRefused) {
  const ProgramFolder folder;
  folder.write("world.xml", world);
  expect_error(folder.muster({"run", "world.xml", "--speed", "2"}), 2, "--speed needs --real-time or --view beside it");
  expect_error(folder.muster({"run", "world.xml", "--real-time", "--speed", "fast"}), 2,
               "--speed: \"fast\" is not a number");
  expect_error(folder.muster({"run", "world.xml", "--real-time", "--speed", "0"}), 2,
               "--speed: 0 is out of bounds; expected a number from 0.001 to 1e+06, times real time; a run without "
               "--real-time goes as fast as it can");
}

}  // namespace
