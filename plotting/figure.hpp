// A figure: panels in a grid, declared as data and written as SVG.
//
//   Figure figure{.title = "Fig. 5", .panels = {{.x = {.label = "time", .unit = "s"},
//                                                .y = {.label = "RSSI", .unit = "dBm", .from = -80, .to = -40},
//                                                .layers = {Line{.x = t, .y = leader, .label = "leader"},
//                                                           Rule{.at = -60, .label = "−60 dBm"}}}}};
//   save(figure, "fig5.svg");
#pragma once

#include <filesystem>

#include "layers.hpp"

namespace muster::plotting {

struct Axis {
  std::string label{};
  std::string unit{};
  std::optional<double> from{}, to{};  // an end that is not given follows the data
  bool log = false;
  std::vector<std::string> names{};  // categories at 0, 1, 2 ... instead of numbers
};

enum class Frame { axes = 1, scale_bar };  // scale_bar: for floor plans, in metres

struct Panel {
  std::string title{};
  Axis x{}, y{};
  Axis value{};  // of values shown as colours, with a colour bar
  Map map = Map::viridis;
  bool equal = false;  // one unit is as long in y as in x; Frame::scale_bar implies it
  Frame frame = Frame::axes;
  double aspect = 0;    // height of the plot over its width; 0: 0.62, or by the data where `equal`
  bool legend = false;  // names lines in a row above the plot instead of at their ends
  std::vector<Layer> layers{};
};

struct Figure {
  std::string title{};
  std::string caption{};
  int columns = 1;
  double width = 800;                                          // px
  bool share_x = false, share_y = false, share_value = false;  // the same limits in all panels
  std::vector<Panel> panels{};
};

// The figure as a self-contained document. Throws std::invalid_argument naming the panel where the lengths of a layer's
// columns differ, bin edges do not rise, or a given limit is invalid (not finite, from >= to, <= 0 on a log axis).
std::string svg(const Figure& figure);

// Writes svg(figure) under a temporary name beside `file` and renames it: readers see the old picture or the new one.
// Throws std::filesystem::filesystem_error with the file and the reason.
void save(const Figure& figure, const std::filesystem::path& file);

}  // namespace muster::plotting
