#include "cli/run_log_files.hpp"

#include <algorithm>
#include <cctype>

#include "kernel/occasions.hpp"
#include "plotting/figure.hpp"
#include "run_log/wide_table.hpp"
#include "text/names.hpp"
#include "verbs.hpp"

namespace muster::cli {
namespace {

namespace fs = std::filesystem;
constexpr std::size_t most_labels = 12;  // lines of a plot that are named

struct PlottedColumn {
  std::string table, column;
};

// Of a standard table; "COLUMN" of another.
std::string first_column(const std::string& table) {
  for (const auto& set : standard().sets) {
    for (const auto& quantity : set.quantities) {
      if (table.starts_with(set.name + std::string("/")) && table.ends_with(std::string("/") + quantity.name))
        return std::string(quantity.columns).substr(0, std::string(quantity.columns).find_first_of("[ :?{"));
    }
  }
  return "COLUMN";
}

// "robot/rover/pose/x" of "robot/rover/x": with the first quantity of the set that has such a column; "" where none
// has.
std::string with_quantity(const std::string& word) {
  const auto first = word.find('/'), last = word.rfind('/');
  const std::string column = word.substr(last + 1);
  for (const auto& set : standard().sets) {
    if (first == last || word.substr(0, first) != set.name) continue;
    for (const auto& quantity : set.quantities) {
      if (quantity.name == column) return "";
    }
    for (const auto& quantity : set.quantities) {
      if ((' ' + std::string(quantity.columns)).find(' ' + column + '[') != std::string::npos)
        return word.substr(0, last) + '/' + quantity.name + '/' + column;
    }
  }
  return "";
}

PlottedColumn plotted(const std::string& word) {
  const auto slash = word.rfind('/');
  if (slash == word.npos || slash == 0 || slash + 1 == word.size())
    throw Error(Exit::invalid_input,
                "--plot " + quote(word) + ": expected a table and its column, such as 'robot/*/pose/x'");
  if (std::count(word.begin(), word.end(), '/') < 3) {
    if (const std::string meant = with_quantity(word); !meant.empty())
      throw Error(Exit::invalid_input, "--plot " + quote(word) + ": " + quote(word.substr(slash + 1)) +
                                           " is a column and no table; expected " + quote(meant));
    throw Error(Exit::invalid_input, "--plot " + quote(word) + " has no column; expected one of the table's, such as " +
                                         quote(word + '/' + first_column(word)));
  }
  return {word.substr(0, slash), word.substr(slash + 1)};
}

void check_plot(const Simulation& run, const std::string& word) {
  const auto [name, column] = plotted(word);
  const Columns& columns = [&]() -> const Columns& {
    try {
      return run.table(name).table->columns();
    } catch (const Error& e) {
      throw Error(e.exit(), "--plot: " + std::string(e.what()));
    }
  }();
  std::vector<std::string> known;
  for (const Column& one : columns) {
    if (one.reference.empty() && !one.bytes) known.push_back(one.name);
  }
  if (std::find(known.begin(), known.end(), column) != known.end()) return;
  throw Error(Exit::invalid_input, "--plot: the table " + quote(name) + " has no column " + quote(column) +
                                       " of numbers; " + suggest(column, known) +
                                       column_elsewhere(run.board(), *run.table(name).table, column));
}

// "leader" of "robot/leader/pose", where the table is "robot/*/pose".
std::string names_in(const std::string& name, const std::string& table) {
  const auto star = table.find('*');
  if (star == std::string::npos || name.size() < table.size()) return name;
  return name.substr(star, name.size() - (table.size() - 1));
}

// "plot_robot_pose_x" of "robot/*/pose/x"
std::string picture_name(const std::string& word) {
  std::string name = "plot_";
  for (const char c : word) {
    if (std::isalnum(static_cast<unsigned char>(c)) || c == '.' || c == '-')
      name += c;
    else if (name.back() != '_')
      name += '_';
  }
  return name;
}

fs::path draw(const Simulation& run, const fs::path& log, const std::string& word, const fs::path& out) {
  const auto [table, column] = plotted(word);
  const auto series = run_log::series_of(log, table, column);
  plotting::Panel panel{.x = {.label = "time", .unit = "s"},
                        .y = {.label = table + '/' + column, .unit = series.empty() ? "" : series[0].unit},
                        .legend = true};
  for (const run_log::Series& one : series)
    panel.layers.push_back(
        plotting::Line{.x = one.times,
                       .y = one.values,
                       .label = series.size() > 1 && series.size() <= most_labels ? names_in(one.name, table) : ""});
  fs::path file = out / (picture_name(word) + ".svg");
  try {
    plotting::save({.title = run.world().name, .width = 900, .panels = {panel}}, file);
  } catch (const std::runtime_error& e) {
    throw Error(Exit::io, e.what());
  }
  return file;
}

fs::path in_its_folder(const fs::path& file) {
  std::error_code failed;
  if (file.has_parent_path()) fs::create_directories(file.parent_path(), failed);
  if (failed) throw Error(Exit::io, Place{file.parent_path().string()}, "cannot be made: " + failed.message());
  return file;
}

}  // namespace

void declare(CommandLine& line, LogWords& words) {
  line.option("--mcap", words.mcap, "write the run as an MCAP file, for Foxglove, PlotJuggler, ROS 2 and `muster log`");
  line.option("--wide", words.wide, "write the recorded tables as one CSV file: a row a time, a column a number");
  line.option("--plot", words.plot, "TABLE/COLUMN: draw it over time into --out, such as 'robot/*/pose/x'")
      .one_word_each();
}

void add_plotted(const LogWords& words, const std::string& out, std::vector<RecordDeclaration>& records) {
  if (!words.plot.empty() && out.empty())
    throw Error(Exit::invalid_input, "--plot needs --out, the folder to draw into");
  for (const std::string& word : words.plot) {
    const std::string table = plotted(word).table;
    const bool is_there =
        std::any_of(records.begin(), records.end(), [&](const auto& record) { return record.table == table; });
    if (!is_there) records.push_back({table, 1, {"--plot"}});
  }
}

RunLogFiles::RunLogFiles(const Simulation& run, const std::vector<RecordDeclaration>& records, const LogWords& words,
                         const fs::path& out)
    : words_(words), out_(out) {
  for (const std::string& word : words.plot) check_plot(run, word);
  if (words.mcap.empty()) temporary_.emplace();
  const fs::path file = temporary_ ? temporary_->path() / "run.mcap" : in_its_folder(words.mcap);
  log_ = std::make_unique<run_log::RunLog>(run, records, file, MUSTER_VERSION);
}

std::vector<fs::path> RunLogFiles::close(const Simulation& run) {
  std::vector<fs::path> files;
  log_->close(run);
  if (!temporary_) files.push_back(log_->file());
  if (!words_.wide.empty()) {
    const auto wide = run_log::write_wide(log_->file(), in_its_folder(words_.wide), {});
    files.emplace_back(words_.wide);
    if (wide.replaced > 0)
      notes_.push_back(words_.wide + ": " + std::to_string(wide.replaced) +
                       " values are left out, for a later one has the same time and name");
  }
  for (const std::string& word : words_.plot) files.push_back(draw(run, log_->file(), word, out_));
  return files;
}

}  // namespace muster::cli
