#include "diagnosis/calibration/fit_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <muster/tables.hpp>

#include "diagnosis/radio/links/floor_plan.hpp"
#include "plotting/figure.hpp"

namespace muster::diagnosis {
namespace {

namespace pic = plotting;

constexpr std::size_t most_maps = 6;

class Artist {
 public:
  Artist(const LinkModel& model, const Fit& fit, const ResidualScan& misfit, const std::vector<CellMap>& maps,
         const CellErrors& errors, const CellOptions& options)
      : model_(model),
        fit_(fit),
        misfit_(misfit),
        maps_(maps),
        errors_(errors),
        options_(options),
        name_(model.simulation().world().name),
        plan_(plan_of(model.simulation())) {
    plan_.stations.clear();  // drawn where the readings have them
  }

  pic::Figure samples() const {
    pic::Points above, side;
    for (const auto i : fit_.readings.heard) {
      const End& roams = roaming(static_cast<std::size_t>(i));
      above.x.push_back(roams.x);
      above.y.push_back(roams.y);
      above.value.push_back(fit_.readings.rssi[i]);
    }
    side.x = above.x;
    side.y = side.value = above.value;
    pic::FloorPlan plan = plan_;
    for (const CellMap& map : maps_) plan.stations.push_back({{map.x, map.y}, map.radio});
    pic::Panel top{.title = "from above",
                   .value = {.label = "measured RSSI", .unit = "dBm"},
                   .frame = pic::Frame::scale_bar,
                   .layers = {above, plan}};
    pic::Panel beside{.title = "from the side",
                      .x = {.label = "x", .unit = "m"},
                      .y = {.label = "measured RSSI", .unit = "dBm"},
                      .layers = {side}};
    beside.value = top.value;
    return {.title = fmt::format("{}: {} readings", name_, above.x.size()),
            .caption = "Each dot is one reading, at the place of the radio that moves.",
            .columns = 1,
            .panels = {top, beside}};
  }

  enum class Shown { measured = 1, simulated, error };

  pic::Figure cells(Shown shown, const std::string& title) const {
    pic::Figure figure{.title = name_ + ": " + title,
                       .caption = caption(),
                       .columns = maps_.size() > 1 ? 2 : 1,
                       .share_value = true,
                       .panels = {}};
    const auto [low, high] = shown == Shown::error ? error_limits() : level_limits();
    for (std::size_t m = 0; m < std::min(maps_.size(), most_maps); ++m) {
      pic::Cells cells{.size = options_.size};
      cells.min_count = options_.least;
      for (const Cell& c : maps_[m].cells) {
        const double value = shown == Shown::measured    ? c.measured
                             : shown == Shown::simulated ? c.simulated
                                                         : c.measured - c.simulated;
        cells.x.push_back(c.x);
        cells.y.push_back(c.y);
        cells.value.push_back(std::clamp(value, low, high));
        cells.count.push_back(c.count);
      }
      pic::FloorPlan plan = plan_;
      plan.stations.push_back({{maps_[m].x, maps_[m].y}, maps_[m].radio});
      pic::Panel panel{
          .title = maps_.size() > 1 ? maps_[m].radio : "", .frame = pic::Frame::scale_bar, .layers = {cells, plan}};
      panel.value = shown == Shown::error
                        ? pic::Axis{.label = "measured - simulated", .unit = "dB", .from = low, .to = high}
                        : pic::Axis{.label = "mean RSSI", .unit = "dBm", .from = low, .to = high};
      panel.map = shown == Shown::error ? pic::Map::diverging : pic::Map::viridis;
      figure.panels.push_back(panel);
    }
    return figure;
  }

  pic::Figure histogram() const {
    pic::Histogram bars{.values = errors_.errors};
    const double half = std::max(3.0, std::ceil(4 * errors_.sd + std::abs(errors_.mean)));
    const double width = half > 12 ? 1 : 0.5;
    for (double edge = -half; edge <= half + 1e-9; edge += width) bars.edges.push_back(edge);
    pic::Panel panel{
        .x = {.label = "cell mean, measured - simulated", .unit = "dB"},
        .y = {.label = "cells"},
        .layers = {
            bars, pic::Rule{.at = errors_.mean, .label = fmt::format("mean {:+.2f}", errors_.mean), .vertical = true}}};
    return {.title = fmt::format("{}: errors of {} cell means, sd {:.2f} dB", name_, errors_.errors.size(), errors_.sd),
            .caption = fmt::format("Independent errors of single readings would give an sd of {:.2f} dB. The figure "
                                   "does not show where errors lie, "
                                   "nor what the fit has absorbed.",
                                   errors_.expected_sd),
            .panels = {panel}};
  }

