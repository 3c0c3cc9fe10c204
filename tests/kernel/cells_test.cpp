// Cells: valid values, and the error of a writer of any other.
#include "toy_world.hpp"

namespace muster {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using CellKinds = ToyWorld;

// The part of a step's error after its time.
std::string what(const std::string& error) {
  const auto colon = error.find(" s): ");
  return colon == std::string::npos ? error : error.substr(colon + 5);
}

TEST_F(CellKinds, EachFaultIsNamed) {
  const auto fault = [&](const std::string& kind) {
    Simulation sim = run(two_robots + "<toy.fault name='f' fault='" + kind + "' tick='3'/>\n");
    step(sim, 2);
    std::string error = error_of([&] { sim.step(); });
    EXPECT_EQ(sim.tick(), 2u);
    EXPECT_EQ(cell(sim, "robot/b/odd"), 3);
    return error;
  };
  const std::string place = "3 world.xml:4:1: f (toy.fault): step failed at tick 3 (t = 1.5 s): ",
                    none = "; expected a number: 0 / 0 is none, nor a logarithm or root of less than 0",
                    over_0 = "; expected a number: a value over 0 is none";
  EXPECT_EQ(fault("nan"), place + "robot/b/odd: x[m] is NaN" + none);
  EXPECT_EQ(fault("infinite"), place + "robot/b/odd: x[m] is infinite" + over_0);
  EXPECT_EQ(fault("nan_for_null"), place + "robot/b/odd: rssi[dBm] is NaN; an empty cell is muster::null()");
  EXPECT_EQ(fault("minus_infinite"), place + "robot/b/odd: rssi[dBm] is infinite" + over_0);
  EXPECT_EQ(fault("no_row"), place + "robot/b/odd: friend is no row of robot");
  EXPECT_EQ(fault("half_row"), place + "robot/b/odd: mate is no row of robot");
  EXPECT_EQ(fault("null_row"), place + "robot/b/odd: friend is NaN" + none);
  EXPECT_EQ(fault("throws"), place + "the wheel came off");
  EXPECT_EQ(fault("throws_int"), place + "threw something that is not a std::exception");
  EXPECT_EQ(fault("fails"), place + "gave no reason");
  EXPECT_EQ(fault("refuses"), place.substr(2) + "the wheel in the file is square");
  EXPECT_EQ(fault("says_and_returns"), place + "said something and went on");
  EXPECT_EQ(fault("appends"),
            place +
                "append() on a table whose rows it does not list; expected a queue, or a set of which it "
                "writes the first quantity");
  EXPECT_EQ(fault("puts"), place + "put_bytes() into a cell that is not there or holds no bytes");
  EXPECT_EQ(fault("claims"), place + "claims outside create()");
  EXPECT_EQ(fault("rounds"),
            place + "rounds upward for the whole process; expected it to leave the arithmetic as it was");
}

// Two endpoints of a radio, `spread` apart.
TEST_F(CellKinds, ALinkWhoseEndsAreAtOnePlaceIsNamedSo) {
  const auto fault = [&](const std::string& by, const std::string& spread) {
    Simulation sim =
        run(two_robots + "<toy.list modulo='100' spread='" + spread + "'/>\n<toy.loss by='" + by + "'/>\n");
    return what(error_of([&] { step(sim, 2); }));
  };
  const std::string cell = "link/0/level (a, a): level[dBm] ",
                    near =
                        ": the two are 0 m apart, at one place; expected a number there, too: hold the distance "
                        "above 0, as by std::max(0.01, distance), before a division or a logarithm, or move one of "
                        "the two in the world";
  EXPECT_EQ(fault("logarithm", "0"), cell + "is infinite" + near);
  EXPECT_EQ(fault("ratio", "0"), cell + "is NaN" + near);
  EXPECT_EQ(fault("infinity", "2"), cell + "is infinite; expected a number: a value over 0 is none");
  EXPECT_EQ(fault("logarithm", "2"), "no error");
}

TEST_F(CellKinds, CellsThatNobodyFillsAreFound) {
  Simulation sim = run(two_robots + "<toy.lazy name='l' at='2'/>\n");
  step(sim);
  EXPECT_EQ(error_of([&] { sim.step(); }),
            "3 world.xml:4:1: l (toy.lazy): step failed at tick 2 (t = 1 s): robot/b/two: a is not filled; expected "
            "step() to "
            "fill each cell that it writes in every tick, also where nothing is to change");
}

TEST_F(CellKinds, EmptyInfiniteAndManyAlike) {
  Simulation sim = run(two_robots + "<toy.kinds name='k'/>\n");
  step(sim, 3);
  const TableView kinds = sim.table("robot/*/kinds");
  EXPECT_EQ(kinds.cols(), 6u);
  EXPECT_EQ(kinds.table->columns()[2].title(), "range2[m]");
  EXPECT_EQ(kinds.at(0, 1), std::numeric_limits<double>::infinity());
  EXPECT_TRUE(is_null(kinds.at(0, 3)));
  EXPECT_EQ(kinds.at(1, 3), -60);
  EXPECT_EQ(kinds.at(0, 4), 0);
  EXPECT_TRUE(is_null(kinds.at(1, 4)));
  const Cells& cells = kinds.table->now();
  EXPECT_EQ(kinds.at(0, 5), 0);  // no bytes
  ASSERT_EQ(cells.blobs.size(), 1u);
  EXPECT_EQ(std::string(cells.blobs[0]->begin(), cells.blobs[0]->end()), "picture 3.1");
}

// A rest is written aside first, bytes included.
TEST_F(CellKinds, BytesOfARestBesideThoseOfARow) {
  Simulation sim = run(two_robots +
                       "<robot name='c' at='3 0 0'/>\n<toy.kinds name='k' rest='true' mark='rest'/>\n<toy.kinds "
                       "name='row' robot='b' mark='row'/>\n");
  const auto text = [&](std::size_t row) {
    const TableView kinds = sim.table("robot/*/kinds");
    const auto blob = static_cast<std::size_t>(kinds.at(row, 5));
    const Cells& cells = kinds.table->now();
    return blob == 0 ? "" : std::string(cells.blobs.at(blob - 1)->begin(), cells.blobs.at(blob - 1)->end());
  };
  step(sim, 4);
  EXPECT_EQ(text(0), "rest 4.0");
  EXPECT_EQ(text(1), "row 4.0");
  EXPECT_EQ(text(2), "rest 4.2");
  step(sim);
  EXPECT_EQ(text(0) + text(1) + text(2), "");
}

TEST_F(CellKinds, ThreePluginsThatFailTogetherAreReportedInTheOrderOfTheWorldFileAndOnceEach) {
  Simulation sim = run(two_robots + "<toy.lazy name='z' at='2'/>\n<toy.fault name='y' tick='2' fault='throws'/>\n", 3);
  sim.insert(instance("toy.lazy", "x", {{"at", "2"}, {"queue", "true"}}), "z");
  step(sim);
  EXPECT_THAT(error_of([&] { sim.step(); }),
              HasSubstr(": x (toy.lazy): step failed at tick 2 (t = 1 s): outbox/1/message"));
  sim.remove("x");
  EXPECT_THAT(error_of([&] { sim.step(); }),
              HasSubstr("z (toy.lazy): step failed at tick 2 (t = 1 s): robot/b/two: a is not filled"));
  sim.remove("z");
  EXPECT_THAT(error_of([&] { sim.step(); }),
              HasSubstr("y (toy.fault): step failed at tick 2 (t = 1 s): the wheel came off"));
}

// Two instances of one batch report failures; when the first is gone and the other's parameter is corrected, the run
// goes on.
TEST_F(CellKinds, AnOldComplaintDoesNotOutliveItsStep) {
  Simulation sim = run(two_robots + "<toy.fault name='f' tick='2' fault='throws'/>\n");
  step(sim);
  EXPECT_EQ(what(error_of([&] { sim.step(); })), "the wheel came off");
  sim.set_parameter("f/fault", 0);
  EXPECT_EQ(error_of([&] { sim.step(); }), "no error");
}

TEST_F(CellKinds, TheComplaintOfASecondFailureDoesNotOutliveItsStepEither) {
  Simulation sim = run(two_robots + "<toy.lazy name='one' at='2'/>\n<toy.fault name='two' tick='2' fault='throws'/>\n");
  sim.remove("one");
  sim.insert(instance("toy.send_observe", "one", {{"as", "77"}}), "two");
  sim.set_parameter("two/tick", 1);
  EXPECT_THAT(error_of([&] { sim.step(); }), HasSubstr("one (toy.send_observe)"));
  sim.remove("one");
  sim.set_parameter("two/tick", 5);
  EXPECT_EQ(error_of([&] { sim.step(); }), "no error");
}

TEST_F(CellKinds, ASumThatOverflowsIsNamed) {
  Simulation sim = run(two_robots +
                       "<toy.copy_radio name='p' as='add' to='robot/*/v' own='true' times='100' add='1'/>\n"
                       "<toy.copy_radio name='q' as='add' to='robot/*/v' own='true' times='100' add='1'/>\n");
  step(sim, 154);
  EXPECT_EQ(error_of([&] { sim.step(); }),
            "3 world.xml: the sum \"robot/*/v\" is infinite at tick 155 (t = 77.5 s), in row 0");
  EXPECT_EQ(sim.tick(), 154u);
}

}  // namespace
}  // namespace muster
