// Logs as people keep them: radios that the world does not list, a carrier that it does not state.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>

#include "diagnosis/pipeline/diagnose.hpp"
#include "diagnosis/pipeline/extended_world.hpp"
#include "muster/random.hpp"
#include "tests/diagnosis/pipeline/flat.hpp"

namespace muster::diagnosis {
namespace {

std::filesystem::path world_of(const Scratch& scratch, const std::string& name, const std::string& elements) {
  std::ofstream(scratch / name) << "<world name=\"w\" dt=\"0.1\" until=\"1\" seed=\"4\">" << elements
                                << "<radio.multiwall tx_power=\"1\" l0=\"35\" n=\"2\"/>"
                                << "<radio.receiver sensitivity=\"-200\"/></world>\n";
  return scratch / name;
}

const std::string fading = "<radio.fading shadowing=\"3\" decorrelation=\"2\" rician_k=\"6\" per_reading=\"true\"/>";
const std::string stations =
    "<station name=\"s1\" at=\"1 1 1.5\"/><station name=\"s2\" at=\"13 8 1.2\"/>"
    "<station name=\"s3\" at=\"9 1 2\"/>";
const std::string phones =
    "<station name=\"phone1\" at=\"3 3 0.4\"/><station name=\"phone2\" at=\"3 3 0.4\"/>"
    "<station name=\"phone3\" at=\"3 3 0.4\"/>";

// The flat's tour, received by three phones in turn.
std::vector<std::string> by_phones() {
  std::vector<std::string> rows = tour();
  for (std::size_t k = 0; k < rows.size(); ++k)
    rows[k].replace(rows[k].find("rover"), 5, "phone" + std::to_string(1 + (k / 3) % 3));
  return rows;
}

// One of three phones reads 6 dB too high. The finding is the same whether the world lists the phones or not, and the
// extended world has the one that it is about.
TEST(FieldLog, AnOffsetOfARadioThatTheWorldDoesNotList) {
  const Scratch scratch;
  const std::string offset = "<effect.rx_offset radio=\"phone2\" offset=\"6\"/>";
  const auto truth = world_of(scratch, "truth.xml", stations + phones + fading + offset);
  const auto data = drawn_by(scratch, truth, plugins, by_phones());
  const auto listed = world_of(scratch, "listed.xml", stations + phones + fading);
  const auto bare = world_of(scratch, "bare.xml", stations + fading);
  const Diagnosis with = diagnose(listed, data, plugins), without = diagnose(bare, data, plugins);
  EXPECT_EQ(names_in_words(named_causes(without)), "effect.rx_offset radio/phone2");
  EXPECT_EQ(names_in_words(named_causes(with)), names_in_words(named_causes(without)));
  ASSERT_EQ(without.causes.size(), 1u);
  EXPECT_NEAR(without.causes[0].values[0].value, 6, 0.6);
  EXPECT_NEAR(without.causes[0].values[0].value, with.causes[0].values[0].value, 1e-6);
  const Scratch out;
  const auto extended = write_extended_world(without, bare, out / "w");
  EXPECT_EQ(LinkModel(extended, data, plugins).added_radios(), (std::vector<std::string>{"phone1", "phone3"}));
}

// A shift is one in the list of all radios that stand, in the order in which they were found, also where the data alone
// name them.
TEST(FieldLog, AShiftedListIsWrittenWholeAndInItsOrder) {
  const Scratch scratch, out;
  const auto world = world_of(scratch, "world.xml", "<station name=\"s\" at=\"0 0 1\"/>");
  CauseEstimate shifted;
  shifted.id = "effect.labels_shifted";
  shifted.row_parameter = "first";
  shifted.row = "m2";
  shifted.covariates = {"map"};
  shifted.status = inference::Status::named;
  Diagnosis found;
  found.causes = {shifted};
  found.added_radios = {{"car", 5, 5, 1, false}, {"m1", 1, 0, 1, true}, {"m2", 2, 0, 1, true}, {"m3", 3, 0, 1, true}};
  std::ifstream in(write_extended_world(found, world, out / "w"));
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  std::size_t at = 0;
  for (const char* next : {"name=\"s\"", "name=\"m1\"", "name=\"m2\"", "name=\"m3\"", "effect.labels_shifted"}) {
    at = text.find(next, at);
    ASSERT_NE(at, text.npos) << next << " in\n" << text;
  }
  EXPECT_EQ(text.find("car"), text.npos);
}

// A station eleven metres from where the map has it, at the other end of the flat.
TEST(FieldLog, AStationFarFromItsPlaceOnTheMap) {
  const Scratch scratch;
  const auto truth = world_of(scratch, "truth.xml",
                              stations + phones + fading + "<effect.tx_misplaced radio=\"s2\" x=\"2.2\" y=\"7.5\"/>");
  const auto given = world_of(scratch, "given.xml", stations + phones + fading);
  const Diagnosis found = diagnose(given, drawn_by(scratch, truth, plugins, by_phones()), plugins);
  EXPECT_EQ(names_in_words(named_causes(found)), "effect.tx_misplaced radio/s2");
  ASSERT_EQ(found.causes.size(), 1u);
  EXPECT_NEAR(found.causes[0].values.at(0).value, 2.2, 0.7);
  EXPECT_NEAR(found.causes[0].values.at(1).value, 7.5, 0.7);
}

// Nine radios that stand and hear each other every hour. Each link has a shadowing of its own, the same both ways, and
// one radio sends 1.5 dB too little. A share of the noise that is fixed to each direction would take that up.
TEST(FieldLog, ARadioOfAMeshThatSendsTooLittleIsNoNoiseOfItsLinks) {
  const Scratch scratch;
  const Stream random(key_of("mesh"));
  std::string radios, table = "t[s],tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],rssi[dBm]\n";
  std::vector<Eigen::Vector2d> at;
  for (uint64_t k = 0; k < 9; ++k) {
    at.emplace_back(24 * random.uniform(k, 0), 16 * random.uniform(k, 1));
    radios += fmt::format("<station name=\"n{}\" at=\"{} {} 1\"/>", k, at[k].x(), at[k].y());
  }
  for (uint64_t hour = 0; hour < 40; ++hour) {
    for (uint64_t tx = 0; tx < 9; ++tx) {
      for (uint64_t rx = 0; rx < 9; ++rx) {
        if (rx == tx) continue;
        const double shadowing = 3.7 * random.of(9).normal(std::min(tx, rx), std::max(tx, rx));
        const double noise = 1.4 * random.of(10).normal(hour, 9 * tx + rx);
        const double level =
            1 - 35 - 20 * std::log10((at[tx] - at[rx]).norm()) + shadowing + noise - (tx == 4 ? 1.5 : 0);
        table += fmt::format("{},n{},n{},{},{},{},{},{}\n", 3600 * hour + tx, tx, rx, at[tx].x(), at[tx].y(),
                             at[rx].x(), at[rx].y(), std::lround(level));
      }
    }
  }
  std::ofstream(scratch / "measured.csv") << table;
  const auto world = world_of(scratch, "world.xml",
                              radios + "<radio.fading shadowing=\"3.7\" decorrelation=\"0.5\" fading=\"false\"/>");
  const Diagnosis found = diagnose(world, scratch / "measured.csv", plugins);
  ASSERT_EQ(found.causes.size(), 1u);
  EXPECT_EQ(found.causes[0].label, "radio/n4");
  EXPECT_NEAR(std::abs(found.causes[0].values[0].value), 1.5, 0.4) << found.causes[0].id;
}

// A robot that sends, and stations that listen: its heading is that of the sender.
TEST(FieldLog, AnAntennaOnARobotThatSends) {
  const Scratch scratch;
  std::string places = "t[s],tx,rx,tx_x[m],tx_y[m],tx_z[m],tx_yaw[rad],rx_x[m],rx_y[m],rx_z[m]\n";
  std::vector<std::string> rows;
  double t = 0;
  for (int lane = 0; lane < 21; ++lane) {
    for (double along = 0.4; along < 8.6; along += 0.35, t += 0.7) {
      for (const char* station : {"s1", "s2", "s3"})
        rows.push_back(fmt::format("{},rover,{},{},{},0.4,{},{}", t, station, 0.7 + 0.6 * lane,
                                   lane % 2 ? 9 - along : along, (lane % 2 ? -1.57 : 1.57) + 0.4 * std::sin(along),
                                   station[1] == '1'   ? "1,1,1.5"
                                   : station[1] == '2' ? "13,8,1.2"
                                                       : "9,1,2"));
    }
  }
  for (const std::string& row : rows) places += row + '\n';
  std::ofstream(scratch / "places.csv") << places;
  const std::string steady = "rician_k=\"8\" per_reading=\"true\"";
  const auto truth = flat(scratch, 3, steady, "<effect.antenna_rx radio=\"rover\" amplitude=\"3\" direction=\"1\"/>");
  const Eigen::VectorXd drawn = LinkModel(truth, scratch / "places.csv", plugins).drawn();
  std::ofstream measured(scratch / "measured.csv");
  measured << places.substr(0, places.find('\n')) << ",rssi[dBm]\n";
  for (std::size_t i = 0; i < rows.size(); ++i)
    measured << rows[i] << ',' << print_real(drawn[static_cast<Eigen::Index>(i)]) << '\n';
  measured.close();
  const Diagnosis found = diagnose(flat(scratch, 4, steady), scratch / "measured.csv", plugins);
  EXPECT_EQ(names_in_words(named_causes(found)), "effect.antenna_rx radio/rover");
  ASSERT_EQ(found.causes.size(), 1u);
  EXPECT_NEAR(found.causes[0].values.at(0).value, 3, 0.6);
}

// Places in no order, so that distance is not time. Two radios at one height over open ground, at 433 MHz. The world
// has no term with a carrier: it is sought.
TEST(Carrier, IsSoughtWhereTheWorldHasNone) {
  const Scratch scratch;
  const std::string radios = "<station name=\"mast\" at=\"0 0 2\"/><station name=\"car\" at=\"5 0 2\"/>";
  const std::string steady = "<radio.fading shadowing=\"1\" decorrelation=\"2\" rician_k=\"9\" per_reading=\"true\"/>";
  const auto truth =
      world_of(scratch, "truth.xml", radios + steady + "<effect.two_ray reflection=\"0.9\" frequency=\"4.33e8\"/>");
  std::vector<std::string> rows;
  for (int k = 0; k < 500; ++k)
    rows.push_back(print_real(0.5 * k) + ",mast,car,0,0,2," + print_real(3 + 0.1 * ((k * 197) % 500)) + ",0.2,2");
  const auto data = drawn_by(scratch, truth, plugins, rows);
  const Diagnosis found = diagnose(world_of(scratch, "bare.xml", radios), data, plugins);
  ASSERT_FALSE(found.causes.empty());
  EXPECT_EQ(found.causes[0].id, "effect.two_ray");
  for (const CauseValue& v : found.causes[0].values) {
    if (v.name == "frequency") {
      EXPECT_NEAR(v.value, 4.33e8, 0.1 * 4.33e8);
    }
  }
  // The default of a term says nothing of the data; what is written is held.
  const auto carrier_with = [&](const std::string& written) {
    return LinkModel(world_of(scratch, "faded.xml", radios + "<radio.fading" + written + "/>"), data, plugins)
        .carrier();
  };
  EXPECT_FALSE(carrier_with("")->is_written);
  EXPECT_TRUE(carrier_with(" frequency=\"4.33e8\"")->is_written);
  EXPECT_EQ(carrier_with(" frequency=\"4.33e8\"")->frequency, 4.33e8);
}

// Nothing but a field that the world does not state: that is said, and the world is not called adequate.
TEST(FieldLog, AFieldThatTheWorldDoesNotStateIsNotAdequate) {
  const Scratch scratch;
  const auto data = drawn_by(scratch, world_of(scratch, "truth.xml", stations + phones + fading), plugins, by_phones());
  const Diagnosis unstated = diagnose(world_of(scratch, "bare.xml", stations + phones), data, plugins);
  EXPECT_EQ(names_in_words(named_causes(unstated)), "silent");
  EXPECT_STREQ(unstated.verdict(), "unexplained");
  ASSERT_TRUE(unstated.unstated_field);
  EXPECT_GT(unstated.unstated_field->shadowing, 1.5);
  const Diagnosis stated = diagnose(world_of(scratch, "stated.xml", stations + phones + fading), data, plugins);
  EXPECT_STREQ(stated.verdict(), "adequate");
  EXPECT_FALSE(stated.unstated_field);
}

// Six radios that stand hear each other at two powers in turn, in a log without a clock. The lower power is 3 dB less
// low than it says. A world that is written names the power of each row of the log.
TEST(FieldLog, PowersOfAMeshWithoutAClock) {
  const Scratch scratch;
  const Stream random(key_of("powers"));
  std::string radios, table = "tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],rssi[dBm],power[dBm]\n";
  std::vector<Eigen::Vector2d> at;
  for (uint64_t k = 0; k < 6; ++k) {
    at.emplace_back(24 * random.uniform(k, 0), 16 * random.uniform(k, 1));
    radios += fmt::format("<station name=\"n{}\" at=\"{} {} 1\"/>", k, at[k].x(), at[k].y());
  }
  for (uint64_t packet = 0; packet < 20; ++packet) {
    for (uint64_t tx = 0; tx < 6; ++tx) {
      for (uint64_t rx = 0; rx < 6; ++rx) {
        if (rx == tx) continue;
        const double shadowing = 3.7 * random.of(9).normal(std::min(tx, rx), std::max(tx, rx));
        const double noise = 1.4 * random.of(10).normal(packet, 6 * tx + rx);
        const double level = 1 - 35 - 20 * std::log10((at[tx] - at[rx]).norm()) + shadowing + noise;
        table += fmt::format("n{},n{},{},{},{},{},{},{}\n", tx, rx, at[tx].x(), at[tx].y(), at[rx].x(), at[rx].y(),
                             std::lround(level + (packet % 2 == 0 ? 0 : 3)), packet % 2 == 0 ? 10 : 0);
      }
    }
  }
  std::ofstream(scratch / "measured.csv") << table;
  const auto world = world_of(scratch, "world.xml", radios);
  const Diagnosis found = diagnose(world, scratch / "measured.csv", plugins);
  EXPECT_EQ(names_in_words(named_causes(found)), "effect.power_steps all");
  ASSERT_EQ(found.causes.size(), 1u);
  EXPECT_EQ(found.causes[0].values.at(0).name, "error1");
  EXPECT_NEAR(found.causes[0].values.at(0).value, 3, 0.4);
  const Scratch out;
  const auto extended = write_extended_world(found, world, out / "w");
  EXPECT_TRUE(named_causes(diagnose(extended, scratch / "measured.csv", plugins)).empty());
}

// Twenty readings of each place, of which nobody knows when they were made, follow the battery. Averaged by places they
// did not, and the world was adequate.
TEST(FieldLog, ReadingsWithoutAClockDependOnAColumn) {
  const Scratch scratch;
  const Stream random(key_of("battery"));
  std::string table = "tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],battery,rssi[dBm]\n";
  for (uint64_t place = 0; place < 30; ++place) {
    for (uint64_t k = 0; k < 20; ++k) {
      const double battery = random.uniform(place, k), x = 2 + 0.7 * static_cast<double>(place);
      const double level = 1 - 35 - 20 * std::log10(x) + 6 * battery + 2 * random.of(9).normal(place, k);
      table += fmt::format("s1,rover,0,0,{},0,{},{}\n", x, battery, std::lround(level));
    }
  }
  std::ofstream(scratch / "measured.csv") << table;
  const auto world = world_of(scratch, "world.xml", "<station name=\"s1\" at=\"0 0 1\"/>");
  EXPECT_EQ(names_in_words(named_causes(diagnose(world, scratch / "measured.csv", plugins))), "~battery");
}

// One link, half an hour between readings from a time [s] on, of which the first are 40 dB higher.
Diagnosis of_one_link(const Scratch& scratch, int higher, int from) {
  const Stream random(key_of("one link"));
  std::string table = "t[s],tx,rx,tx_x[m],tx_y[m],rx_x[m],rx_y[m],rssi[dBm]\n";
  for (int k = 0; k < 300; ++k) {
    const double noise = random.normal(static_cast<uint64_t>(k), 0);
    table +=
        fmt::format("{},s1,rover,0,0,100,0,{}\n", from + 1800 * k, std::lround(-80 + noise + (k < higher ? 40 : 0)));
  }
  std::ofstream(scratch / "measured.csv") << table;
  return diagnose(world_of(scratch, "world.xml", "<station name=\"s1\" at=\"0 0 1\"/>"), scratch / "measured.csv",
                  plugins);
}

// The clock may begin anywhere.
TEST(FieldLog, AStepIsNamedNearTheEndOfALog) {
  for (const int from : {0, -400000}) {
    const Scratch scratch;
    const Diagnosis found = of_one_link(scratch, 10, from);
    ASSERT_FALSE(found.causes.empty()) << from;
    EXPECT_EQ(found.causes[0].id, "effect.step") << from;
    for (const CauseValue& v : found.causes[0].values) {
      const double truth = v.name == "at" ? from + 9.5 * 1800 : v.name == "size" ? -40 : v.value;
      EXPECT_NEAR(v.value, truth, v.name == "at" ? 1800 : 1) << v.name << from;
    }
  }
}

}  // namespace
}  // namespace muster::diagnosis
