// Measured readings with all columns that a cause may read, in a world with walls and doors, and the effect of a cause
// on them.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "kernel/simulation.hpp"
#include "text/number.hpp"

namespace muster {

struct Reading {
  double t;
  std::string tx, rx;
  struct At {
    double x, y, z, yaw;
  } from, to;
  double power, noise;
};

inline double length(const Reading& r) { return std::hypot(r.from.x - r.to.x, r.from.y - r.to.y, r.from.z - r.to.z); }

// Bearing of the other end from the first, relative to its heading.
inline double seen(const Reading::At& own, const Reading::At& other) {
  return std::atan2(other.y - own.y, other.x - own.x) - own.yaw;
}

inline double own_noise(const std::string& radio) { return 1.5 * (radio[0] - 'a'); }

// Synthetic readings of radios a and b, which are stationary, and r and s, which move; each pair in both directions.
inline std::vector<Reading> survey(int ticks = 40) {
  const Stream random(key_of("survey"));
  uint64_t drawn = 0;
  const auto uniform = [&](double low, double high) { return low + (high - low) * random.uniform(drawn++); };
  std::vector<Reading> result;
  for (int i = 0; i < ticks; ++i) {
    const double t = 3 * i + 0.125;
    const Reading::At a{0, 0, 1, 0.5}, b{14, 9, 4, -2};
    const Reading::At r{uniform(-2, 15), uniform(-2, 10), uniform(0.2, 0.5), uniform(-3, 3)};
    const Reading::At s{uniform(-2, 15), uniform(-2, 10), uniform(0.2, 2.5), uniform(-3, 3)};
    const double power = i % 3 == 0 ? -10 : i % 3 == 1 ? 0 : 4, noise = uniform(-100, -80);
    for (const auto& [one, other, from, to] :
         {std::tuple{"a", "r", a, r}, {"b", "r", b, r}, {"a", "s", a, s}, {"b", "s", b, s}, {"r", "s", r, s}}) {
      // Packets of one tick come one after the other, so the noise is that of a packet.
      result.push_back({t, one, other, from, to, power, noise + own_noise(other) + 0.4 * own_noise(one)});
      result.push_back({t, other, one, to, from, power, noise + own_noise(one) + 0.4 * own_noise(other)});
    }
  }
  return result;
}

inline std::string csv(const std::vector<Reading>& readings) {
  std::string out =
      "t[s],tx,rx,tx_x[m],tx_y[m],tx_z[m],tx_yaw[rad],rx_x[m],rx_y[m],rx_z[m],rx_yaw[rad],power[dBm],noise[dBm],walls_"
      "wood\n";
  for (const Reading& r : readings) {
    out += print_real(r.t) + ',' + r.tx + ',' + r.rx;
    for (const double x :
         {r.from.x, r.from.y, r.from.z, r.from.yaw, r.to.x, r.to.y, r.to.z, r.to.yaw, r.power, r.noise})
      out += ',' + print_real(x);
    out += ',' + print_real(std::floor(std::fmod(r.t, 4))) + '\n';
  }
  return out;
}

const std::string plan =
    "<material name=\"brick\" loss=\"7.5\"/><material name=\"wood\" loss=\"2.25\"/>\n"
    "<wall name=\"w\" from=\"5 -5\" to=\"5 12\" height=\"3\" material=\"brick\"/>\n"
    "<wall name=\"v\" from=\"-3 4.5\" to=\"16 5.5\" height=\"3\" material=\"wood\"/>\n"
    "<door name=\"shut\" wall=\"w\" at=\"6\" width=\"2\" material=\"wood\" state=\"closed\"/>\n"
    "<door name=\"ajar\" wall=\"v\" at=\"2\" width=\"3\" state=\"open\"/>\n";
const std::string channel =
    "<radio.multiwall/><radio.fading rician_k=\"3\" per_reading=\"true\"/><radio.receiver sensitivity=\"-250\"/>\n";

// A world whose radio phase has been evaluated: draws, or expectations.
struct Evaluated : Simulation {
  Evaluated(const std::filesystem::path& file, const Options& options, bool expected)
      : Simulation(read_world(file, standard()), standard(), options) {
    evaluate(MUSTER_RADIO, expected);
  }
};

// A folder with the readings as measured.csv, removed at the end, and worlds in it.
class Site {
 public:
  explicit Site(std::vector<Reading> readings_ = survey()) : readings(std::move(readings_)) {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    std::string name = std::string("muster_effects_") + test->test_suite_name() + '.' + test->name();
    std::replace(name.begin(), name.end(), '/', '_');
    folder_ = std::filesystem::path(testing::TempDir()) / name;
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
    put("measured.csv", csv(readings));
  }
  ~Site() { std::filesystem::remove_all(folder_); }
  Site(const Site&) = delete;
  Site& operator=(const Site&) = delete;

  Evaluated world(const std::string& elements, bool expected = false, int workers = 1,
                  const std::string& around = plan + channel,
                  const std::string& links = "<data.links file=\"measured.csv\"/>\n") const {
    put("world.xml",
        "<world name=\"site\" dt=\"0.1\" until=\"10\" seed=\"7\">\n"
        "<station name=\"a\" at=\"0 0 1\" yaw=\"0.5\"/><station name=\"b\" at=\"14 9 4\" yaw=\"-2\"/>\n"
        "<station name=\"r\" at=\"1 1 0.3\"/><station name=\"s\" at=\"2 2 0.3\"/>\n" +
            links + around + elements + "\n</world>\n");
    Options options;
    options.search_path = {MUSTER_PLUGINS_DIR};
    options.workers = workers;
    return Evaluated(folder_ / "world.xml", options, expected);
  }

  void put(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }

  std::vector<Reading> readings;

 private:
  std::filesystem::path folder_;
};

inline std::string effect(const std::string& name, const std::string& attributes) {
  return "<effect." + name + " name=\"it\" " + attributes + "/>";
}

// The first column of a table.
inline std::vector<double> column(const Simulation& world, const std::string& table) {
  const TableView values = world.table(table);
  std::vector<double> result;
  for (std::size_t i = 0; i < values.rows(); ++i) result.push_back(values.at(i, 0));
  return result;
}

// Null included.
inline bool same_bits(double a, double b) { return std::bit_cast<uint64_t>(a) == std::bit_cast<uint64_t>(b); }
inline bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](double x, double y) { return same_bits(x, y); });
}

// Checks that a term adds this function of a reading, and not a constant, drawn or expected.
inline void expect_term(const std::string& name, const std::string& attributes,
                        const std::function<double(const Reading&)>& closed_form, double tolerance = 1e-9) {
  const Site site;
  for (const bool expected : {false, true}) {
    const auto part = column(site.world(effect(name, attributes), expected), "link/*/level@it");
    ASSERT_EQ(part.size(), site.readings.size());
    for (std::size_t i = 0; i < part.size(); ++i) {
      const Reading& r = site.readings[i];
      EXPECT_NEAR(part[i], closed_form(r), tolerance) << r.tx << " -> " << r.rx << " at " << r.t;
    }
    EXPECT_GT(*std::max_element(part.begin(), part.end()) - *std::min_element(part.begin(), part.end()), 0.1);
  }
}

}  // namespace muster
