// Logs of a robot among stations, with a fault of the map or of the log, by formulas that muster does not share: levels
// fall with the logarithm of distance; each station has a field of cosines of its own; each reading fades.
#pragma once

#include <array>
#include <cmath>
#include <complex>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

#include "tests/diagnosis/scratch.hpp"
#include "text/number.hpp"

namespace muster::diagnosis {

enum class Fault { none = 1, swapped, shifted, mirrored, turned, names_late, places_late, misplaced, moved };

inline const char* word_of(Fault fault) {
  static const char* words[] = {"",       "none",       "swapped",     "shifted",   "mirrored",
                                "turned", "names late", "places late", "misplaced", "moved"};
  return words[static_cast<int>(fault)];
}

struct DamagedLog {
  std::filesystem::path world, table;
  std::string truth;  // how a diagnosis should put it: id and label
};

class DamagedLogMaker {
 public:
  explicit DamagedLogMaker(Fault fault, unsigned seed, int rows = 900)
      : random_(seed * 7919u + static_cast<unsigned>(fault)), seed_(seed), fault_(fault) {
    draw_site();
    draw_log(rows);
    damage();
  }

  // That station sends less than the world says, besides.
  void weaken(std::size_t station, double decibels) {
    for (Row& r : log_)
      if (r.station == station) r.rssi -= decibels;
  }

  DamagedLog write(const Scratch& scratch) const {
    std::ofstream world(scratch / "world.xml");
    world << "<world name=\"yard\" dt=\"0.1\" until=\"1\" seed=\"4\">\n";
    for (std::size_t s = 0; s < listed_.size(); ++s)
      world << "<station name=\"" << name(s) << "\" at=\"" << listed_[s].x << ' ' << listed_[s].y << ' ' << listed_[s].z
            << "\"/>\n";
    world << "<station name=\"rover\" at=\"1 1 0.4\"/>\n<radio.multiwall tx_power=\"1\" l0=\"35\" n=\"2\"/>\n"
          << "<radio.fading shadowing=\"3\" decorrelation=\"2\" rician_k=\"6\" per_reading=\"true\"/>\n"
          << "<radio.receiver sensitivity=\"-200\"/></world>\n";
    std::ofstream table(scratch / "measured.csv");
    table << "t[s],tx,rx,tx_x[m],tx_y[m],tx_z[m],rx_x[m],rx_y[m],rx_z[m],rssi[dBm]\n";
    for (const Row& r : log_) {
      const Place& s = listed_[r.station];
      table << print_real(r.t) << ',' << name(r.station) << ",rover," << s.x << ',' << s.y << ',' << s.z << ','
            << print_real(r.at.x) << ',' << print_real(r.at.y) << ",0.4," << r.rssi << '\n';
    }
    return {scratch / "world.xml", scratch / "measured.csv", truth_};
  }

 private:
  struct Place {
    double x = 0, y = 0, z = 0;
  };
  struct Row {
    double t;
    std::size_t station;
    Place at;
    double rssi;
  };
  struct Wave {
    double kx, ky, phase;
  };

  static std::string name(std::size_t station) { return "s" + std::to_string(station + 1); }
  double between(double low, double high) { return std::uniform_real_distribution<>(low, high)(random_); }
  int one_of(int count) { return std::uniform_int_distribution<>(0, count - 1)(random_); }
  double normal() { return std::normal_distribution<>()(random_); }
  static double centimetre(double v) { return std::round(100 * v) / 100; }

  void draw_site() {
    width_ = centimetre(between(14, 30));
    depth_ = centimetre(between(10, 20));
    const int count = 4 + one_of(5);
    while (static_cast<int>(stations_.size()) < count) {
      const Place p{centimetre(between(0, width_)), centimetre(between(0, depth_)), centimetre(between(1, 2.5))};
      bool clear = true;
      for (const Place& other : stations_) clear &= std::hypot(p.x - other.x, p.y - other.y) > 3;
      if (clear) stations_.push_back(p);
    }
    constexpr double decorrelation = 2;
    fields_.resize(stations_.size());
    for (auto& field : fields_) {
      for (int k = 0; k < 150; ++k) {
        // The spectrum of an exponential correlation in the plane.
        const double u = between(0.001, 0.999), wave = std::sqrt(1 / (u * u) - 1) / decorrelation;
        const double turn = between(0, 2 * M_PI);
        field.push_back({wave * std::cos(turn), wave * std::sin(turn), between(0, 2 * M_PI)});
      }
    }
    exponent_ = between(1.8, 3);
    loss_ = between(32, 40);
  }

  double level(std::size_t station, const Place& at) {
    const Place& s = stations_[station];
    const double way = std::sqrt(std::pow(s.x - at.x, 2) + std::pow(s.y - at.y, 2) + std::pow(s.z - 0.4, 2));
    double field = 0;
    for (const Wave& w : fields_[station]) field += std::cos(w.kx * at.x + w.ky * at.y + w.phase);
    field *= shadowing_ * std::sqrt(2.0 / static_cast<double>(fields_[station].size()));
    const double scatter = 1 / std::sqrt(2 * (steady_ + 1));
    const std::complex<double> wave(std::sqrt(steady_ / (steady_ + 1)) + scatter * normal(), scatter * normal());
    return 1 - loss_ - 10 * exponent_ * std::log10(way) + field + 20 * std::log10(std::abs(wave));
  }

