// muster features WORLD --data FILE: what each reading's link looks like on the plan.
#include <fmt/core.h>

#include <algorithm>

#include "diagnosis/calibration/data_doubts.hpp"
#include "diagnosis/data/dataset.hpp"
#include "diagnosis/radio/links/geometry_checks.hpp"
#include "diagnosis/radio/links/link_features.hpp"
#include "text/json.hpp"
#include "text/text_table_writer.hpp"
#include "verbs.hpp"
#include "written_files.hpp"

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

// How many readings cross no wall, one, two ...
std::vector<std::size_t> histogram(const std::vector<int>& counts) {
  std::vector<std::size_t> rows;
  for (const int count : counts) {
    rows.resize(std::max(rows.size(), static_cast<std::size_t>(count) + 1));
    ++rows[static_cast<std::size_t>(count)];
  }
  return rows;
}

// What looks like another unit, site or name: as fit and diagnose say it.
std::vector<std::string> notes_of(const LinkModel& model, const Dataset& data) {
  std::vector<std::string> notes = data.notes;
  for (const auto& more : {notes_on_radios(model, data), doubts_of(model, data), check_places(model, data)})
    notes.insert(notes.end(), more.begin(), more.end());
  return notes;
}

void print_json(const Dataset& data, const Features& f, const std::vector<std::string>& notes,
                const std::string& file) {
  const auto [nearest, farthest] = std::minmax_element(f.distance.begin(), f.distance.end());
  Json result = {{"rows", data.rows()}, {"distance_m", {*nearest, *farthest}}, {"walls", Json::object()}};
  for (std::size_t m = 0; m < f.materials.size(); ++m) result["walls"][f.materials[m]] = histogram(f.by_material[m]);
  if (!file.empty()) result["file"] = file;
  result["notes"] = notes;
  fmt::print("{}\n", result.dump(2));
}

void print_text(const Dataset& data, const Features& f, const std::vector<std::string>& notes,
                const std::string& file) {
  const auto [nearest, farthest] = std::minmax_element(f.distance.begin(), f.distance.end());
  fmt::print("{} readings, {:.2f} to {:.2f} m\n", data.rows(), *nearest, *farthest);
  for (const std::string& note : notes) fmt::print("note: {}\n", note);
  for (std::size_t m = 0; m < f.materials.size(); ++m) {
    fmt::print("walls of {}:", f.materials[m]);
    const auto rows = histogram(f.by_material[m]);
    for (std::size_t k = 0; k < rows.size(); ++k) fmt::print(" {} x {}", rows[k], k);
    fmt::print("\n");
  }
  if (!file.empty()) fmt::print("written to {}\n", file);
}

}  // namespace

int run_features(const Arguments& arguments) {
  CommandLine line("features",
                   "Distance, walls crossed by material, and angles of each measured reading, from the world's plan.\n"
                   "Example: muster features worlds/hall --data worlds/hall/measured.csv --out features.csv");
  std::string world, file, out;
  std::vector<std::string> plugins;
  bool json = false;
  line.option("world", world, "the world's folder or file").required();
  line.option("--data", file, "measured readings, a CSV table").required();
  line.option("--out", out, "the table to write, a row a reading");
  line.option("--plugins", plugins, "a folder of plugins, looked in first");
  line.flag("--json", json, "print a summary as JSON");
  line.parse(arguments);
  WrittenFiles files;
  files.reads_world(world);
  files.reads(file, "--data");
  files.writes(out, "--out");
  const Dataset data = read_dataset(file);
  const LinkModel model(world, file, plugin_path(plugins));
  const std::vector<std::string> notes = notes_of(model, data);
  const Features features = features_of(model);
  if (!out.empty()) write_table(out, data, features);
  if (json)
    print_json(data, features, notes, out);
  else
    print_text(data, features, notes, out);
  return 0;
}

}  // namespace muster::cli
