// Requirements for any plugin that fills columns of links, identified by its file alone: each *.so among the plugins.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "kernel/simulation.hpp"
#include "tests/folder.hpp"

namespace muster {
namespace {

using Pair = std::pair<std::size_t, std::size_t>;
using Values = std::map<std::string, std::map<Pair, uint64_t>>;  // of a table, by sender and receiver: bits

const std::string elements =
    "<material name='brick' loss='6'/>\n<material name='wood' loss='2'/>\n"
    "<wall name='w1' from='2 -5' to='2 5' material='brick'/>\n<wall name='w2' from='-5 3' to='9 3.5' "
    "material='wood'/>\n"
    "<door wall='w1' at='4' width='1'/>\n<mesh file='tent.obj' material='wood' at='1 -1 0'/>\n"
    "<station name='a' at='0 0 1'/>\n<station name='b' at='5 1 1'/>\n<station name='c' at='5 1 1'/>\n"  // b and c
                                                                                                        // coincide
    "<station name='d' at='0.5 8 2'/>\n<station name='e' at='-3 -4 0'/>\n";

// A tetrahedron between a and most of the others.
void write_mesh(const test::Folder& folder) {
  folder.write("tent.obj", "v 0 0 0\nv 2 0 0\nv 0 3 0\nv 0 1 4\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
}

struct Term {
  std::string id;
  bool is_reciprocal = false;  // by its manual
};

class RadioTerm : public testing::TestWithParam<Term> {
 protected:
  Simulation run(const std::string& order = "", const std::string& name = "term") const {
    write_mesh(folder);
    std::ofstream(folder / "world.xml") << "<world dt='0.25' until='9' seed='3'>\n"
                                        << elements << "<conformance.links " << order << "/>\n<" << GetParam().id
                                        << " name='" << name << "'/>\n</world>\n";
    Options options;
    options.search_path = {MUSTER_BUILD_DIR "/tests/conformance", MUSTER_PLUGINS_DIR};
    return Simulation(read_world(folder.path(), standard()), standard(), options);
  }

  // Values that the instance writes, for every link.
  static Values values(const Simulation& sim) {
    const TableView ends = sim.table("link/*/ends");
    Values result;
    for (const auto& claim : sim.instances()[1]->claims()) {
      if (!claim.out || claim.name.set != "link") continue;
      const Table& table = *claim.out;
      const std::string name = table.name().substr(0, table.name().find('@')) + '@' + claim.name.part;
      for (std::size_t i = 0; i < table.now().rows; ++i) {
        for (std::size_t c = 0; c < table.width(); ++c)
          result[name + ' ' + table.columns()[c].name]
                [{static_cast<std::size_t>(ends.at(i, 0)), static_cast<std::size_t>(ends.at(i, 1))}] =
                    std::bit_cast<uint64_t>(table.now().data[i * table.width() + c]);
      }
    }
    EXPECT_FALSE(result.empty());
    return result;
  }

  const test::Folder folder;
};

void step(Simulation& sim, int ticks) {
  for (int i = 0; i < ticks; ++i) sim.step();
}

TEST_P(RadioTerm, IsFiniteWhereEndsCoincideAndSeesEveryLink) {
  Simulation sim = run();
  step(sim, 3);  // the kernel refuses infinities and NaN
  for (const auto& [table, cells] : values(sim)) EXPECT_EQ(cells.size(), 20u) << table;
}

TEST_P(RadioTerm, DoesNotDependOnTheOrderOfLinksOrOnItsName) {
  Simulation forward = run(), backward = run("backward='true'"), renamed = run("", "zzz");
  step(forward, 3), step(backward, 3), step(renamed, 3);
  EXPECT_EQ(values(forward), values(backward));
  EXPECT_EQ(values(forward), values(renamed));
}

TEST_P(RadioTerm, IsAFunctionOfItsInputsAlone) {
  Simulation sim = run(), jumped = run();
  step(sim, 2);
  const Snapshot then = sim.snapshot();
  const Values at_2 = values(sim);
  step(sim, 5);
  const Values at_7 = values(sim);
  EXPECT_NE(sim.tick(), then.tick);
  jumped.restore(sim.snapshot());
  jumped.evaluate(MUSTER_RADIO, false);
  EXPECT_EQ(values(jumped), at_7);
  sim.restore(then);
  sim.remake("term");
  sim.evaluate(MUSTER_RADIO, false);
  EXPECT_EQ(values(sim), at_2);
  sim.evaluate(MUSTER_RADIO, true);
  const Values expected = values(sim);
  sim.evaluate(MUSTER_RADIO, true);
  EXPECT_EQ(values(sim), expected);
  sim.evaluate(MUSTER_RADIO, false);
  EXPECT_EQ(values(sim), at_2);
  step(sim, 5);
  EXPECT_EQ(values(sim), at_7);
}

TEST_P(RadioTerm, IsReciprocalToTheLastBitIfItsManualSaysSo) {
  Simulation sim = run();
  step(sim, 3);
  bool reciprocal = true;
  for (const auto& [table, cells] : values(sim)) {
    for (const auto& [pair, bits] : cells) reciprocal &= cells.at({pair.second, pair.first}) == bits;
  }
  RecordProperty("reciprocal", reciprocal ? "yes" : "no");
  if (GetParam().is_reciprocal) {
    EXPECT_TRUE(reciprocal);
  }
}

// Plugins that write columns of links and can be made without attributes.
std::vector<Term> terms() {
  std::vector<Term> result;
  for (const auto& listed : list_plugins({MUSTER_PLUGINS_DIR})) {
    if (!listed.library) continue;
    const muster_plugin& plugin = listed.library->plugins().back();
    bool needs = plugin.phase != MUSTER_RADIO;
    for (uint32_t i = 0; i < plugin.param_count; ++i) needs |= (plugin.params[i].flags & MUSTER_REQUIRED) != 0;
    if (needs) continue;
    const std::string id(listed.library->id()), manual = plugin.manual ? plugin.manual : "";
    const test::Folder folder;
    write_mesh(folder);
    std::ofstream(folder / "world.xml") << "<world until='1'>\n"
                                        << elements << "<conformance.links/>\n<" << id << " name='term'/>\n</world>\n";
    try {
      Options options;
      options.search_path = {MUSTER_BUILD_DIR "/tests/conformance", MUSTER_PLUGINS_DIR};
      const Simulation sim(read_world(folder.path(), standard()), standard(), options);
      bool adds = false;
      for (const auto& claim : sim.instances()[1]->claims()) adds |= claim.out && claim.name.set == "link";
      if (adds)
        result.push_back({id, manual.find("both ways") != manual.npos || manual.find("eciprocal") != manual.npos});
    } catch (const Error&) {  // another lister, or one that needs more than a world of links
    }
  }
  return result;
}

// A plugin that terms() drops is not checked at all. These need no attributes and say that they are reciprocal.
TEST(RadioTerms, AreAmongThemWhoseFilesAreThere) {
  const std::vector<Term> all = terms();
  for (const std::string name : {"multiwall", "fading", "ar1", "gudmundson"}) {
    if (!std::filesystem::exists(std::string(MUSTER_PLUGINS_DIR) + "/radio_" + name + ".so")) continue;
    const auto found = std::find_if(all.begin(), all.end(), [&](const Term& t) { return t.id == "radio." + name; });
    ASSERT_NE(found, all.end()) << name;
    EXPECT_TRUE(found->is_reciprocal) << name;
  }
}

// A build without any radio plugin has nothing to check here.
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(RadioTerm);
INSTANTIATE_TEST_SUITE_P(Plugins, RadioTerm, testing::ValuesIn(terms()), [](const auto& term) {
  std::string name = term.param.id;
  for (char& c : name) c = c == '.' ? '_' : c;
  return name;
});

}  // namespace
}  // namespace muster
