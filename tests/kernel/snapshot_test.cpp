// Snapshots: a restored state equals the saved one, or nothing is restored.
#include "busy_world.hpp"

namespace muster {
namespace {

using testing::HasSubstr;
using Snapshots = ToyWorld;

std::string bytes_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

TEST_F(Snapshots, AFileHoldsThemWhole) {
  Simulation sim = run(busy_world);
  step(sim, 9);
  const Snapshot saved = sim.snapshot();
  saved.save(folder / "saved");
  const Snapshot loaded = Snapshot::load(folder / "saved");
  EXPECT_EQ(loaded.digest(), saved.digest());
  EXPECT_EQ(loaded.instances, saved.instances);
  EXPECT_FALSE(std::filesystem::exists(folder / "saved.part"));
}

TEST_F(Snapshots, ADamagedFileIsRefused) {
  Simulation sim =
      run(two_robots +
          "<toy.copy_physics name='n' to='self/x' own='true' add='1'/>\n<toy.send_control name='s' robot='a' "
          "to='outbox/{robot}/message' size='20'/>\n");
  step(sim, 3);
  sim.snapshot().save(folder / "saved");
  const std::string whole = bytes_of(folder / "saved");
  const std::string refusal = "bad: is not a whole snapshot; expected a file that `muster run --save` wrote";
  for (std::size_t cut = 0; cut < whole.size(); cut += 7) {
    put("bad", whole.substr(0, cut));
    EXPECT_EQ(error_of([&] { Snapshot::load(folder / "bad"); }), refusal) << cut;
  }
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string bad = whole;
    bad[at] = static_cast<char>(bad[at] ^ (1 << (at % 8)));
    put("bad", bad);
    const std::string error = error_of([&] { Snapshot::load(folder / "bad"); });
    const bool is_of_version = at == std::string_view("muster.snapshot.").size();
    EXPECT_THAT(error, testing::StartsWith(is_of_version ? "bad: is of version \"" : refusal)) << at;
  }
  put("bad", whole + '\0');
  EXPECT_EQ(error_of([&] { Snapshot::load(folder / "bad"); }), refusal);
  EXPECT_THAT(error_of([&] { Snapshot::load(folder / "nothing"); }), HasSubstr("nothing: cannot be read"));
  EXPECT_THAT(error_of([&] { Snapshot::load(folder); }), HasSubstr(": cannot be read"));
}

TEST_F(Snapshots, OfAnotherWorldAreRefusedAndTheRunStands) {
  const std::string one = "<toy.copy_physics name='n' to='self/x' own='true' add='1'/>\n";
  Simulation sim = run(two_robots + one);
  step(sim, 3);
  const uint64_t before = sim.digest();
  const auto refused = [&](const std::string& elements) {
    Simulation other = run(elements);
    step(other, 2);
    std::string error = error_of([&] { sim.restore(other.snapshot()); });
    EXPECT_EQ(sim.digest(), before);
    return error;
  };
  const std::string of = "the snapshot is of another world: ";
  EXPECT_EQ(refused(two_robots), of + "it has no instance \"n\"");
  EXPECT_EQ(refused(two_robots + one + "<toy.copy_physics name='m' to='self/x'/>\n"),
            of + "its instance \"m\", a toy.copy_physics/1, is not in this one");
  EXPECT_EQ(refused(two_robots + "<toy.copy_physics name='n' to='self/x' columns='y'/>\n"),
            of + "its table \"instance/n/*/x\" has other columns");
  EXPECT_EQ(refused("<robot name='a' at='1 0 0'/><robot name='c' at='1 0 0'/>" + one),
            of + "it has the radio \"c\" where this one has \"b\"; expected the world that it was saved from");
  EXPECT_EQ(refused(two_robots + "<toy.copy_sense name='n' to='self/x' own='true' add='1'/>\n"),
            of + "its instance \"n\" is a toy.copy_sense/1; here it is a toy.copy_physics/1");
}

// Of a world with one robot more, which no plugin of this one has let join.
TEST_F(Snapshots, ARowBeyondThoseOfTheWorldIsRefused) {
  Simulation larger = run(two_robots + "<robot name='c' at='1 0 0'/>"), sim = run(two_robots);
  step(larger, 3);
  step(sim, 2);
  const uint64_t before = sim.digest();
  EXPECT_THAT(error_of([&] { sim.restore(larger.snapshot()); }),
              HasSubstr("\"c\", which this one has not; expected the world that it was saved from"));
  EXPECT_EQ(sim.digest(), before);
}

// A whole file whose cells name rows that are not there: plugins count with them.
TEST_F(Snapshots, ReferencesToNoRowAreRefusedAndTheRunStands) {
  const std::string elements =
      two_robots + "<toy.send_control name='s' robot='a' to='outbox/{robot}/message' size='20'/>\n";
  Simulation sim = run(elements);
  step(sim, 3);
  const uint64_t before = sim.digest();
  for (const double row : {0.5, -1.0, 2.0, 1e300}) {
    Snapshot crafted = sim.snapshot();
    auto& table = crafted.tables.at("outbox/*/message");
    ASSERT_GT(table.cells.rows, 0u);
    table.cells.data[0] = row;
    EXPECT_EQ(error_of([&] { sim.restore(crafted); }),
              "the snapshot is of another world: its table \"outbox/*/message\" has other rows")
        << row;
    EXPECT_EQ(sim.digest(), before);
  }
  Snapshot twice = sim.snapshot();
  twice.sets.at("robot").names[1] = twice.sets.at("robot").names[0];
  EXPECT_NE(error_of([&] { sim.restore(twice); }), "");
}

// A whole file with numbers that no run could have saved.
TEST_F(Snapshots, NumbersThatNoRunHasAreRefusedAndTheRunStands) {
  Simulation sim = run(two_robots +
                       "<toy.copy_physics name='n' to='self/x'/>\n<toy.list name='l'/>\n"
                       "<toy.send_control name='s' robot='a' to='outbox/{robot}/message' size='20'/>\n");
  step(sim, 3);
  const Snapshot saved = sim.snapshot();
  const uint64_t before = sim.digest();
  const auto refused = [&](const auto& craft) {
    Snapshot crafted = saved;
    craft(crafted);
    std::string error = error_of([&] { sim.restore(crafted); });
    EXPECT_EQ(sim.digest(), before) << error;
    return error;
  };
  const std::string of = "the snapshot is of another world: ";
  const Columns& columns = sim.board().find("outbox/*/message")->columns();
  std::size_t bytes = 0;
  while (!columns[bytes].bytes) ++bytes;
  for (const double blob : {0.5, 1.5}) {
    EXPECT_EQ(refused([&](Snapshot& s) { s.tables.at("outbox/*/message").cells.data[bytes] = blob; }),
              of + "its table \"outbox/*/message\" has other rows");
  }
  EXPECT_EQ(refused([](Snapshot& s) { s.sets.erase("instance/n"); }), of + "it has no set \"instance/n\"");
  EXPECT_EQ(refused([](Snapshot& s) {
              auto& ends = s.tables.at("link/*/ends").cells;  // of two columns: as many cells are 0 in 64 bits
              ends.rows = s.sets.at("link").listed = uint64_t{1} << 63;
              ends.data.clear();
            }),
            of + "its table \"link/*/ends\" has other rows");
  const auto with = [&](const std::string& param, double value) {
    const auto number = static_cast<std::size_t>(sim.instances()[0]->find_param(param));
    return refused([&](Snapshot& s) { s.instances.at("n").params.at(number) = value; });
  };
  const std::string other = of + "its instance \"n\" has other parameters";
  for (const double choice : {-1.0, 0.5, 3.0, std::nan("")}) EXPECT_EQ(with("as", choice), other) << choice;
  for (const double row : {-2.0, 0.5, 2.0, std::nan("")}) EXPECT_EQ(with("robot", row), other) << row;
  EXPECT_EQ(with("flags", 32), other);
  EXPECT_EQ(with("add", std::nan("")), other);
  EXPECT_EQ(with("robot", 1), "no error");
}

TEST_F(Snapshots, AcrossAPlannedSwapTheRunGoesOnAsItDid) {
  const std::string text = two_robots +
                           "<toy.copy_physics name='n' to='self/x' own='true' add='1'/>\n"
                           "<swap at='3' instance='n' plugin='toy.copy_sense' to='self/x' own='true' add='100'/>\n";
  Simulation sim = run(text);
  step(sim, 4);
  const Snapshot early = sim.snapshot();
  step(sim, 4);
  const Snapshot late = sim.snapshot();
  step(sim, 4);
  const uint64_t expected = sim.digest();
  Simulation fresh = run(text);
  fresh.restore(late);
  step(fresh, 4);
  EXPECT_EQ(fresh.digest(), expected);
  fresh.restore(early);  // back behind the swap
  step(fresh, 8);
  EXPECT_EQ(fresh.digest(), expected);
  EXPECT_EQ(cell(fresh, "instance/n/x"), 6 + 6 * 100);
}

// Of two stages of a chain one comes on the way, and then the other is swapped.
TEST_F(Snapshots, AcrossAPlannedSwapTheOrderIsThatOfTheFile) {
  const std::string text = two_robots +
                           "<toy.copy_control name='ask' to='robot/*/q' own='true' add='1'/>\n"
                           "<toy.copy_actuate name='first' as='modify' to='robot/*/q' times='2'/>\n"
                           "<at t='1'><toy.copy_actuate name='second' as='modify' to='robot/*/q' add='100'/></at>\n"
                           "<swap at='2' instance='first' plugin='toy.copy_actuate' as='modify' to='robot/*/q' "
                           "times='3'/>\n"
                           "<swap at='3' instance='second' plugin='toy.copy_actuate' as='modify' to='robot/*/q' "
                           "add='1000'/>\n";
  Simulation sim = run(text);
  std::vector<Snapshot> all;
  for (int i = 0; i < 10; ++i) all.push_back(sim.snapshot()), step(sim);
  EXPECT_EQ(cell(sim, "robot/a/q"), 10 * 3 + 1000);
  const uint64_t expected = sim.digest();
  for (const Snapshot& from : all) {
    Simulation fresh = run(text);
    fresh.restore(from);
    step(fresh, static_cast<int>(10 - from.tick));
    EXPECT_EQ(fresh.digest(), expected) << from.tick;
  }
}

TEST_F(Snapshots, ParametersComeBack) {
  Simulation sim = run(two_robots + "<toy.copy_physics name='n' to='self/x' add='1'/>\n");
  sim.set_parameter("n/add", 3);
  const Snapshot saved = sim.snapshot();
  sim.set_parameter("n/add", 4);
  sim.restore(saved);
  step(sim);
  EXPECT_EQ(cell(sim, "instance/n/x"), 3);
}

}  // namespace
}  // namespace muster
