// muster features WORLD --data FILE: what each reading's link looks like on the plan.
#include <fmt/core.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "diagnosis/data/dataset.hpp"
#include "diagnosis/radio/links/link_features.hpp"
#include "text/text_table_writer.hpp"
#include "verbs.hpp"

namespace muster::cli {
namespace {

using namespace diagnosis;

void write_table(const std::string& file, const Dataset& data, const Features& f) {
  std::vector<TextColumn> columns;
  if (!data.t.empty()) columns.push_back({"t", "s"});
  for (const char* name : {"tx", "rx"}) columns.push_back({name, ""});
  columns.push_back({"distance", "m"});
  for (const char* name : {"azimuth", "elevation", "tx_bearing", "rx_bearing", "incidence"})
    columns.push_back({name, "rad"});
  for (const auto& material : f.materials) columns.push_back({"walls_" + material, ""});
  columns.push_back({"rssi", "dBm"});
  TextTableWriter out(file, columns);
  for (std::size_t row = 0; row < data.rows(); ++row) {
    if (!data.t.empty()) out.real(data.t[row]);
    out.text(data.tx.levels[data.tx.level[row]]);
    out.text(data.rx.levels[data.rx.level[row]]);
    for (const auto* column : {&f.distance, &f.azimuth, &f.elevation, &f.tx_bearing, &f.rx_bearing, &f.incidence})
      out.real((*column)[row]);
    for (const auto& counts : f.by_material) out.real(counts[row]);
    out.real(data.rssi[row]);
    out.end_row();
  }
  out.close();
}

nlohmann::ordered_json summary(const Dataset& data, const Features& f, const std::string& file) {
  const auto [nearest, farthest] = std::minmax_element(f.distance.begin(), f.distance.end());
  nlohmann::ordered_json result = {
      {"rows", data.rows()}, {"distance_m", {*nearest, *farthest}}, {"walls", nlohmann::ordered_json::object()}};
  for (std::size_t m = 0; m < f.materials.size(); ++m) {
    std::vector<std::size_t> rows;
    for (const int count : f.by_material[m]) {
      rows.resize(std::max(rows.size(), static_cast<std::size_t>(count) + 1));
      ++rows[static_cast<std::size_t>(count)];
    }
    result["walls"][f.materials[m]] = rows;  // how many readings cross none, one, two ...
  }
  if (!file.empty()) result["file"] = file;
  return result;
}

}  // namespace

int run_features(const Arguments& arguments) {
  CLI::App app(
      "Distance, walls crossed by material, and angles of each measured reading, from the world's plan.\n"
      "Example: muster features worlds/hall --data worlds/hall/measured.csv --out features.csv",
      "features");
  std::string world, file, out;
  std::vector<std::string> plugins;
  bool json = false;
  app.add_option("world", world, "the world's folder or file")->required();
  app.add_option("--data", file, "measured readings, a CSV table")->required();
  app.add_option("--out", out, "the table to write, a row a reading");
  app.add_option("--plugins", plugins, "a folder of plugins, looked in first");
  app.add_flag("--json", json, "print a summary as JSON");
  parse(app, arguments);
  const Dataset data = read_dataset(file);
  const LinkModel model(world, file, plugin_path(plugins));
  const Features features = features_of(model);
  if (!out.empty()) write_table(out, data, features);
  const auto what = summary(data, features, out);
  if (json) return fmt::print("{}\n", what.dump(2)), 0;
  fmt::print("{} readings, {:.2f} to {:.2f} m\n", data.rows(), what["distance_m"][0].get<double>(),
             what["distance_m"][1].get<double>());
  for (const auto& [material, rows] : what["walls"].items()) {
    fmt::print("walls of {}:", material);
    for (std::size_t k = 0; k < rows.size(); ++k) fmt::print(" {} x {}", rows[k].get<std::size_t>(), k);
    fmt::print("\n");
  }
  if (!out.empty()) fmt::print("written to {}\n", out);
  return 0;
}

}  // namespace muster::cli
