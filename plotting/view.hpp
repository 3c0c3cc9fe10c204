// Layout of a panel: its ranges, colours, legend and the room for its text.
#pragma once

#include "figure.hpp"
#include "labels.hpp"
#include "ticks.hpp"

namespace muster::plotting {

// Sizes of text and gaps, px.
inline constexpr double bar_opacity = 0.6, band_opacity = 0.22;
inline constexpr double tick_size = 10.5, axis_size = 11.5, title_size = 12.5, figure_title_size = 16,
                        caption_size = 11;
inline constexpr double tick_length = 4, legend_height = 17, bar_width = 11, line_gap = 13;

enum class Sign { line = 1, dot, patch, wall };

struct LegendEntry {
  std::string label;
  Colour colour;
  Sign sign;
  double opacity = 1;
};

// A label in the right margin, at a height given in data.
struct EndLabel {
  std::string label;
  Colour colour;
  double y;
};

struct Margins {
  double left = 0, right = 0, top = 0, bottom = 0;
};

struct View {
  const Panel* panel = nullptr;
  Extent x, y, value;  // of the data
  Range x_range, y_range, value_range;
  bool has_value = false;             // some of it is coloured by value
  bool counts = false;                // y is a count
  bool show_x = true, show_y = true;  // false: a neighbour shows the same axis
  std::vector<Colour> colours;        // one a layer
  std::vector<LegendEntry> legend;
  std::vector<EndLabel> end_labels;
  std::vector<Tick> y_ticks, value_ticks;
  Margins margins;
};

// Shades of walls, by the index of their material in this list.
std::vector<std::string> materials(const FloorPlan& plan);
Colour wall_shade(std::size_t material);

// The heights of a histogram's bars, and the number of drawable values outside its bins.
struct Bars {
  std::vector<double> heights;
  std::size_t outside = 0;
};
Bars bars(const Histogram& histogram);

// A tick a name.
std::vector<Tick> name_ticks(const Axis& axis);
// True if the names on an x axis of this width would overlap, so that they are turned.
bool names_crowded(const Axis& axis, double width);

inline bool equal_units(const Panel& panel) { return panel.equal || panel.frame == Frame::scale_bar; }

// Width of the widest label, px.
double widest(const std::vector<Tick>& ticks);
// Width of the colour bar in the right margin, px.
double colour_bar_room(const View& view);

// "label (unit)"
std::string axis_title(const Axis& axis);

// Throws std::invalid_argument as svg() does; `which` names the panel.
void check(const Panel& panel, const std::string& which);

// Data extents, colours and legend. set_ranges() sets the ranges later, after panels have shared their extents.
View look(const Panel& panel);
void set_ranges(View& view);
void set_margins(View& view, double plot_width);

// Number of rows of the legend at this width.
int legend_rows(const std::vector<LegendEntry>& legend, double width);
double legend_entry_width(const LegendEntry& entry);

}  // namespace muster::plotting
