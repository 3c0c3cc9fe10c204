// The stories of docs/real_data.md, as far as they are to hold whatever the search becomes.
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/real_data/tables.hpp"

namespace muster::real_data {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const std::string worlds = MUSTER_SOURCE_DIR "/tests/real_data/";

class RealData : public testing::Test {
 protected:
  RealData() {
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  ~RealData() override { fs::remove_all(folder); }
  void SetUp() override {
    if (!fs::exists(radio_data())) GTEST_SKIP() << "measured data are not there: " << radio_data();
  }

  // What the program prints to both of its outputs.
  static std::string muster(const std::string& arguments) {
    FILE* pipe = popen((std::string(MUSTER_PROGRAM) + ' ' + arguments + " 2>&1").c_str(), "r");
    std::string said;
    std::array<char, 4096> part{};
    for (std::size_t n; (n = fread(part.data(), 1, part.size(), pipe)) > 0;) said.append(part.data(), n);
    pclose(pipe);
    return said;
  }
  static json asked(const std::string& verb, const std::string& world, const fs::path& data) {
    const std::string said = muster(verb + " '" + world + "' --data '" + data.string() + "' --json");
    return json::parse(said.substr(said.find('{')));
  }
  fs::path write(const std::string& name, const std::string& text) const {
    std::ofstream(folder / name) << text;
    return folder / name;
  }
  // A building's campaign in the format of measured data; rows that no receiver gives are left out by hand.
  std::string imported(const std::string& campaign, const std::string& map) const {
    const fs::path from = radio_data() / "cinvestav_multiwall_3g5/PL_Data" / ("PL_" + campaign + ".csv");
    const fs::path to = folder / (campaign + ".csv");
    muster("import '" + from.string() + "' --map " + worlds + "cinvestav/" + map + " --out " + to.string());
    std::ostringstream text;
    text << std::ifstream(to).rdbuf();
    return text.str();
  }
  json buildings(const std::string& name, const std::string& map) const {
    const fs::path both = write(name + ".csv", joined(imported(name + "_C1", map), imported(name + "_C2", map)));
    return asked("diagnose", worlds + "cinvestav", both);
  }

  const fs::path folder = fs::temp_directory_path() / ("muster_real_data_" + std::to_string(getpid()));
};

double fitted(const json& fit, const std::string& name) {
  for (const json& p : fit.at("parameters"))
    if (p.at("name") == name) return p.at("value");
  return std::nan("");
}

// The strength of a named cause about a row; not a number if none is.
double named(const json& diagnosis, const std::string& id, const std::string& label, const std::string& parameter) {
  for (const json& c : diagnosis.at("causes")) {
    if (c.at("status") != "named" || (!id.empty() && c.at("id") != id) || c.at("label") != label) continue;
    for (const json& p : c.at("parameters"))
      if (p.at("name").get<std::string>().find('/' + parameter) != std::string::npos) return p.at("value");
  }
  return std::nan("");
}

bool unexplained(const json& diagnosis, const std::string& covariate) {
  for (const json& u : diagnosis.at("unexplained"))
    if (u.at("covariate") == covariate) return true;
  return false;
}

TEST_F(RealData, ExponentOfTheFlatTakesUpWallsThatAreLeftOut) {
  const fs::path flat = radio_data() / "wut_flat_ble";
  const json with = asked("fit", flat.string(), flat / "measured.csv");
  const json without = asked("fit", worlds + "wut_bare", flat / "measured.csv");
  EXPECT_NEAR(fitted(with, "radio.multiwall/n"), 1.05, 0.02);
  EXPECT_NEAR(fitted(with, "material/partition/loss"), 4.93, 0.05);
  EXPECT_NEAR(fitted(without, "radio.multiwall/n"), 1.99, 0.02);
}

TEST_F(RealData, CommunicationsBuildingHasWallsOfBrick) {
  const fs::path first = write("first.csv", imported("Comms_C1", "walls.map"));
  const json found = asked("diagnose", worlds + "cinvestav", first);
  EXPECT_NEAR(named(found, "effect.counted_walls", "material/brick", "loss"), 3.3, 0.4);
  EXPECT_TRUE(std::isnan(named(found, "effect.counted_walls", "material/glass", "loss")));
  EXPECT_LT(found.at("heldout_rmse_db").get<double>(), found.at("base").at("heldout_rmse_db").get<double>() - 0.5);
  EXPECT_LT(found.at("parameters").at("radio.multiwall/n").get<double>(), 3);  // it was 4.1 without walls
}

// Its second campaign has a path loss of -60 dB.
TEST_F(RealData, ASignThatWasLeftOutIsFound) {
  imported("Comms_C2", "walls.map");
  const std::string said = muster("diagnose " + worlds + "cinvestav --data " + (folder / "Comms_C2.csv").string());
  EXPECT_NE(said.find("Comms_C2.csv:386:19: row 385: a path loss of -60 dB, a level of 60 dBm, is over +30 dBm"),
            std::string::npos)
      << said;
}

TEST_F(RealData, SystemsBuildingHasWallsOfBrick) {
  const json found = buildings("SSE", "walls.map");
  EXPECT_NEAR(named(found, "effect.counted_walls", "material/brick", "loss"), 3.6, 1.5) << found.dump();
}

TEST_F(RealData, NoWallIsNamedInTheLibrary) {
  for (const char* campaign : {"Library_C1", "Library_C2"}) {
    const fs::path data = write("library.csv", imported(campaign, "library.map"));
    const json found = asked("diagnose", worlds + "cinvestav", data);
    for (const json& c : found.at("causes"))
      EXPECT_FALSE(c.at("status") == "named" && c.at("id") == "effect.counted_walls") << campaign << found.dump();
  }
}

TEST_F(RealData, WeakReadingsOfTheOfficeAreMissingAndItsShelvesCostLevel) {
  const fs::path all = write("all.csv", uji_table(-20, false)), heard = write("heard.csv", uji_table(-20, true));
  const std::string said = asked("diagnose", worlds + "uji_geo", all).at("notes").dump();
  EXPECT_NE(said.find("more readings are missing where less is expected"), std::string::npos) << said;
  const json found = asked("diagnose", worlds + "uji_geo", heard);
  EXPECT_NEAR(named(found, "effect.counted_walls", "material/shelf", "loss"), 2.1, 0.7) << found.dump();
}

TEST_F(RealData, LevelsDependOnThePhoneAndOnHowItIsCarried) {
  const json found = asked("diagnose", worlds + "body_shadow", write("body.csv", body_table()));
  EXPECT_TRUE(unexplained(found, "carried")) << found.dump();
  double phone = std::nan("");  // whether it hears badly or its readings are off, this data cannot tell
  for (const char* cause : {"offset", "loss"}) {
    const double value = named(found, "", "radio/N8", cause);
    if (!std::isnan(value)) phone = std::abs(value);
  }
  EXPECT_NEAR(phone, 42, 4) << found.dump();
  for (const json& c : found.at("causes")) EXPECT_NE(c.at("id"), "effect.body_shadow");  // no heading was recorded
}

}  // namespace
}  // namespace muster::real_data
