// muster fit WORLD --data FILE: the world's free parameters from measurements, and where the world misfits.
#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>

#include "diagnosis/report/fit_report.hpp"
#include "diagnosis/report/noise_report.hpp"
#include "text/names.hpp"
#include "verbs.hpp"
#include "written_files.hpp"

namespace muster::cli {
namespace {

struct FitWords {
  std::string world, data, table, out, average = "dB", log = "10";
  std::vector<std::string> free, fix, plugins;
  double cell = 0.25;
  int least = 5;
  bool json = false;
};

FitWords fit_words(const Arguments& arguments) {
  CommandLine line(
      "fit",
      "Fits a world's free parameters to measured readings, with standard errors that allow for correlated residuals, "
      "and says\n"
      "where the fitted world misfits. Exit code 1: a parameter that was to be fitted is not identifiable.\n"
      "Example: muster fit worlds/hall --data worlds/hall/measured.csv --out build/fit");
  FitWords words;
  line.option("world", words.world, "the world's folder or file").required();
  line.option("--data", words.data, "measured readings, a CSV table (docs/reference/table_format.md)").required();
  line.option("--table", words.table,
              "the data are rows of this table, such as 'robot/*/odometry': fits the standard deviations of its noise");
  line.option("--free", words.free, "a parameter to fit beyond those declared free, such as radio.multiwall/tx_power");
  line.option("--fix", words.fix, "a parameter to hold: PATH, or PATH=VALUE");
  line.option("--cell", words.cell, "size of the cells that are averaged, in m").within(0.01, 100.0).shows_default();
  line.option("--least", words.least, "readings below which a cell is left grey").within(1, 1000000).shows_default();
  line.option("--average", words.average, "cell means of dB, or of power").one_of({"dB", "power"}).shows_default();
  line.option("--log", words.log, "base of the logarithm of distance in which the exponent n is told, too")
      .one_of({"10", "natural"})
      .shows_default();
  line.option("--out", words.out, "a folder for pictures");
  line.option("--plugins", words.plugins, "a folder of plugins, looked in first");
  line.flag("--json", words.json, "print the result as JSON");
  line.void_beside("--table", {"--cell", "--least", "--average", "--log", "--out"}, "reads no levels of links");
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

void refuse_exchanged(const FitWords& words) {
  if (std::filesystem::exists(std::filesystem::path(words.data) / "world.xml"))
    throw Error(Exit::invalid_input, "muster fit: --data " + words.data +
                                         " is the folder of a world; expected muster fit " + words.data +
                                         " --data TABLE");
  if (std::filesystem::is_directory(words.world) || first_of(words.world) == '<' || first_of(words.data) != '<') return;
  throw Error(Exit::invalid_input, "muster fit: --data " + words.data + " begins with '<' as a world does, and " +
                                       words.world + " does not; expected muster fit WORLD --data TABLE");
}

// The same path loss with natural logarithms, L = l0 + 10 n ln d: n is less by ln 10, and l0 the same. Papers do not
// always say which they mean, and -60 dBm is elsewhere if it is taken for the other.
struct NaturalExponent {
  std::string path;
  double value, lower95, upper95;
  // Of -60 dBm in the open [m]: with it, and with its n taken for one of base 10; NaN of a plugin without tx_power or
  // l0.
  double reach, mistaken;
};

std::vector<NaturalExponent> natural_exponents(const report::FitReport& report) {
  constexpr double level = -60;  // [dBm]
  const double ten = std::log(10.0);
  std::vector<NaturalExponent> result;
  const auto& fitted = report.fit().parameters;
  for (const auto& n : fitted) {
    if (!n.path.ends_with("/n") || !n.identifiable) continue;
    const std::string owner = n.path.substr(0, n.path.size() - 1);
    const auto all = report.simulation().parameters();
    const auto of = [&](const std::string& name) {
      const auto is_it = [&](const auto& p) { return p.path == owner + name; };
      const auto found = std::find_if(fitted.begin(), fitted.end(), is_it);
      const auto given = std::find_if(all.begin(), all.end(), is_it);
      if (found != fitted.end()) return found->value;
      return given != all.end() ? given->value : std::numeric_limits<double>::quiet_NaN();
    };
    const double loss = of("tx_power") - of("l0") - level;  // that distance may have [dB]
    result.push_back({n.path, n.value / ten, n.lower95 / ten, n.upper95 / ten, std::pow(10, loss / (10 * n.value)),
                      std::pow(10, loss / (10 * n.value / ten))});
  }
  return result;
}

void print_natural(const std::vector<NaturalExponent>& exponents) {
  for (const auto& n : exponents) {
    fmt::print(
        "\nWith natural logarithms, L = l0 + 10 n ln d, the same path loss has {} = {:.3f} ({:.3f} to {:.3f}); l0 is "
        "the same.\n",
        n.path, n.value, n.lower95, n.upper95);
    if (std::isnan(n.reach)) continue;
    fmt::print(
        "In the open it leaves -60 dBm at {:.4g} m. Taken for an exponent of base 10, that n would put it at {:.4g} "
        "m.\n",
        n.reach, n.mistaken);
  }
}

// --table beside readings of radios, which need none.
void refuse_readings(const FitWords& words) {
  std::ifstream data(words.data);
  std::string header;
  std::getline(data, header);
  if (header.find("rssi") == header.npos) return;
  throw Error(Exit::invalid_input, Place{words.data, 1, 0},
              "has readings of radios, and --table " + quote(words.table) +
                  " asks for rows of such a table; without --table, the channel is fitted to them");
}

int fit_noise(const FitWords& words) {
  refuse_readings(words);
  const World world = read_world(words.world, standard());
  Options options{plugin_path(words.plugins), 1, {}};
  const auto fit = diagnosis::fit_noise(world, options, words.table, words.data, {words.free, words.fix});
  if (words.json)
    fmt::print("{}\n", report::json_of(fit).dump(2));
  else
    report::print(fit, words.table, words.data);
  return static_cast<int>(Exit::done);
}

}  // namespace

int run_fit(const Arguments& arguments) {
  const FitWords words = fit_words(arguments);
  refuse_exchanged(words);
  if (!words.table.empty()) return fit_noise(words);
  Progress progress("fit");
  progress.at(0);
  const diagnosis::CellOptions cells{words.cell, words.least,
                                     words.average == "dB" ? diagnosis::Average::dB : diagnosis::Average::power};
  report::FitReport report(words.world, words.data, plugin_path(words.plugins), {words.free, words.fix}, cells,
                           [&](double share) { progress.at(share); });
  if (!words.out.empty()) report.draw(words.out);
  progress.at(1);
  const auto natural = words.log == "natural" ? natural_exponents(report) : std::vector<NaturalExponent>{};
  if (words.json) {
    Json json = report.json();
    for (const auto& n : natural)
      json["natural"].push_back({{"name", n.path},
                                 {"value", n.value},
                                 {"lower95", n.lower95},
                                 {"upper95", n.upper95},
                                 {"reach_of_-60_dbm_m", n.reach},
                                 {"reach_if_taken_for_base_10_m", n.mistaken}});
    fmt::print("{}\n", json.dump(2));
  } else {
    report.print();
    print_natural(natural);
  }
  return static_cast<int>(report.fit().not_identifiable.empty() ? Exit::done : Exit::check_failed);
}

}  // namespace muster::cli
