#include "exam/follow_up.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "exam/files.hpp"
#include "exam/write.hpp"

namespace muster::exam {
namespace {

int station_called(const GroundTruth& site, const std::string& name) {
  for (std::size_t k = 0; k < site.plan.stations.size(); ++k)
    if (site.plan.stations[k].name == name) return static_cast<int>(k);
  return -1;
}

int robot_called(const GroundTruth& site, const std::string& name) {
  for (int k = 0; k < site.robots; ++k)
    if (robot_name(k) == name) return k;
  return -1;
}

// Surroundings of another run at that time; runs follow each other.
Reading surroundings(const GroundTruth& site, const Data& run, double t, int robot) {
  const std::size_t per_robot = site.plan.stations.size() * (site.two_way ? 2 : 1);
  const double tick = std::fmod(t, site.duration()) / site.period;
  const auto i = static_cast<std::size_t>(std::clamp(tick, 0.0, site.ticks - 1.0));
  return run.readings[(i * static_cast<std::size_t>(site.robots) + static_cast<std::size_t>(robot)) * per_robot];
}

// A planned reading, by station and robot.
struct Ends {
  int station, robot;
  bool up;  // the robot sends
  Vec3 station_at, robot_at;
  double station_yaw, robot_yaw;
};

Ends ends_of(const GroundTruth& site, const PlannedReadings& a) {
  const int sends = station_called(site, a.tx), hears = station_called(site, a.rx);
  const bool up = sends < 0;
  const Ends down{sends, robot_called(site, a.rx), false, a.tx_at, a.rx_at, a.tx_yaw, a.rx_yaw};
  const Ends ends = up ? Ends{hears, robot_called(site, a.tx), true, a.rx_at, a.tx_at, a.rx_yaw, a.tx_yaw} : down;
  if (ends.station < 0 || ends.robot < 0)
    throw std::runtime_error(fmt::format("plan: {} and {} are not a station and a robot of the case", a.tx, a.rx));
  return ends;
}

Reading reading_of(const GroundTruth& site, const Data& run, const Ends& ends, double t) {
  Reading r = surroundings(site, run, t, ends.robot);
  r.t = t;
  r.station = ends.station;
  r.robot = ends.robot;
  r.up = ends.up;
  r.at = ends.robot_at;
  r.yaw = ends.robot_yaw;
  return r;
}

// Moves and turns stations as planned. True if one was moved.
bool move_stations(Case& made, const std::vector<Ends>& asked) {
  std::map<int, Vec3> moved;
  for (const Ends& e : asked) {
    Station& s = made.site->plan.stations[static_cast<std::size_t>(e.station)];
    s.yaw = e.station_yaw;
    const Vec3 to = e.station_at;
    if (distance_of(to, s.at) < 0.02) continue;
    if (distance_of(to, moved.try_emplace(e.station, to).first->second) > 0.02)
      throw std::runtime_error("plan: " + s.name + " is moved to more than one place");
  }
  for (const auto& [station, to] : moved) {
    made.site->plan.stations[static_cast<std::size_t>(station)].at = to;
    const std::string row = radio_row(*made.site, station);
    std::erase_if(made.hidden, [&](const Hidden& h) {  // a moved station has a known place
      return h.effect.id == "tx_misplaced" && h.effect.rows[0] == row;
    });
  }
  return !moved.empty();
}

}  // namespace

Case read_case(const std::filesystem::path& answer) {
  const std::string text = read_file(answer);
  try {
    const auto from = nlohmann::json::parse(text);
    if (from.contains("generator"))
      throw std::runtime_error(fmt::format("{}: a case of the generator {}; only those of drawn can be followed",
                                           answer.string(), from["generator"].get<std::string>()));
    Order order{from.at("kind"), {}, {}, from.at("measured").at("readings"), from.value("walls", "")};
    for (const auto& e : from.at("effects")) {
      order.effects.push_back(e.at("id"));
      order.lambdas.push_back(e.at("wanted_lambda"));
    }
    return remake_case(from.at("case"), from.at("seed"), order);
  } catch (const nlohmann::json::exception& e) {
    throw std::runtime_error(answer.string() + ": not an answer of the exam: " + e.what());
  }
}

std::string followed_csv(Case made, const std::vector<PlannedReadings>& asked) {
  std::string out = readings_csv(*made.site, made.measured);
  const Data run = draw_data(*made.site, made.seed, "asked");
  std::vector<Ends> ends;
  for (const PlannedReadings& a : asked) ends.push_back(ends_of(*made.site, a));
  const bool moved = move_stations(made, ends);
  std::vector<Reading> readings;
  readings.reserve(asked.size());
  for (std::size_t k = 0; k < asked.size(); ++k) readings.push_back(reading_of(*made.site, run, ends[k], asked[k].t));
  Data data = data_of(*made.site, std::move(readings));
  hear(made, Field(*made.site, moved ? Random(made.seed, "moved").bits() : made.seed), data, "asked");
  const std::string more = readings_csv(*made.site, data);
  return out + more.substr(more.find('\n') + 1);
}

}  // namespace muster::exam
