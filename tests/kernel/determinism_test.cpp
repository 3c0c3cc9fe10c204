// The same bits for any number of workers, after saving and restoring, after every instance was made again, in any
// locale and in another process.
#include <sys/wait.h>

#include <clocale>
#include <cstdlib>
#include <locale>

#include "busy_world.hpp"

namespace muster {
namespace {

using Determinism = ToyWorld;
constexpr int ticks = 40;

class DecimalComma : public std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

class SameBits : public ToyWorld {
 protected:
  SameBits() {
    Simulation sim = run(busy_world);
    step(sim, ticks);
    expected = sim.digest();
  }
  uint64_t expected = 0;
};

TEST_F(SameBits, ForAnyNumberOfWorkers) {
  for (const int workers : {1, 2, 3, 7}) {
    Simulation sim = run(busy_world, workers);
    step(sim, ticks);
    EXPECT_EQ(sim.digest(), expected) << workers;
  }
}

TEST_F(SameBits, AfterRestoringInMemory) {
  for (const int at : {0, 5, 6, 12, 17, 18, 30}) {
    Simulation sim = run(busy_world), fresh = run(busy_world);
    step(sim, at);
    const Snapshot saved = sim.snapshot();
    step(sim, 7);  // there and back
    sim.restore(saved);
    fresh.restore(saved);
    EXPECT_EQ(fresh.digest(), saved.digest());
    step(sim, ticks - at), step(fresh, ticks - at);
    EXPECT_EQ(sim.digest(), expected) << at;
    EXPECT_EQ(fresh.digest(), expected) << at;
  }
}

TEST_F(SameBits, AfterRestoringFromAFile) {
  Simulation sim = run(busy_world), fresh = run(busy_world);
  step(sim, 13);
  sim.snapshot().save(folder / "saved");
  fresh.restore(Snapshot::load(folder / "saved"));
  step(fresh, ticks - 13);
  EXPECT_EQ(fresh.digest(), expected);
}

TEST_F(SameBits, AfterEveryInstanceWasMadeAgain) {
  Simulation sim = run(busy_world);
  for (int tick = 0; tick < ticks; ++tick) {
    if (tick % 3 == 1) {
      std::vector<std::string> names;
      for (const auto& i : sim.instances()) names.push_back(i->name());
      for (const auto& name : names) sim.remake(name);
    }
    step(sim);
  }
  EXPECT_EQ(sim.digest(), expected);
}

TEST_F(SameBits, WhereADecimalPointIsAComma) {
  const std::locale before = std::locale::global(std::locale(std::locale::classic(), new DecimalComma));
  const char* german = std::setlocale(LC_ALL, "de_DE.UTF-8");
  RecordProperty("german_locale_of_c", german ? "yes" : "not installed");
  Simulation sim = run(busy_world);
  step(sim, ticks);
  std::setlocale(LC_ALL, "C");
  std::locale::global(before);
  EXPECT_EQ(sim.digest(), expected);
}

TEST_F(SameBits, InAnotherProcess) {
  const auto file = folder / "digest";
  const pid_t child = fork();
  if (child == 0) {
    // A newly started program, so that no address is the same.
    const std::string out = "MUSTER_DIGEST_TO=" + file.string();
    execle("/proc/self/exe", "test_kernel", "--gtest_filter=Digest.OfTheBusyWorldTwice", nullptr,
           std::vector<char*>{const_cast<char*>(out.c_str()), nullptr}.data());
    _exit(127);
  }
  int status = -1;
  ASSERT_EQ(waitpid(child, &status, 0), child);
  std::ifstream in(file);
  uint64_t digest = 0;
  in >> digest;
  EXPECT_EQ(digest, expected);
}

// The test above runs this one in a process of its own, and gives it the digest's file.
class Digest : public ToyWorld {};
TEST_F(Digest, OfTheBusyWorldTwice) {
  Simulation sim = run(busy_world), again = run(busy_world);
  step(sim, ticks), step(again, ticks);
  EXPECT_EQ(sim.digest(), again.digest());
  if (const char* to = std::getenv("MUSTER_DIGEST_TO")) std::ofstream(to) << sim.digest();
}

// Results do not depend on names of instances, nor draws on the order of the world file.
TEST_F(Determinism, DrawsDependOnRowsAndStreamsOnly) {
  Simulation one = run(two_robots + "<toy.draw name='x'/>\n<toy.copy_sense name='y' to='robot/*/v'/>\n");
  Simulation other =
      run("<robot name='b' at='2 0 0'/>\n<robot name='a' at='1 0 0'/>\n<toy.copy_sense name='first' "
          "to='robot/*/v'/>\n<toy.draw name='other'/>\n");
  Simulation stream = run(two_robots + "<toy.draw name='x' stream='other'/>\n");
  Simulation seed{world(two_robots + "<toy.draw name='x'/>\n", "dt='0.5' until='9' seed='8'"), standard(), options()};
  for (int tick = 0; tick < 5; ++tick) {
    for (const std::string robot : {"a", "b"}) {
      const std::string table = "robot/" + robot + "/reading";
      EXPECT_TRUE(same_bits(cell(one, table), cell(other, table)));
      EXPECT_NE(cell(one, table), cell(stream, table));
      EXPECT_NE(cell(one, table), cell(seed, table));
    }
    EXPECT_NE(cell(one, "robot/a/reading"), cell(one, "robot/b/reading"));
    step(one), step(other), step(stream), step(seed);
  }
}

TEST_F(Determinism, TheDigestTellsEveryDifference) {
  const auto digest = [&](const std::string& text) {
    Simulation sim = run(text);
    step(sim, 2);
    return sim.digest();
  };
  const std::string base = two_robots + "<toy.copy_radio name='n' to='robot/*/v' add='1'/>\n";
  const uint64_t expected = digest(base);
  EXPECT_EQ(digest(base), expected);
  EXPECT_NE(digest("<robot name=\"a\" at=\"1 0 0\"/>\n<robot name=\"B\" at=\"2 0 0\"/>\n<toy.copy_radio name='n' "
                   "to='robot/*/v' add='1'/>\n"),
            expected);
  EXPECT_NE(digest(two_robots + "<toy.copy_radio name='n' to='robot/*/w' add='1'/>\n"), expected);
  EXPECT_NE(digest(two_robots + "<toy.copy_radio name='n' to='robot/*/v' add='1.0000000000000002'/>\n"), expected);
  EXPECT_NE(digest(two_robots + "<robot name='c' at='1 0 0'/>\n<toy.copy_radio name='n' to='robot/*/v' add='1'/>\n"),
            expected);
  EXPECT_NE(digest(two_robots + "<toy.copy_radio name='n' to='robot/*/v' columns='value[m]' add='1'/>\n"), expected);
}

TEST_F(Determinism, TheDigestTellsEachCellOfASnapshot) {
  Simulation sim = run(busy_world);
  step(sim, 9);
  const Snapshot saved = sim.snapshot();
  const uint64_t expected = saved.digest();
  std::size_t cells = 0;
  for (const auto& [name, table] : saved.tables) {
    for (std::size_t i = 0; i < table.cells.data.size(); ++i) {
      Snapshot other = saved;
      double& cell = other.tables[name].cells.data[i];
      cell = std::bit_cast<double>(std::bit_cast<uint64_t>(cell) ^ 1);
      EXPECT_NE(other.digest(), expected) << name << ' ' << i;
      ++cells;
    }
    for (std::size_t b = 0; b < table.cells.blobs.size(); ++b) {
      Snapshot other = saved;
      auto bytes = *table.cells.blobs[b];
      bytes.back() ^= 1;
      other.tables[name].cells.blobs[b] = std::make_shared<const std::vector<uint8_t>>(bytes);
      EXPECT_NE(other.digest(), expected) << name;
    }
  }
  EXPECT_GT(cells, 100u);
  for (const auto& [name, set] : saved.sets) {
    for (std::size_t r = 0; r < set.names.size(); ++r) {
      Snapshot renamed = saved, gone = saved;
      renamed.sets[name].names[r] += 'x';
      gone.sets[name].alive[r] ^= 1;
      EXPECT_NE(renamed.digest(), expected);
      EXPECT_NE(gone.digest(), expected);
    }
  }
}

}  // namespace
}  // namespace muster
