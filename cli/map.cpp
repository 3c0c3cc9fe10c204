// muster map WORLD: what of a radio is received where.
#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <muster/tables.hpp>
#include <optional>
#include <tuple>

#include "cli/pose_angles.hpp"
#include "diagnosis/radio/links/floor_plan.hpp"
#include "diagnosis/radio/links/link_model.hpp"
#include "diagnosis/radio/links/run_tables.hpp"
#include "plotting/figure.hpp"
#include "plotting/raster.hpp"
#include "run_options.hpp"
#include "text/json.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "text/temporary_folder.hpp"
#include "text/text_table_writer.hpp"
#include "world_file/kinds.hpp"
#include "written_files.hpp"

namespace muster::cli {
namespace {

namespace fs = std::filesystem;
namespace pic = plotting;

struct MapWords {
  std::string world, out;
  std::vector<std::string> from, plugins;
  double at = 0, height = 1;
  std::vector<double> area;
  int cells = 100;
  bool drawn = false, json = false;
};

std::string numbers(const std::vector<double>& values) {
  std::string result;
  for (const double v : values) result += (result.empty() ? "" : " ") + print_real(v);
  return result;
}

// Refuses corners that are not in order: mostly X0 X1 Y0 Y1, as other programs have them.
void check_area(const std::vector<double>& area) {
  const auto [x0, y0, x1, y1] = std::tuple(area[0], area[1], area[2], area[3]);
  if (x0 < x1 && y0 < y1) return;
  const auto told = [](const std::string& name, double low, double high) {
    return low == high ? name + "0 and " + name + "1 are both " + print_real(low)
                       : name + "0 = " + print_real(low) + " is above " + name + "1 = " + print_real(high);
  };
  const bool is_exchanged = x0 < y0 && x1 < y1;  // taken as X0 X1 Y0 Y1
  const std::vector<double> meant =
      is_exchanged ? std::vector<double>{x0, x1, y0, y1}
                   : std::vector<double>{std::min(x0, x1), std::min(y0, y1), std::max(x0, x1), std::max(y0, y1)};
  const bool has_area = meant[0] < meant[2] && meant[1] < meant[3];
  throw Error(Exit::invalid_input, "--area: " + numbers(area) + ": " +
                                       (x0 < x1 ? told("Y", y0, y1) : told("X", x0, x1)) +
                                       "; expected X0 Y0 X1 Y1, two corners, X0 < X1 and Y0 < Y1" +
                                       (has_area ? "; did you mean --area " + numbers(meant) + "?" +
                                                       (is_exchanged ? " (from its order X0 X1 Y0 Y1)" : "")
                                                 : ""));
}

MapWords map_words(const Arguments& arguments) {
  CommandLine line(
      "map",
      "The RSSI of a world's radios over its floor: a table, and pictures. It is what the channel expects on average, "
      "or\n"
      "with --drawn what it is with this world's shadowing and fading. Doors stand as the world file has them.\n"
      "Example: muster map worlds/hall --out build/map");
  MapWords words;
  std::string at = "0", height = "1";
  std::vector<std::string> area;
  line.option("world", words.world, "the world's folder or file").required();
  line.option("--from", words.from, "radios that send; all that do not move, or else all");
  line.option("--at", at, "seconds after the start: robots stand where they are then").shows_default();
  line.option("--height", height, "of the receiver above the floor, in m").shows_default();
  line.option("--cells", words.cells, "cells along the longer side").within(2, 2000).shows_default();
  line.option("--area", area, "X0 Y0 X1 Y1 in m; all walls and radios, with some room around them").takes(4);
  line.flag("--drawn", words.drawn, "with shadowing and fading, not received below the receiver's sensitivity");
  line.option("--out", words.out, "a folder for map.csv and the pictures").required();
  line.option("--plugins", words.plugins, "a folder of plugins, looked in first");
  line.flag("--json", words.json, "print a summary as JSON");
  line.parse(arguments);
  WrittenFiles::writes_folder(words.out, "--out");
  words.at = real_of(at, "--at", "s");
  words.height = real_of(height, "--height", "m");
  for (const std::string& one : area) words.area.push_back(real_of(one, "--area", "m"));
  if (!words.area.empty()) check_area(words.area);
  return words;
}

struct Sender {
  std::string name;
  Pose at;
};

// Square cells, rows from the south.
struct Grid {
  double x0, y0, cell;
  std::size_t width, height;

