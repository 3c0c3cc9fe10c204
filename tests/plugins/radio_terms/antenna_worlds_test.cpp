// Antennas in running worlds: they turn with their carrier, count at both ends, and belong to the named radios.
#include <cmath>

#include "tests/plugins/radio/world_of.hpp"
#include "text/error.hpp"

namespace muster {
namespace {

constexpr double dipole_gain = 2.1509;  // dBi
const std::string silence = "<radio.multiwall model=\"perfect\" l0=\"0\"/>\n";

std::string robots(int count) {
  std::string result;
  for (int i = 0; i < count; ++i) result += "<robot name=\"r" + std::to_string(i) + "\" at=\"0 0 0\"/>\n";
  return result;
}

// The axis of a body that points along its own z, in the world.
std::array<double, 3> upward(const TableView& pose, std::size_t row) {
  const double w = pose.at(row, 3), x = pose.at(row, 4), y = pose.at(row, 5), z = pose.at(row, 6);
  return {2 * (x * z + w * y), 2 * (y * z - w * x), 1 - 2 * (x * x + y * y)};
}

TEST(AntennaWorld, DoesNotChangeWhenAllTurnTogether) {
  for (const char* antenna : {"<radio.antenna/>", "<radio.antenna pattern=\"sector\" elevation=\"0.3\" roll=\"1\"/>",
                              "<radio.antenna pattern=\"cosine\" azimuth=\"0.7\"/>"}) {
    const Folder folder;
    Simulation sim = world_of(folder, robots(4) + "<test.tumbler/>" + antenna);
    run(sim, 1);
    const auto first = by_pair(sim, "link/*/level");
    ASSERT_EQ(first.size(), 12u);
    for (int tick = 2; tick < 40; ++tick) {
      run(sim, 1);
      for (const auto& [pair, level] : by_pair(sim, "link/*/level"))
        EXPECT_NEAR(level, first.at(pair), 1e-6) << antenna;
    }
  }
}

TEST(AntennaWorld, DipoleTurnsWithAllThreeAxesOfItsBody) {
  const Folder folder;
  Simulation sim =
      world_of(folder, robots(2) + "<test.tumbler apart=\"true\"/><radio.antenna depth=\"60\" radio=\"r0\"/>");
  for (int tick = 0; tick < 60; ++tick) {
    run(sim, 1);
    const auto pose = sim.table("robot/*/pose");
    const auto up = upward(pose, 0);
    double along = 0, length = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const double way = pose.at(1, axis) - pose.at(0, axis);
      along += up[axis] * way, length += way * way;
    }
    const double cosine = along / std::sqrt(length), field = std::cos(1.5707963267948966 * cosine);
    const double expected = dipole_gain + 10 * std::log10(field * field / (1 - cosine * cosine));
    EXPECT_NEAR(by_pair(sim, "link/*/level").at({"r0", "r1"}), expected, 1e-3) << tick;
  }
}

TEST(AntennaWorld, IsReciprocalToTheLastBit) {
  const Folder folder;
  Simulation sim = world_of(folder, robots(5) +
                                        "<test.tumbler/><radio.antenna pattern=\"sector\"/>"
                                        "<radio.antenna name=\"own\" radio=\"r3\"/>");
  run(sim, 7);
  for (const char* table : {"link/*/level@own", "link/*/level@radio.antenna"}) {
    const auto levels = by_pair(sim, table);
    for (const auto& [pair, level] : levels)
      EXPECT_TRUE(same_bits(level, levels.at({pair.second, pair.first}))) << table;
  }
}

TEST(AntennaWorld, CountsAtBothEndsAndOnceARadio) {
  const Folder folder;
  Simulation sim = world_of(folder, station("a", "0 0 1") + station("b", "5 0 1") + station("c", "0 5 1") + silence +
                                        "<radio.antenna name=\"all\"/><radio.antenna name=\"one\" radio=\"c\" "
                                        "pattern=\"cosine\" beamwidth=\"1.5\" depth=\"20\" loss=\"0.5\"/>");
  run(sim, 1);
  const double lobe = 10 * std::log10(2 * (1 + std::log(0.5) / std::log(std::cos(0.75)))) - 0.5;
  EXPECT_NEAR(by_pair(sim, "link/*/level@all").at({"a", "b"}), 2 * dipole_gain, 2e-3);
  EXPECT_NEAR(by_pair(sim, "link/*/level@all").at({"a", "c"}), dipole_gain, 2e-3);
  EXPECT_EQ(by_pair(sim, "link/*/level@one").at({"a", "b"}), 0);
  // c faces east, away from a: its back radiates a hundredth, which the lobe lacks.
  EXPECT_NEAR(by_pair(sim, "link/*/level@one").at({"c", "a"}), lobe - 20, 0.2);
  EXPECT_NEAR(sim.table("radio/*/antenna").at(2, 0), lobe, 0.2);
  EXPECT_TRUE(std::isnan(sim.table("radio/*/antenna").at(0, 0)));
  EXPECT_TRUE(std::isnan(sim.table("radio/*/common_antenna").at(2, 0)));
}

TEST(AntennaWorld, RadiatesWhatItIsFed) {
  // b goes round a: over a sphere of places the mean gain of a is its loss.
  for (const char* pattern : {"dipole", "cosine", "sector"}) {
    const Folder folder;
    std::string places;
    constexpr int count = 400;
    for (int i = 0; i < count; ++i) {  // Fibonacci's points
      const double z = (2 * i + 1.0) / count - 1, turn = 2.399963229728653 * i, across = std::sqrt(1 - z * z);
      places += station("p" + std::to_string(i), std::to_string(across * std::cos(turn)) + ' ' +
                                                     std::to_string(across * std::sin(turn)) + ' ' + std::to_string(z));
    }
    Simulation sim = world_of(folder, station("a", "0 0 0") + places + silence +
                                          "<radio.antenna name=\"of_a\" radio=\"a\" pattern=\"" + pattern +
                                          "\" loss=\"2\" elevation=\"0.4\"/>");
    run(sim, 1);
    double mean = 0;
    for (const auto& [pair, level] : by_pair(sim, "link/*/level@of_a")) {
      if (pair.first == "a") mean += std::pow(10, level / 10) / count;
    }
    EXPECT_NEAR(10 * std::log10(mean), -2, 0.1) << pattern;
  }
}

TEST(AntennaWorld, OfATableHasItsGains) {
  const Folder folder;
  folder.put("patch.csv",
             "azimuth[rad],elevation[rad],gain[dBi]\n0,-1.571,-12\n0,0,6\n0,1.571,-12\n3.14159,-1.571,-12\n"
             "3.14159,0,-10\n3.14159,1.571,-12\n");
  Simulation sim = world_of(
      folder, station("a", "0 0 1") + station("east", "5 0 1") + station("west", "-5 0 1") + station("north", "0 5 1") +
                  silence +
                  "<radio.antenna name=\"patch\" radio=\"a\" pattern=\"table\" file=\"patch.csv\" loss=\"1\"/>");
  run(sim, 1);
  const auto levels = by_pair(sim, "link/*/level@patch");
  EXPECT_NEAR(levels.at({"a", "east"}), 5, 1e-9);
  EXPECT_NEAR(levels.at({"west", "a"}), -11, 1e-4);
  EXPECT_NEAR(levels.at({"north", "a"}), (6 - 10) / 2.0 - 1, 1e-4);
  EXPECT_EQ(sim.table("radio/*/antenna").at(0, 0), 5);
}

TEST(AntennaWorld, ACopyOfARadioWithItsOwnHasTheCommonOne) {
  const Folder folder;
  Simulation sim = world_of(folder, station("a", "0 0 1") + station("b", "9 0 1") + silence +
                                        "<radio.antenna name=\"of_a\" radio=\"a\" pattern=\"isotropic\" loss=\"3\"/>"
                                        "<radio.antenna name=\"common\" pattern=\"isotropic\" loss=\"7\"/>"
                                        "<test.joiner radio=\"late\" like=\"a\" at=\"2\"/>");
  run(sim, 4);
  const TableView common = sim.table("radio/*/common_antenna");
  EXPECT_TRUE(std::isnan(common.at(0, 0)));
  EXPECT_NEAR(common.at(1, 0), -7, 1e-9);
  EXPECT_NEAR(common.at(2, 0), -7, 1e-9);
  EXPECT_NEAR(by_pair(sim, "link/*/level@common").at({"late", "b"}), -14, 1e-9);
}

TEST(AntennaWorld, SaysWhatIsWrong) {
  const Folder folder;
  const auto file = folder.put("full.csv", "azimuth[rad],elevation[rad],gain[dBi]\n0,-1.571,3\n0,1.571,3\n");
  folder.put("degrees.csv", "azimuth[deg],elevation[deg],gain[dBi]\n0,-90,0\n0,90,0\n");
  const auto refusal = [&](const std::string& elements) -> std::string {
    try {
      Simulation sim = world_of(folder, station("a", "0 0 0") + station("b", "1 0 0") + elements);
      run(sim, 1);
    } catch (const Error& refused) {
      std::string said = refused.what();
      const std::string where = file.parent_path().string() + '/';
      for (std::size_t at = 0; (at = said.find(where, at)) != said.npos;) said.erase(at, where.size());
      return said;
    }
    return "";
  };
  EXPECT_EQ(refusal("<radio.antenna pattern=\"table\"/>"),
            "world.xml:4:1: radio.antenna (radio.antenna): has no attribute \"file\", which it needs; expected a path "
            "relative to the world file");
  folder.put("phase.csv", "azimuth[rad],elevation[rad],gain[dBi],phase[rad]\n0,0,0,0\n");
  EXPECT_EQ(refusal("<radio.antenna pattern=\"table\" file=\"phase.csv\"/>"),
            "phase.csv:1:39: column \"phase\" means nothing here; expected one of azimuth, elevation, gain");
  EXPECT_EQ(refusal("<radio.antenna file=\"full.csv\"/>"),
            "world.xml:4:22: attribute \"file\": only pattern=\"table\" reads "
            "one");
  EXPECT_EQ(
      refusal("<radio.antenna pattern=\"table\" file=\"full.csv\"/>"),
      "world.xml:4:38: attribute \"file\": it "
      "radiates more than it is fed: its mean gain over all directions is 3.000 dBi; expected at most 0, or 0.5 for "
      "errors of calibration");
  EXPECT_EQ(
      refusal("<radio.antenna pattern=\"table\" file=\"degrees.csv\"/>"),
      "degrees.csv:1:1: column \"azimuth[deg]\" has the wrong unit; expected \"azimuth[rad]\": 1 deg is 0.0174533 rad");
  EXPECT_EQ(refusal("<radio.antenna radio=\"a\"/><radio.antenna name=\"second\" radio=\"a\"/>"),
            "world.xml:4:27: second (radio.antenna): writes \"radio/a/antenna\"; so does world.xml:4:1: radio.antenna "
            "(radio.antenna); expected one of the two");
  EXPECT_EQ(refusal("<radio.antenna/><radio.antenna name=\"second\"/>"),
            "world.xml:4:17: second (radio.antenna): writes \"radio/*/common_antenna\"; so does world.xml:4:1: "
            "radio.antenna (radio.antenna); expected one of the two");
  EXPECT_EQ(
      refusal("<radio.antenna pattern=\"yagi\"/>"),
      "world.xml:4:25: attribute \"pattern\": \"yagi\" is not a choice; expected one of dipole, isotropic, cosine, "
      "sector, table");
  EXPECT_EQ(refusal("<radio.antenna beamwidth=\"65\"/>"),
            "world.xml:4:27: attribute \"beamwidth\": 65 is out of bounds; expected a number from 0.1 to 3.1 rad; 65 "
            "degrees are 1.134 rad");
}

}  // namespace
}  // namespace muster
