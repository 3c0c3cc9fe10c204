#include "calibration.hpp"

#include "diagnosis/pipeline/closed_loop.hpp"
#include "diagnosis/pipeline/diagnose.hpp"
#include "diagnosis/report/fit_report.hpp"
#include "diagnosis/report/folder.hpp"
#include "diagnosis/report/json.hpp"
#include "diagnosis/report/regression.hpp"
#include "plotting/figure.hpp"

namespace muster::python {

std::string fit(const FitWords& words, const Library::SearchPath& plugins) {
  const diagnosis::CellOptions cells{words.cell, words.least,
                                     words.power ? diagnosis::Average::power : diagnosis::Average::dB};
  report::FitReport report(words.world, words.data, plugins, {words.free, words.fix}, cells);
  if (!words.out.empty()) report.draw(words.out);
  return report.json().dump();
}

std::string diagnose(const std::string& world, const std::string& data, const std::string& out,
                     const Library::SearchPath& plugins, const std::function<bool()>& stopped) {
  const inference::Watch watch{{}, stopped};
  diagnosis::Diagnosis found = diagnosis::diagnose(world, data, plugins, std::make_shared<TableCache>(), watch);
  if (!out.empty() && found.named() && !found.interrupted)
    found.loop = diagnosis::closed_loop(found, world, data, out, plugins, watch);
  if (!out.empty()) {
    report::Setting setting{world, data, {}};
    report::write_report(found, setting, out);
    report::write_regression(found, world, data, out);
  }
  return report::json_of(found).dump();
}

void plot(const std::string& file, const std::vector<double>& x, const std::vector<NamedLine>& lines,
          const std::string& x_label, const std::string& y_label, const std::string& title) {
  plotting::Panel panel;
  panel.x.label = x_label;
  panel.y.label = y_label;
  for (const NamedLine& line : lines)
    panel.layers.push_back(plotting::Line{.x = x, .y = line.values, .label = line.name});
  try {
    plotting::save({.title = title, .panels = {std::move(panel)}}, file);
  } catch (const std::invalid_argument& e) {
    throw Error(Exit::invalid_input, std::string("plot: ") + e.what());
  } catch (const std::runtime_error& e) {
    throw Error(Exit::io, std::string("plot: ") + e.what());
  }
}

}  // namespace muster::python