  // From point to point at half a metre a second; a reading of any station every 1.5 s or so.
  void draw_log(int rows) {
    Place at{between(1, width_ - 1), between(1, depth_ - 1), 0.4}, goal = at;
    double t = 0;
    for (int row = 0; row < rows; ++row) {
      double way = between(0.5, 1);
      t = centimetre(t + 2 * way);
      while (true) {
        const double left = std::hypot(goal.x - at.x, goal.y - at.y);
        if (left > way) {
          at.x += (goal.x - at.x) * way / left;
          at.y += (goal.y - at.y) * way / left;
          break;
        }
        at = goal;
        way -= left;
        goal = {between(0.5, width_ - 0.5), between(0.5, depth_ - 0.5), 0.4};
      }
      const auto station = static_cast<std::size_t>(one_of(static_cast<int>(stations_.size())));
      const Place seen{centimetre(at.x), centimetre(at.y), 0.4};
      log_.push_back({t, station, seen, std::round(level(station, seen))});
    }
  }

  void turn(const std::string& how, const std::array<double, 4>& by) {
    for (Place& p : listed_) {
      const double east = p.x - width_ / 2, north = p.y - depth_ / 2;
      p.x = centimetre(width_ / 2 + by[0] * east + by[1] * north);
      p.y = centimetre(depth_ / 2 + by[2] * east + by[3] * north);
    }
    truth_ = "effect.plan_turned how " + how + " of stations";
  }

  void damage() {
    listed_ = stations_;
    const int count = static_cast<int>(stations_.size());
    const int late = std::array{1, 2, -1}[static_cast<std::size_t>(one_of(3))];
    switch (fault_) {
      case Fault::none:
        truth_ = "silent";
        break;
      case Fault::swapped: {
        const int one = one_of(count - 1), other = one + 1 + one_of(count - 1 - one);
        std::swap(listed_[static_cast<std::size_t>(one)], listed_[static_cast<std::size_t>(other)]);
        truth_ = "effect.label_swap radio/" + name(static_cast<std::size_t>(one)) + " radio/" +
                 name(static_cast<std::size_t>(other));
        break;
      }
      case Fault::shifted: {
        // The station s is listed where s - by is, so that the first is truly where first + by is listed.
        const auto by = 1 + static_cast<std::size_t>(one_of(count - 1)), all = stations_.size();
        for (std::size_t s = 0; s < all; ++s) listed_[(s + by) % all] = stations_[s];
        truth_ = "effect.labels_shifted radio/" + name(by) + " order world";
        break;
      }
      case Fault::mirrored:
        seed_ % 2 ? turn("mirrored_x", {-1, 0, 0, 1}) : turn("mirrored_y", {1, 0, 0, -1});
        break;
      case Fault::turned: {
        const int quarters = one_of(3);
        quarters == 0   ? turn("turned_90", {0, -1, 1, 0})
        : quarters == 1 ? turn("turned_180", {-1, 0, 0, -1})
                        : turn("turned_270", {0, 1, -1, 0});
        break;
      }
      case Fault::names_late:
      case Fault::places_late: {
        const std::vector<Row> sound = log_;
        for (std::size_t k = 0; k < log_.size(); ++k) {
          const auto from = static_cast<std::ptrdiff_t>(k) - late;
          if (from < 0 || from >= static_cast<std::ptrdiff_t>(log_.size())) continue;
          const Row& other = sound[static_cast<std::size_t>(from)];
          fault_ == Fault::names_late ? void(log_[k].station = other.station) : void(log_[k].at = other.at);
        }
        truth_ = "effect.column_shifted by " + std::to_string(late) + " column " +
                 (fault_ == Fault::names_late ? "names" : "places");
        break;
      }
      case Fault::misplaced: {
        const auto which = static_cast<std::size_t>(one_of(count));
        const double way = between(2.5, 6), turn = between(0, 2 * M_PI);
        listed_[which].x = centimetre(listed_[which].x + way * std::cos(turn));
        listed_[which].y = centimetre(listed_[which].y + way * std::sin(turn));
        truth_ = "effect.tx_misplaced radio/" + name(which);
        break;
      }
      case Fault::moved: {
        const double way = between(2, 6), turn = between(0, 2 * M_PI);
        for (Place& p : listed_) {
          p.x = centimetre(p.x + way * std::cos(turn));
          p.y = centimetre(p.y + way * std::sin(turn));
        }
        truth_ = "effect.plan_shifted of stations";
        break;
      }
    }
  }

  // As the world states them, so that nothing but the fault is to be found.
  static constexpr double shadowing_ = 3;                // dB
  static constexpr double steady_ = 3.9810717055349727;  // power over that of the scatter: 6 dB

  std::mt19937 random_;
  unsigned seed_;
  Fault fault_;
  double width_ = 0, depth_ = 0, exponent_ = 0, loss_ = 0;
  std::vector<Place> stations_, listed_;  // where they are; where the map has them
  std::vector<std::vector<Wave>> fields_;
  std::vector<Row> log_;
  std::string truth_;
};

inline DamagedLog damaged_log(const Scratch& scratch, Fault fault, unsigned seed) {
  return DamagedLogMaker(fault, seed).write(scratch);
}

}  // namespace muster::diagnosis
