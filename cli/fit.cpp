// muster fit WORLD --data FILE: the world's free parameters from measurements, and where the world misfits.
#include <fmt/core.h>

#include <fstream>

#include "diagnosis/report/fit_report.hpp"
#include "verbs.hpp"
#include "written_files.hpp"

namespace muster::cli {
namespace {

struct Words {
  std::string world, data, out, average = "dB";
  std::vector<std::string> free, fix, plugins;
  double cell = 0.25;
  int least = 5;
  bool json = false;
};

Words words_of(const Arguments& arguments) {
  CommandLine line(
      "fit",
      "Fits a world's free parameters to measured readings, with standard errors that allow for correlated residuals, "
      "and says\n"
      "where the fitted world misfits. Exit code 1: a parameter that was to be fitted is not identifiable.\n"
      "Example: muster fit worlds/hall --data worlds/hall/measured.csv --out build/fit");
  Words words;
  line.option("world", words.world, "the world's folder or file").required();
  line.option("--data", words.data, "measured readings, a CSV table (docs/reference/table_format.md)").required();
  line.option("--free", words.free, "a parameter to fit beyond those declared free, such as radio.multiwall/tx_power");
  line.option("--fix", words.fix, "a parameter to hold: PATH, or PATH=VALUE");
  line.option("--cell", words.cell, "size of the cells that are averaged, in m").within(0.01, 100.0).shows_default();
  line.option("--least", words.least, "readings below which a cell is left grey").within(1, 1000000).shows_default();
  line.option("--average", words.average, "cell means of dB, or of power").one_of({"dB", "power"}).shows_default();
  line.option("--out", words.out, "a folder for pictures");
  line.option("--plugins", words.plugins, "a folder of plugins, looked in first");
  line.flag("--json", words.json, "print the result as JSON");
  line.parse(arguments);
  WrittenFiles::writes_folder(words.out, "--out");
  return words;
}

// The first byte that is no white space; 0 where there is none.
char first_of(const std::string& path) {
  std::ifstream file(path);
  char first = 0;
  return file >> first ? first : '\0';
}

void refuse_exchanged(const Words& words) {
  if (std::filesystem::is_directory(words.world) || first_of(words.world) == '<' || first_of(words.data) != '<') return;
  throw Error(Exit::invalid_input, "muster fit: --data " + words.data + " begins with '<' as a world does, and " +
                                       words.world + " does not; expected muster fit WORLD --data TABLE");
}

}  // namespace

int run_fit(const Arguments& arguments) {
  const Words words = words_of(arguments);
  refuse_exchanged(words);
  Progress progress("fit");
  progress.at(0);
  const diagnosis::CellOptions cells{words.cell, words.least,
                                     words.average == "dB" ? diagnosis::Average::dB : diagnosis::Average::power};
  report::FitReport report(words.world, words.data, plugin_path(words.plugins), {words.free, words.fix}, cells,
                           [&](double share) { progress.at(share); });
  if (!words.out.empty()) report.draw(words.out);
  progress.at(1);
  if (words.json)
    fmt::print("{}\n", report.json().dump(2));
  else
    report.print();
  return static_cast<int>(report.fit().not_identifiable.empty() ? Exit::done : Exit::check_failed);
}

}  // namespace muster::cli