  std::size_t size() const { return width * height; }
  double x(std::size_t i) const { return x0 + (static_cast<double>(i % width) + 0.5) * cell; }
  double y(std::size_t i) const {
    const std::size_t row = i / width;
    return y0 + (static_cast<double>(row) + 0.5) * cell;
  }
};

std::vector<Sender> senders_of(const Simulation& run, const MapWords& words) {
  expect_channel(run);
  const auto names = names_of(run, "radio");
  const auto mounts = rows_of<Mount>(run, "radio/*/mount");
  const auto endpoints = rows_of<Endpoint>(run, "endpoint/*/radio");
  const auto places = rows_of<Pose>(run, "endpoint/*/pose");
  const auto& alive = run.board().find_set("radio")->alive;
  std::vector<std::string> wanted = words.from, there;
  for (std::size_t i = 0; words.from.empty() && i < names.size(); ++i) {
    if (!alive[i]) continue;
    there.push_back(names[i]);
    if (std::isnan(mounts[i].robot)) wanted.push_back(names[i]);
  }
  if (wanted.empty()) wanted = there;
  if (wanted.empty()) throw Error(Exit::invalid_input, run.world().file.string() + ": the world has no radio");
  std::vector<Sender> senders;
  for (const std::string& name : wanted) {
    if (std::find(names.begin(), names.end(), name) == names.end())
      throw Error(Exit::invalid_input,
                  "--from: no radio is called " + quote(name) + which_is(run.world(), name, "radio") + "; " +
                      suggest(name, names) +
                      (name.find(',') == name.npos ? "" : "; names stand between blanks, without commas"));
    const auto at = std::find_if(endpoints.begin(), endpoints.end(), [&](const Endpoint& e) {
      return names.at(static_cast<std::size_t>(e.radio)) == name;
    });
    if (at == endpoints.end())
      throw Error(Exit::invalid_input, "--from: radio " + quote(name) + " is not there at that time");
    senders.push_back({name, places[static_cast<std::size_t>(at - endpoints.begin())]});
  }
  return senders;
}

Grid grid_of(const pic::FloorPlan& plan, const std::vector<Sender>& senders, const MapWords& words) {
  pic::Extent x, y;
  const auto add = [&](double px, double py) { x.add(px), y.add(py); };
  if (words.area.empty()) {
    for (const pic::Wall& w : plan.walls) add(w.from.x, w.from.y), add(w.to.x, w.to.y);
    for (const Sender& s : senders) add(s.at.x, s.at.y);
    const double room = plan.walls.empty() ? 10 : 0.5;  // m
    const pic::Range w = x.range(), h = y.range();
    add(w.low - room, h.low - room), add(w.high + room, h.high + room);
  } else {
    constexpr double farthest = 100'000;  // m, as of the scene
    for (const double v : words.area)
      if (!(std::abs(v) <= farthest))
        throw Error(Exit::invalid_input,
                    "--area: " + print_real(v) + " m lies beyond the scene; expected metres within 100000 m");
    add(words.area[0], words.area[1]), add(words.area[2], words.area[3]);
  }
  const double width = x.range().span(), height = y.range().span();
  if (!(width > 0 && height > 0))
    throw Error(Exit::invalid_input, "--area: the plan has no width or no height; expected X0 Y0 X1 Y1");
  const double cell = std::max(width, height) / words.cells;
  const auto count = [&](double length) {
    return static_cast<std::size_t>(std::max(1.0, std::ceil(length / cell - 1e-9)));
  };
  return {x.range().low, y.range().low, cell, count(width), count(height)};
}

// A reading from the sender in the middle of each cell.
void write_readings(const Sender& sender, const std::string& receiver, const Grid& grid, const MapWords& words,
                    const fs::path& file) {
  TextTableWriter table(file, {{"t", "s"},
                               {"tx", ""},
                               {"rx", ""},
                               {"tx_x", "m"},
                               {"tx_y", "m"},
                               {"tx_z", "m"},
                               {"tx_yaw", "rad"},
                               {"rx_x", "m"},
                               {"rx_y", "m"},
                               {"rx_z", "m"}});
  const Pose& p = sender.at;
  const double yaw = yaw_of(p);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    table.real(words.at);
    table.text(sender.name), table.text(receiver);
    for (const double v : {p.x, p.y, p.z, yaw, grid.x(i), grid.y(i), words.height}) table.real(v);
    table.end_row();
  }
  table.close();
}

std::vector<double> map_of(const Sender& sender, const std::string& receiver, const Grid& grid, const MapWords& words) {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "cells.csv";
  write_readings(sender, receiver, grid, words, file);
  diagnosis::LinkModel model(words.world, file, plugin_path(words.plugins));
  const Eigen::VectorXd rssi = words.drawn ? model.drawn() : model.expected();
  return {rssi.begin(), rssi.end()};
}

void write_table(const std::vector<Sender>& senders, const std::vector<std::vector<double>>& maps, const Grid& grid,
                 const fs::path& file) {
  std::vector<TextColumn> columns{{"x", "m"}, {"y", "m"}};
  for (const Sender& s : senders) {
    std::string name = s.name;  // a radio may be called x or y
    const auto is_taken = [&](const TextColumn& column) { return column.name == name; };
    while (std::any_of(columns.begin(), columns.end(), is_taken)) name.insert(0, "rssi_");
    columns.push_back({name, "dBm"});
  }
  TextTableWriter table(file, columns);
  for (std::size_t i = 0; i < grid.size(); ++i) {
    table.real(grid.x(i)), table.real(grid.y(i));
    for (const auto& map : maps) table.real(map[i]);
    table.end_row();
  }
  table.close();
}

pic::Figure figure_of(const std::string& world, const Sender& sender, const std::vector<double>& map, const Grid& grid,
                      pic::FloorPlan plan, const MapWords& words) {
  pic::Cells cells{.size = grid.cell};
  for (std::size_t i = 0; i < map.size(); ++i) {
    cells.x.push_back(grid.x(i));
    cells.y.push_back(grid.y(i));
    cells.value.push_back(map[i]);
  }
  plan.stations = {{{sender.at.x, sender.at.y}, sender.name}};
  const std::string what = words.drawn ? "with shadowing and fading" : "expected on average";
  return {.title = world + ": " + sender.name,
          .caption = fmt::format("RSSI {}, {} m above the floor.", what, print_real(words.height)),
          .width = 900,
          .panels = {{.value = {.label = "RSSI", .unit = "dBm"},
                      .frame = pic::Frame::scale_bar,
                      .layers = {std::move(cells), std::move(plan)}}}};
}

// Metres, without the rounding of sums of cells.
double shown(double metres) { return std::round(metres * 1e3) / 1e3 + 0.0; }

// What is said of a receiver far above all that the world has; "" of any other.
std::string doubt_of_height(const Simulation& run, const std::vector<Sender>& senders, double height) {
  constexpr double plainly = 20;  // m, above all
  double top = 0;
  for (const Sender& s : senders) top = std::max(top, s.at.z);
  for (const RowDeclaration& row : run.world().rows) {
    for (const StoredValues& given : row.values) {
      if (given.table != "wall/shape") continue;
      std::array<double, 8> wall{};
      given.store ? given.store(given.values.data(), wall.data())
                  : static_cast<void>(
                        std::copy_n(given.values.begin(), std::min(given.values.size(), wall.size()), wall.begin()));
      top = std::max(top, wall[4] + wall[5]);
    }
  }
  if (height < 0) return "--height: " + print_real(height) + " m is below the floor; expected metres above it";
  if (height <= top + plainly) return "";
  return "--height: " + print_real(height) + " m is above everything, which reaches up to " + print_real(shown(top)) +
         " m; is this centimetres? " + print_real(height) + " cm are " + print_real(height / 100) + " m";
}

// None where nothing is received in any cell.
std::optional<pic::Range> range_of(const std::vector<double>& map) {
  pic::Extent extent;
  for (const double v : map) extent.add(v);
  return extent.empty() ? std::nullopt : std::optional(extent.range());
}

}  // namespace