  pic::Figure looks() const {
    pic::Figure figure{
        .title = name_ + ": what is left in the residual",
        .caption = misfit_.shared_allowed
                       ? "Mean of measured - simulated with 95 % intervals that allow for errors that neighbours share."
                       : "Mean of measured - simulated with 95 % intervals for readings that share nothing, as the "
                         "world declares.",
        .columns = 2,
        .width = 1000,
        .panels = {}};
    for (const StructureTest& look : misfit_.looks) {
      if (!look.bins.empty()) figure.panels.push_back(panel_of(look));
    }
    return figure;
  }

 private:
  // The end of the link other than its map's radio.
  const End& roaming(std::size_t row) const {
    const auto& ends = model_.ends()[row];
    const std::string tx = model_.radio_name(ends[0].radio);
    const bool tx_stays = std::any_of(maps_.begin(), maps_.end(), [&](const CellMap& m) { return m.radio == tx; });
    return ends[tx_stays ? 1 : 0];
  }

  std::string caption() const {
    return fmt::format("Means of {} over cells of {:g} m; grey: fewer than {} readings.",
                       options_.average == Average::dB ? "dBm" : "power", options_.size, options_.least);
  }

  std::pair<double, double> level_limits() const {
    double low = 1e300, high = -1e300;
    for (const CellMap& map : maps_) {
      for (const Cell& c : map.cells) {
        if (c.count < options_.least) continue;
        low = std::min({low, c.measured, c.simulated});
        high = std::max({high, c.measured, c.simulated});
      }
    }
    return low < high ? std::pair{std::floor(low), std::ceil(high)} : std::pair{-100.0, 0.0};
  }

  std::pair<double, double> error_limits() const {
    const double half = std::max(3.0, std::ceil(3 * errors_.sd));
    return {-half, half};
  }

  static pic::Panel panel_of(const StructureTest& look) {
    pic::Panel panel{
        .title = fmt::format("{}{}", look.by,
                             look.alarm ? (look.p < 1e-9 ? ": p < 1e-9" : fmt::format(": p = {:.1g}", look.p)) : ""),
        .x = {.label = look.by, .unit = look.unit},
        .y = {.label = "residual", .unit = "dB"},
        .layers = {pic::Rule{.at = 0}}};
    pic::ErrorBars bars{.colour = look.alarm ? pic::vermillion : pic::blue};
    for (const Bin& bin : look.bins) {
      const bool named = !bin.name.empty();
      if (named) panel.x.names.push_back(bin.name);
      bars.x.push_back(named ? static_cast<double>(bars.x.size()) : (bin.from + bin.to) / 2);
      bars.y.push_back(bin.mean);
      bars.low.push_back(bin.mean - 1.96 * bin.stderror);
      bars.high.push_back(bin.mean + 1.96 * bin.stderror);
    }
    if (look.by == "distance") panel.x.log = true;
    panel.layers.push_back(bars);
    return panel;
  }

  const LinkModel& model_;
  const Fit& fit_;
  const ResidualScan& misfit_;
  const std::vector<CellMap>& maps_;
  const CellErrors& errors_;
  const CellOptions& options_;
  std::string name_;
  pic::FloorPlan plan_;
};

}  // namespace

std::vector<std::filesystem::path> write_fit_pictures(const std::filesystem::path& folder, const LinkModel& model,
                                                      const Fit& fit, const ResidualScan& misfit,
                                                      const std::vector<CellMap>& maps, const CellErrors& errors,
                                                      const CellOptions& options) {
  std::filesystem::create_directories(folder);
  const Artist artist(model, fit, misfit, maps, errors, options);
  const std::vector<std::pair<const char*, pic::Figure>> figures = {
      {"fig3a.svg", artist.samples()},
      {"fig3b.svg", artist.cells(Artist::Shown::measured, "measured")},
      {"fig3c.svg", artist.cells(Artist::Shown::simulated, "simulated")},
      {"fig3d.svg", artist.histogram()},
      {"residual_map.svg", artist.cells(Artist::Shown::error, "residual")},
      {"residual.svg", artist.looks()}};
  std::vector<std::filesystem::path> files;
  for (const auto& [name, figure] : figures) {
    if (figure.panels.empty()) continue;
    files.push_back(folder / name);
    pic::save(figure, files.back());
  }
  return files;
}

}  // namespace muster::diagnosis
