#include "exam/write.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "exam/files.hpp"
#include "exam/reading_law.hpp"

namespace muster::exam {
namespace {

using nlohmann::ordered_json;

const char* family_name(Family family) {
  switch (family) {
    case Family::exponential:
      return "exponential";
    case Family::gaussian:
      return "gaussian";
    case Family::two_scale:
      return "two_scale";
  }
  return "";
}

ordered_json effect_json(const Hidden& h) {
  ordered_json parameters = ordered_json::array();
  for (const Parameter& p : h.effect.parameters(h.strength))
    parameters.push_back({{"name", p.name}, {"value", p.value}, {"unit", p.unit}});
  constexpr const char* acts[] = {"", "mean", "receiver", "reading_law", "field_law"};
  return {{"id", h.effect.id},
          {"also", h.effect.also},
          {"in_vocabulary", h.in_vocabulary},
          {"acts", acts[static_cast<int>(h.effect.acts)]},
          {"rows", h.effect.rows},
          {"covariates", h.effect.covariates},
          {"parameters", parameters},
          {"lambda", h.lambda},
          {"wanted_lambda", h.wanted}};
}

ordered_json data_json(const Data& data) {
  const std::vector<char> use = heard(data);
  return {{"readings", data.size()}, {"heard", std::count(use.begin(), use.end(), 1)}};
}

}  // namespace

std::string walls_csv(const Plan& plan) {
  std::string out = "name,x0[m],y0[m],x1[m],y1[m],height[m],thickness[m],material\n";
  for (const Wall& w : plan.walls)
    fmt::format_to(std::back_inserter(out), "{},{:.3f},{:.3f},{:.3f},{:.3f},{},{},{}\n", w.name, w.a.x, w.a.y, w.b.x,
                   w.b.y, w.height, w.thickness, plan.materials[static_cast<std::size_t>(w.material)].name);
  return out;
}

std::string world_xml(const Case& made) {
  const Plan& plan = made.site->plan;
  std::string out = fmt::format("<world name=\"{}\" dt=\"0.1\" until=\"1\" seed=\"1\">\n", made.name);
  const auto line = [&](fmt::string_view format, const auto&... args) {
    out += "  ";
    fmt::vformat_to(std::back_inserter(out), format, fmt::make_format_args(args...));
    out += '\n';
  };
  for (const Material& m : plan.materials) line("<material name=\"{}\" loss=\"{:.1f}\"/>", m.name, m.stated);
  line("<walls file=\"walls.csv\"/>");
  for (const Door& d : plan.doors)
    line("<door name=\"{}\" wall=\"{}\" at=\"{:.3f}\" width=\"{:.3f}\" height=\"{:.3f}\" state=\"{}\"/>", d.name,
         plan.walls[static_cast<std::size_t>(d.wall)].name, d.at, d.width, d.height, d.open ? "open" : "closed");
  for (const Station& s : plan.stations)
    line("<station name=\"{}\" at=\"{:.3f} {:.3f} {:.3f}\" yaw=\"{:.3f}\"/>", s.name, s.at.x, s.at.y, s.at.z, s.yaw);
  for (int r = 0; r < made.site->robots; ++r) {
    const auto first = std::find_if(made.measured.readings.begin(), made.measured.readings.end(),
                                    [=](const Reading& v) { return v.robot == r; });
    line("<station name=\"{}\" at=\"{:.3f} {:.3f} {:.3f}\" yaw=\"{:.3f}\"/>", robot_name(r), first->at.x, first->at.y,
         first->at.z, first->yaw);
  }
  const Base& base = made.site->base;
  line("<radio.multiwall tx_power=\"{:.1f}\" l0=\"{:.1f}\" n=\"{:.2f}\"/>", base.tx_power, base.stated_l0,
       base.stated_n);
  line("<radio.fading shadowing=\"{:.2f}\" decorrelation=\"{:.2f}\" rician_k=\"{:.2f}\" per_reading=\"true\"/>",
       made.site->stated_field.sigma, made.site->stated_field.decorrelation,
       equivalent_rician_k(made.site->stated_reading));
  line("<radio.receiver sensitivity=\"-200\"/>");
  return out + "</world>\n";
}

std::string readings_csv(const GroundTruth& site, const Data& data, int decimals) {
  std::string out =
      "t[s],tx,rx,tx_x[m],tx_y[m],tx_z[m],tx_yaw[rad],rx_x[m],rx_y[m],rx_z[m],rx_yaw[rad],rssi[dBm],"
      "battery[V],temperature[degC],speed[m/s]";
  out += site.has_power ? ",power[dBm]" : "";
  out += site.has_noise ? ",noise[dBm]" : "";
  out += site.has_firmware ? ",firmware\n" : "\n";
  for (std::size_t i = 0; i < data.size(); ++i) {
    const Reading& r = data.readings[i];
    const Station& s = site.plan.stations[static_cast<std::size_t>(r.station)];
    const std::string robot = robot_name(r.robot);
    fmt::format_to(std::back_inserter(out), "{:.3f},{},{}", r.t, r.up ? robot : s.name, r.up ? s.name : robot);
    for (const bool robots_end : {r.up, !r.up}) {
      const Vec3 at = robots_end ? r.at : s.at;
      fmt::format_to(std::back_inserter(out), ",{:.3f},{:.3f},{:.3f},{:.3f}", at.x, at.y, at.z,
                     robots_end ? r.yaw : s.yaw);
    }
    const double rssi = data.rssi[static_cast<Eigen::Index>(i)];
    out += std::isnan(rssi) ? "," : fmt::format(",{:.{}f}", rssi, decimals);
    fmt::format_to(std::back_inserter(out), ",{:.3f},{:.3f},{:.3f}", r.battery, r.temperature, r.speed);
    if (site.has_power)
      fmt::format_to(std::back_inserter(out), ",{:.0f}", power_levels[static_cast<std::size_t>(r.power)]);
    if (site.has_noise) fmt::format_to(std::back_inserter(out), ",{:.2f}", -95 + site.noise_swing * r.noise);
    if (site.has_firmware)
      fmt::format_to(std::back_inserter(out), ",{}", firmware_names[static_cast<std::size_t>(r.firmware)]);
    out += '\n';
  }
  return out;
}

std::string answer_json(const Case& made) {
  const Noise& noise = made.site->noise;
  ordered_json effects = ordered_json::array(), losses;
  for (const Hidden& h : made.hidden) effects.push_back(effect_json(h));
  for (const Material& m : made.site->plan.materials) losses[m.name] = m.loss;
  const ordered_json answer{{"format", "muster_exam/1"},
                            {"case", made.name},
                            {"seed", made.seed},
                            {"kind", made.order.kind},
                            {"effects", effects},
                            {"oracle",
                             {{"heldout_mse_without_db2", made.oracle.without},
                              {"heldout_mse_with_db2", made.oracle.with},
                              {"gain_db2", made.oracle.without - made.oracle.with}}},
                            {"noise",
                             {{"family", family_name(noise.field.family)},
                              {"sigma_db", noise.field.sigma},
                              {"decorrelation_m", noise.field.decorrelation},
                              {"shared", noise.field.shared},
                              {"rician_k_db", noise.reading.rician_k},
                              {"averaged", noise.reading.averaged},
                              {"lost", noise.lost}}},
                            {"base",
                             {{"tx_power_dbm", made.site->base.tx_power},
                              {"l0_db", made.site->base.tx_power - made.site->base.level_at_1m},
                              {"n", made.site->base.n},
                              {"losses_db", losses}}},
                            {"measured", data_json(made.measured)},
                            {"second", data_json(made.second)},
                            {"plan_angle_rad", made.site->plan.angle},
                            {"walls", made.order.walls}};
  return answer.dump(1) + "\n";
}

void write_case(const Case& made, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder / made.name);
  std::filesystem::create_directories(folder / "answers");
  write_file(folder / made.name / "world.xml", world_xml(made));
  write_file(folder / made.name / "walls.csv", walls_csv(made.site->plan));
  write_file(folder / made.name / "measured.csv", readings_csv(*made.site, made.measured));
  write_file(folder / made.name / "second.csv", readings_csv(*made.site, made.second));
  write_file(folder / "answers" / (made.name + ".json"), answer_json(made));
}

}  // namespace muster::exam
