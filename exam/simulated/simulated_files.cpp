// Writes a case of the generator `run`.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <sstream>

#include "exam/case.hpp"
#include "exam/files.hpp"
#include "exam/simulated/simulated_case.hpp"
#include "exam/write.hpp"

namespace muster::exam::simulated {
namespace {

using nlohmann::ordered_json;

const char* fading_name(Channel::Fading fading) {
  constexpr const char* names[] = {"", "none", "multipath", "per_reading"};
  return names[static_cast<int>(fading)];
}

}  // namespace

std::string world_elements(const Made& made) {
  const Plan& plan = made.site.plan;
  std::string out;
  const auto line = [&](fmt::string_view format, const auto&... args) {
    out += "  ";
    fmt::vformat_to(std::back_inserter(out), format, fmt::make_format_args(args...));
    out += '\n';
  };
  for (const Material& m : plan.materials) line("<material name=\"{}\" loss=\"{:.1f}\"/>", m.name, m.loss);
  if (!made.counts_walls) {
    line("<walls file=\"walls.csv\"/>");
    for (const Door& d : plan.doors)
      line("<door name=\"{}\" wall=\"{}\" at=\"{:.3f}\" width=\"{:.3f}\" height=\"{:.3f}\" state=\"{}\"/>", d.name,
           plan.walls[static_cast<std::size_t>(d.wall)].name, d.at, d.width, d.height, d.open ? "open" : "closed");
  }
  for (const Station& s : plan.stations)
    line("<station name=\"{}\" at=\"{:.3f} {:.3f} {:.3f}\" yaw=\"{:.3f}\"/>", s.name, s.at.x, s.at.y, s.at.z, s.yaw);
  for (int r = 0; r < made.site.robots; ++r) {
    const auto first = std::find_if(made.measured.readings.begin(), made.measured.readings.end(),
                                    [=](const Reading& v) { return v.robot == r; });
    line("<station name=\"{}\" at=\"{:.3f} {:.3f} {:.3f}\" yaw=\"{:.3f}\"/>", robot_name(r), first->at.x, first->at.y,
         first->at.z, first->yaw);
  }
  line("<radio.multiwall tx_power=\"{:.1f}\" l0=\"{:.1f}\" n=\"{:.2f}\"/>", made.site.base.tx_power,
       made.site.base.stated_l0, made.site.base.stated_n);
  const Channel& c = made.channel;
  line("<radio.fading shadowing=\"{:.2f}\" decorrelation=\"{:.2f}\" {}/>", c.shadowing, c.decorrelation,
       c.fading == Channel::Fading::none
           ? "fading=\"false\""
           : fmt::format("rician_k=\"{:.1f}\"{}", c.rician_k,
                         c.fading == Channel::Fading::per_reading ? " per_reading=\"true\"" : ""));
  line("<radio.receiver sensitivity=\"-170\"/>");
  return out;
}

// The seed of the draws is not in it: an examinee who runs it sees another environment.
std::string world_xml(const Made& made) {
  return fmt::format("<world name=\"{}\" dt=\"0.1\" until=\"1\">\n{}</world>\n", made.name, world_elements(made));
}

std::string table(const Made& made, const Data& data) {
  std::string csv = readings_csv(made.site, data, made.channel.decimals);
  if (!made.counts_walls) return csv;
  std::istringstream lines(csv);
  std::string out, line;
  std::getline(lines, line);
  out = line;
  for (const Material& m : made.site.plan.materials) out += ",walls_" + m.name;
  out += '\n';
  for (Eigen::Index i = 0; std::getline(lines, line); ++i) {
    out += line;
    for (Eigen::Index m = 2; m < data.design.cols(); ++m) out += fmt::format(",{:.0f}", -data.design(i, m));
    out += '\n';
  }
  return out;
}

std::string answer_json(const Made& made) {
  constexpr const char* acts[] = {"", "mean", "receiver", "reading_law", "field_law", "blockage"};
  ordered_json effects = ordered_json::array(), losses;
  for (const PlantedCause& c : made.causes) {
    ordered_json values = ordered_json::array();
    for (const Attribute& a : c.numbers) values.push_back({{"name", a.name}, {"value", a.value}, {"unit", a.unit}});
    effects.push_back({{"id", c.id},
                       {"also", c.also},
                       {"class", c.kin},
                       {"in_vocabulary", true},
                       {"acts", acts[static_cast<int>(c.acts)]},
                       {"rows", c.rows},
                       {"covariates", ordered_json::array()},
                       {"parameters", values},
                       {"lambda", c.lambda},
                       {"wanted_lambda", c.wanted}});
  }
  for (const Material& m : made.site.plan.materials) losses[m.name] = m.loss;
  const std::vector<char> use = heard(made.measured);
  return ordered_json{
             {"format", "muster_exam/1"},
             {"generator", "run"},
             {"case", made.name},
             {"seed", made.seed},
             {"kind", made.kind},
             {"effects", effects},
             {"noise",
              {{"shadowing_db", made.channel.shadowing},
               {"decorrelation_m", made.channel.decorrelation},
               {"fading", fading_name(made.channel.fading)},
               {"rician_k_db", made.channel.rician_k},
               {"step_db", made.channel.step()}}},
             {"both_ways", made.site.two_way},
             {"base",
              {{"tx_power_dbm", made.site.base.tx_power},
               {"l0_db", made.site.base.stated_l0},
               {"n", made.site.base.stated_n},
               {"losses_db", losses}}},
             {"measured", {{"readings", made.measured.size()}, {"heard", std::count(use.begin(), use.end(), 1)}}}}
             .dump(1) +
         "\n";
}

void write(const Made& made, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder / made.name);
  std::filesystem::create_directories(folder / "answers");
  write_file(folder / made.name / "world.xml", world_xml(made));
  write_file(folder / made.name / "walls.csv", walls_csv(made.site.plan));
  write_file(folder / made.name / "measured.csv", table(made, made.measured));
  write_file(folder / made.name / "second.csv", table(made, made.second));
  write_file(folder / "answers" / (made.name + ".json"), answer_json(made));
}

}  // namespace muster::exam::simulated
