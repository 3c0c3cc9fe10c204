#include "follow.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>
#include <stdexcept>

#include "files.hpp"
#include "write.hpp"

namespace muster::exam {
namespace {

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> result;
  std::istringstream cells(line);
  for (std::string cell; std::getline(cells, cell, ',');) result.push_back(cell);
  return result;
}

// The cells of one line by the names of their columns.
class Line {
 public:
  Line(const std::vector<std::string>& names, const std::string& text, int number) : number_(number) {
    const std::vector<std::string> cells = cells_of(text);
    if (cells.size() != names.size())
      throw std::runtime_error(fmt::format("plan, line {}: {} cells, expected {}", number, cells.size(), names.size()));
    for (std::size_t k = 0; k < cells.size(); ++k) cells_[names[k]] = cells[k];
  }

  const std::string& text(const std::string& name) const {
    const auto at = cells_.find(name);
    if (at == cells_.end()) throw std::runtime_error(fmt::format("plan, line {}: no column {}", number_, name));
    return at->second;
  }
  double number(const std::string& name) const {
    const std::string& cell = text(name);
    double value = 0;
    const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
    if (error != std::errc{} || end != cell.data() + cell.size() || !std::isfinite(value))
      throw std::runtime_error(fmt::format("plan, line {}: {} is no number: \"{}\"", number_, name, cell));
    return value;
  }
  Vec3 place(const std::string& end) const {
    return {number(end + "_x[m]"), number(end + "_y[m]"), number(end + "_z[m]")};
  }

 private:
  std::map<std::string, std::string> cells_;
  int number_;
};

int station_called(const Site& site, const std::string& name) {
  for (std::size_t k = 0; k < site.plan.stations.size(); ++k)
    if (site.plan.stations[k].name == name) return static_cast<int>(k);
  return -1;
}

int robot_called(const Site& site, const std::string& name) {
  for (int k = 0; k < site.robots; ++k)
    if (robot_name(k) == name) return k;
  return -1;
}

// Surroundings as another run has them at that moment, a run after another.
Reading surroundings(const Site& site, const Data& run, double t, int robot) {
  const std::size_t per_robot = site.plan.stations.size() * (site.two_way ? 2 : 1);
  const double tick = std::fmod(t, site.duration()) / site.period;
  const auto i = static_cast<std::size_t>(std::clamp(tick, 0.0, site.ticks - 1.0));
  return run.readings[(i * static_cast<std::size_t>(site.robots) + static_cast<std::size_t>(robot)) * per_robot];
}

Reading reading_of(const Site& site, const Data& run, const Asked& a) {
  const bool up = station_called(site, a.tx) < 0;
  const std::string &station = up ? a.rx : a.tx, &robot = up ? a.tx : a.rx;
  if (station_called(site, station) < 0 || robot_called(site, robot) < 0)
    throw std::runtime_error(fmt::format("plan: {} and {} are not a station and a robot of the case", a.tx, a.rx));
  Reading r = surroundings(site, run, a.t, robot_called(site, robot));
  r.t = a.t;
  r.station = station_called(site, station);
  r.robot = robot_called(site, robot);
  r.up = up;
  r.at = up ? a.tx_at : a.rx_at;
  r.yaw = up ? a.tx_yaw : a.rx_yaw;
  return r;
}

// Lets stations stand and face where the plan has them; whether one was moved.
bool move_stations(Case& made, const std::vector<Asked>& asked) {
  std::map<int, Vec3> moved;
  for (const Asked& a : asked) {
    const bool up = station_called(*made.site, a.tx) < 0;
    const int station = station_called(*made.site, up ? a.rx : a.tx);
    if (station < 0) continue;
    Station& s = made.site->plan.stations[static_cast<std::size_t>(station)];
    s.yaw = up ? a.rx_yaw : a.tx_yaw;
    const Vec3 to = up ? a.rx_at : a.tx_at;
    if (distance_of(to, s.at) < 0.02) continue;
    if (distance_of(to, moved.try_emplace(station, to).first->second) > 0.02)
      throw std::runtime_error("plan: " + (up ? a.rx : a.tx) + " is moved to more than one place");
  }
  for (const auto& [station, to] : moved) {
    made.site->plan.stations[static_cast<std::size_t>(station)].at = to;
    const std::string row = radio_row(*made.site, station);
    std::erase_if(made.hidden, [&](const Hidden& h) {  // whoever moves a station knows where it stands
      return h.effect.id == "tx_misplaced" && h.effect.rows[0] == row;
    });
  }
  return !moved.empty();
}

}  // namespace

std::vector<Asked> read_plan(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  const std::vector<std::string> names = cells_of(line);
  std::vector<Asked> result;
  for (int number = 2; std::getline(lines, line); ++number) {
    const Line cells(names, line, number);
    result.push_back({cells.number("t[s]"), cells.text("tx"), cells.text("rx"), cells.place("tx"), cells.place("rx"),
                      cells.number("tx_yaw[rad]"), cells.number("rx_yaw[rad]")});
  }
  if (result.empty()) throw std::runtime_error("plan: no readings are asked for");
  std::stable_sort(result.begin(), result.end(), [](const Asked& a, const Asked& b) { return a.t < b.t; });
  return result;
}

Case read_case(const std::filesystem::path& answer) {
  const std::string text = read_file(answer);
  try {
    const auto from = nlohmann::json::parse(text);
    Order order{from.at("kind"), {}, {}, from.at("measured").at("readings")};
    for (const auto& e : from.at("effects")) {
      order.effects.push_back(e.at("id"));
      order.lambdas.push_back(e.at("wanted_lambda"));
    }
    return remake_case(from.at("case"), from.at("seed"), order);
  } catch (const nlohmann::json::exception& e) {
    throw std::runtime_error(answer.string() + ": not an answer of the exam: " + e.what());
  }
}

std::string followed_csv(Case made, const std::vector<Asked>& asked) {
  std::string out = readings_csv(*made.site, made.measured);
  const Data run = draw_data(*made.site, made.seed, "asked");
  const bool moved = move_stations(made, asked);
  Data data;
  for (const Asked& a : asked) data.readings.push_back(reading_of(*made.site, run, a));
  for (const Reading& r : data.readings)
    data.crossings.push_back(crossings(made.site->plan, place_of(*made.site, r), r.at));
  data.design = design_of(*made.site, data);
  hear(made, Field(*made.site, moved ? Random(made.seed, "moved").bits() : made.seed), data, "asked");
  const std::string more = readings_csv(*made.site, data);
  return out + more.substr(more.find('\n') + 1);
}

}  // namespace muster::exam
