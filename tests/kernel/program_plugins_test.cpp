// A program that embeds the kernel has plugins of its own.
#include <gtest/gtest.h>

#include <muster/plugin.hpp>

#include "kernel/simulation.hpp"
#include "tests/folder.hpp"

namespace muster::test {
namespace {

struct Count {
  static constexpr auto id = "own.count/3", summary = "counts ticks";
  static constexpr auto phase = MUSTER_OBSERVE;
  struct Row {
    static constexpr const char* columns = "ticks";
    double ticks;
  };
  explicit Count(Setup& s) : sum(s.write<Row>("self/sum")) {}
  void step(const Step& k) const { k[sum]->ticks = k.last(sum)->ticks + 1; }
  Out<Row> sum;
};

int register_count(uint32_t abi, void* registry, muster_add add) {
  return abi == MUSTER_ABI ? add(registry, detail::descriptor<Count>()) : MUSTER_FAILED;
}

World counting_world() {
  const Folder folder;
  folder.write("world.xml", R"(<world name="w" dt="1" until="9"><own.count name="a"/></world>)");
  return read_world(folder.path() / "world.xml", standard());
}

TEST(ProgramPlugins, RunWithoutAFile) {
  Options options;
  options.libraries = {Library::of_program(register_count)};
  EXPECT_TRUE(options.libraries[0]->file().empty());
  Simulation run(counting_world(), standard(), options);
  for (int i = 0; i < 5; ++i) run.step();
  EXPECT_EQ(run.table("instance/a/sum").at(0, 0), 5);
  EXPECT_STREQ(run.instances()[0]->plugin().id, "own.count/3");
}

TEST(ProgramPlugins, AreUnknownToAProgramWithoutThem) {
  EXPECT_THROW(Simulation(counting_world(), standard(), {}), Error);
}

TEST(ProgramPlugins, AreCheckedAsThoseOfFiles) {
  const auto refuses = [](uint32_t, void*, muster_add) -> int { return MUSTER_FAILED; };
  EXPECT_THROW(Library::of_program(refuses), std::runtime_error);
}

}  // namespace
}  // namespace muster::test