int run_map(const Arguments& arguments) {
  const MapWords words = map_words(arguments);
  World world = read_world(words.world, standard());
  const uint64_t until = tick_in_run(world, words.at, "--at");
  Simulation run(std::move(world), standard(), {plugin_path(words.plugins), 1, {}});
  Progress progress("map");
  watch_interrupt();
  while (run.tick() < until && !interrupted()) {
    run.step();
    progress.at(0.5 * static_cast<double>(run.tick()) / static_cast<double>(until));
  }
  if (interrupted()) return static_cast<int>(Exit::interrupted);
  run.evaluate(MUSTER_RADIO, true);
  const std::vector<Sender> senders = senders_of(run, words);
  const pic::FloorPlan plan = plan_of(run);
  const Grid grid = grid_of(plan, senders, words);
  const std::string above = doubt_of_height(run, senders, words.height);
  const auto radios = names_of(run, "radio");
  std::string receiver = "probe";
  while (std::find(radios.begin(), radios.end(), receiver) != radios.end()) receiver += '_';

  std::error_code failed;
  fs::create_directories(words.out, failed);
  if (failed) throw Error(Exit::io, words.out + ": " + failed.message());
  Json json{{"world", run.world().name},    {"cell_m", grid.cell},      {"cells", {grid.width, grid.height}},
            {"from_m", {grid.x0, grid.y0}}, {"radios", Json::object()}, {"files", Json::array()}};
  if (!above.empty()) json["warnings"] = Json::array(), json["warnings"].push_back(above);
  const auto wrote = [&](const fs::path& file) { json["files"].push_back(file.string()); };
  std::vector<std::vector<double>> maps;
  try {
    for (const Sender& sender : senders) {
      maps.push_back(map_of(sender, receiver, grid, words));
      const std::optional<pic::Range> range = range_of(maps.back());
      json["radios"][sender.name] = {{"lowest_dbm", range ? Json(range->low) : Json()},
                                     {"highest_dbm", range ? Json(range->high) : Json()}};
      const fs::path file = fs::path(words.out) / ("map_" + sender.name + ".svg");
      pic::save(figure_of(run.world().name, sender, maps.back(), grid, plan, words), file);
      wrote(file);
      const std::size_t pixels = std::max<std::size_t>(1, 400 / grid.width);
      const fs::path raster = fs::path(file).replace_extension("png");
      pic::save_png(maps.back(), grid.width, range.value_or(pic::Range{}), pic::Map::viridis, pixels, raster);
      wrote(raster);
      progress.at(0.5 + 0.5 * static_cast<double>(maps.size()) / static_cast<double>(senders.size()));
    }
  } catch (const Error&) {
    throw;
  } catch (const std::runtime_error& e) {  // of the pictures
    throw Error(Exit::io, e.what());
  }
  wrote(fs::path(words.out) / "map.csv");
  write_table(senders, maps, grid, fs::path(words.out) / "map.csv");
  if (words.json) return fmt::print("{}\n", json.dump(2)), 0;
  if (!above.empty()) fmt::print("warning: {}\n", above);
  fmt::print("{}: {} x {} cells of {:.3g} m, x {} to {}, y {} to {} m\n", run.world().name, grid.width, grid.height,
             grid.cell, print_real(shown(grid.x0)), print_real(shown(grid.x0 + grid.cell * double(grid.width))),
             print_real(shown(grid.y0)), print_real(shown(grid.y0 + grid.cell * double(grid.height))));
  for (const auto& [name, r] : json["radios"].members()) {
    if (r["lowest_dbm"].is_null())
      fmt::print("  {:<16} nothing received\n", name);
    else
      fmt::print("  {:<16} {:.1f} to {:.1f} dBm\n", name, r["lowest_dbm"].real(), r["highest_dbm"].real());
  }
  for (const Json& file : json["files"].elements()) fmt::print("  wrote {}\n", file.text());
  return 0;
}

}  // namespace muster::cli
