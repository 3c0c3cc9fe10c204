// Writes a case as an examinee gets it, and its answer.
#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>

#include "exam/field_survey/survey_case.hpp"
#include "exam/files.hpp"

namespace muster::exam::survey {
namespace {

using nlohmann::ordered_json;

const std::string& name_of(const Made& made, int radio) {
  return made.map.radios[static_cast<std::size_t>(radio)].name;
}

// Time as the one who measured wrote it.
std::string clock_cell(const Campaign& campaign, const Row& row, std::size_t number) {
  switch (campaign.clock) {
    case Clock::seconds:
      return fmt::format("{:.2f},", row.t);
    case Clock::row_number:
      return fmt::format("{},", number);
    case Clock::nanoseconds:
      return fmt::format("{}{:09},", 1750000000 + static_cast<long long>(row.t),
                         static_cast<long long>((row.t - std::floor(row.t)) * 1e9));
    case Clock::none:
      return "";
  }
  return "";
}

const char* clock_name(Clock clock) {
  constexpr const char* names[] = {"", "seconds", "none", "row number", "nanoseconds since 1970"};
  return names[static_cast<int>(clock)];
}

std::string kind_of(const Made& made) {
  if (made.planted.size() == 1 && !made.planted[0].in_vocabulary) return "outside";
  constexpr const char* words[] = {"clean", "one", "two", "three", "four"};
  return words[made.planted.size()];
}

}  // namespace

std::string world_xml(const Made& made) {
  const Scene& map = made.map;
  std::string out = fmt::format("<world name=\"{}\" dt=\"0.1\" until=\"1\">\n", made.name);
  const auto line = [&](fmt::string_view format, const auto&... args) {
    out += "  ";
    fmt::vformat_to(std::back_inserter(out), format, fmt::make_format_args(args...));
    out += '\n';
  };
  std::vector<std::string> materials;
  for (const Panel& panel : map.panels) {
    if (std::find(materials.begin(), materials.end(), panel.material) != materials.end()) continue;
    materials.push_back(panel.material);
    line("<material name=\"{}\" loss=\"{:.1f}\"/>", panel.material, panel.loss);
  }
  for (const Panel& panel : map.panels)
    line("<wall name=\"{}\" from=\"{:.3f} {:.3f}\" to=\"{:.3f} {:.3f}\" height=\"{:.1f}\" material=\"{}\"/>",
         panel.name, panel.from.x, panel.from.y, panel.to.x, panel.to.y, panel.height, panel.material);
  for (std::size_t i = 0; i < map.radios.size(); ++i) {
    const Radio& radio = map.radios[i];
    if (!made.campaign.in_world.empty() && !made.campaign.in_world[i]) continue;
    const Point at = radio.moves ? made.campaign.rows.front().mobile : radio.at;
    line("<station name=\"{}\" at=\"{:.3f} {:.3f} {:.3f}\" yaw=\"{:.3f}\"/>", radio.name, at.x, at.y, at.z, radio.yaw);
  }
  line("<radio.multiwall tx_power=\"{:.0f}\" l0=\"{:.0f}\" n=\"2\"/>", map.power, map.l0);
  const Scatter& scatter = map.scatter;
  const std::string frequency =
      made.campaign.states_frequency ? fmt::format(" frequency=\"{:.0f}\"", map.frequency) : "";
  if (made.campaign.states_scatter && scatter.shadowing == 0 && scatter.frozen == 0)
    line("<radio.fading shadowing=\"0\" fading=\"false\"{}/>", frequency);
  else if (made.campaign.states_scatter)
    // A steady Rician fade scatters by 8.7 dB / sqrt(2 K).
    line("<radio.fading shadowing=\"{:.0f}\" decorrelation=\"{:.0f}\" rician_k=\"{:.1f}\" per_reading=\"true\"{}/>",
         std::max(std::hypot(scatter.shadowing, scatter.frozen), 1.0), std::max(scatter.decorrelation, 1.0),
         20 * std::log10(8.686 / (std::sqrt(2.0) * scatter.reading)), frequency);
  line("<radio.receiver sensitivity=\"-200\"/>");
  return out + "</world>\n";
}

std::string measured_csv(const Made& made) {
  const Campaign& campaign = made.campaign;
  std::string out = campaign.clock == Clock::none ? "tx,rx" : "t[s],tx,rx";
  for (const char* end : {"tx", "rx"}) {
    out += fmt::format(",{0}_x[m],{0}_y[m]", end);
    if (campaign.heights) out += fmt::format(",{}_z[m]", end);
    if (campaign.headings) out += fmt::format(",{}_yaw[rad]", end);
  }
  out += campaign.powers.empty() ? ",rssi[dBm]\n" : ",rssi[dBm],power[dBm]\n";
  for (std::size_t i = 0; i < campaign.rows.size(); ++i) {
    const Row& row = campaign.rows[i];
    if (std::isnan(made.rssi[i]) && made.drops_missed) continue;
    const Path path = path_of(made.map, row);
    out += clock_cell(campaign, row, i);
    fmt::format_to(std::back_inserter(out), "{},{}", name_of(made, row.tx), name_of(made, row.rx));
    for (const bool sends : {true, false}) {
      const Point at = sends ? path.tx : path.rx;
      fmt::format_to(std::back_inserter(out), ",{:.3f},{:.3f}", at.x, at.y);
      if (campaign.heights) fmt::format_to(std::back_inserter(out), ",{:.3f}", at.z);
      if (campaign.headings) fmt::format_to(std::back_inserter(out), ",{:.3f}", sends ? path.tx_yaw : path.rx_yaw);
    }
    out += std::isnan(made.rssi[i]) ? "," : fmt::format(",{:.2f}", made.rssi[i]);
    if (!campaign.powers.empty())
      fmt::format_to(std::back_inserter(out), ",{:.0f}", campaign.powers[static_cast<std::size_t>(row.power)]);
    out += '\n';
  }
  return out;
}

std::string answer_json(const Made& made) {
  ordered_json effects = ordered_json::array();
  for (const Planted& p : made.planted) {
    ordered_json values = ordered_json::array();
    // Without a clock in seconds a time or a rate has no value that a report could give.
    const bool timeless = made.campaign.clock != Clock::seconds;
    for (const Value& v : p.values)
      if (!timeless || (v.unit != "s" && v.unit != "dB/h" && v.name != "phase"))
        values.push_back({{"name", v.name}, {"value", v.value}, {"unit", v.unit}});
    effects.push_back({{"id", p.id},
                       {"also", p.also},
                       {"class", p.kin},
                       {"in_vocabulary", p.in_vocabulary},
                       {"acts", p.acts},
                       {"rows", p.rows},
                       {"covariates", p.covariates},
                       {"parameters", values},
                       {"lambda", p.lambda}});
  }
  const Scatter& scatter = made.truth.scatter;
  const auto heard = std::count_if(made.rssi.begin(), made.rssi.end(), [](double v) { return !std::isnan(v); });
  return ordered_json{{"format", "muster_exam/1"},
                      {"generator", "field"},
                      {"case", made.name},
                      {"seed", made.request.seed},
                      {"kind", kind_of(made)},
                      {"style", made.campaign.style},
                      {"effects", effects},
                      {"noise",
                       {{"shadowing_db", scatter.shadowing},
                        {"decorrelation_m", scatter.decorrelation},
                        {"place_and_link_db", scatter.frozen},
                        {"reading_db", scatter.reading},
                        {"student_freedom", scatter.freedom},
                        {"step_db", scatter.step}}},
                      {"base",
                       {{"tx_power_dbm", made.truth.power},
                        {"l0_db", made.truth.l0},
                        {"n", made.truth.n},
                        {"frequency_hz", made.truth.frequency}}},
                      {"clock", clock_name(made.campaign.clock)},
                      {"measured", {{"readings", made.rssi.size()}, {"heard", heard}}}}
             .dump(1) +
         "\n";
}

void write(const Made& made, const std::filesystem::path& folder) {
  std::filesystem::create_directories(folder / made.name);
  std::filesystem::create_directories(folder / "answers");
  write_file(folder / made.name / "world.xml", world_xml(made));
  write_file(folder / made.name / "measured.csv", measured_csv(made));
  write_file(folder / "answers" / (made.name + ".json"), answer_json(made));
}

}  // namespace muster::exam::survey
