// Worlds written, run and read by tests.
#pragma once

#include <gtest/gtest.h>

#include <bit>
#include <filesystem>
#include <fstream>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "kernel/simulation.hpp"

namespace muster {

// A folder of its own for each test, gone afterwards.
class Folder {
 public:
  Folder() {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string(test->test_suite_name()) + '.' + test->name();
    for (char& c : name) c = c == '/' ? '_' : c;
    path_ = std::filesystem::path(testing::TempDir()) / ("muster_radio_" + name);
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::filesystem::path put(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

// `elements` are the contents of <world>.
inline Simulation world_of(const Folder& folder, const std::string& elements, int workers = 1,
                           const std::string& dt = "0.1") {
  const auto file = folder.put(
      "world.xml", "<world name=\"test\" dt=\"" + dt + "\" until=\"100\" seed=\"7\">\n" + elements + "</world>\n");
  Options options;
  options.search_path = {MUSTER_PLUGINS_DIR, MUSTER_ACTORS_DIR, MUSTER_BUILD_DIR "/tests/toys"};
  options.workers = workers;
  return Simulation(read_world(file, standard()), standard(), options);
}

inline std::string station(const std::string& name, const std::string& at) {
  return "<station name=\"" + name + "\" at=\"" + at + "\"/>\n";
}

inline std::string send(const std::string& name, const std::string& sender, const std::string& attributes = "") {
  return "<test.sender name=\"" + name + "\" from=\"" + sender + "\" " + attributes + "/>\n";
}

using Pair = std::pair<std::string, std::string>;

// The first column of a link table, by names of sender and receiver.
inline std::map<Pair, double> by_pair(const Simulation& world, const std::string& table) {
  const TableView ends = world.table("link/*/ends"), radio = world.table("endpoint/*/radio"),
                  values = world.table(table);
  const auto& names = world.board().find_set("radio")->names;
  const auto name_at = [&](double end) {
    return names[static_cast<std::size_t>(radio.at(static_cast<std::size_t>(end), 0))];
  };
  std::map<Pair, double> result;
  for (std::size_t i = 0; i < ends.rows(); ++i)
    result[{name_at(ends.at(i, 0)), name_at(ends.at(i, 1))}] = values.at(i, 0);
  return result;
}

// Equal to the last bit, null included.
inline bool same_bits(double a, double b) { return std::bit_cast<uint64_t>(a) == std::bit_cast<uint64_t>(b); }
inline void expect_same_bits(const std::map<Pair, double>& a, const std::map<Pair, double>& b) {
  ASSERT_EQ(a.size(), b.size());
  for (const auto& [pair, value] : a) {
    ASSERT_TRUE(b.count(pair));
    EXPECT_TRUE(same_bits(value, b.at(pair))) << pair.first << " -> " << pair.second;
  }
}

inline void run(Simulation& world, int ticks) {
  for (int i = 0; i < ticks; ++i) world.step();
}

// 50 ticks of make_world(workers) are the same bits on other numbers of workers, with instances remade repeatedly, and
// restored from a snapshot of the tick `middle`.
template <class MakeWorld>
void expect_same_run(const MakeWorld& make_world, const std::vector<std::string>& made_anew, int middle) {
  constexpr int ticks = 50;
  Simulation straight = make_world(1);
  run(straight, ticks);
  for (const int workers : {2, 3}) {
    Simulation other = make_world(workers);
    run(other, ticks);
    EXPECT_EQ(straight.digest(), other.digest()) << workers;
  }
  Simulation remade = make_world(1);
  for (int k = 0; k < ticks; ++k) {
    for (const auto& instance : made_anew)
      if (remade.tick() % 7 == 3) remade.remake(instance);
    remade.step();
  }
  EXPECT_EQ(straight.digest(), remade.digest());
  Simulation first = make_world(1), again = make_world(1);
  run(first, middle);
  again.restore(first.snapshot());
  run(again, ticks - middle);
  EXPECT_EQ(straight.digest(), again.digest());
}

}  // namespace muster
