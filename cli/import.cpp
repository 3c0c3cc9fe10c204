// muster import FILE... --map MAP --out FILE: foreign tables in the project's format, and what was assumed on the way.
#include <fmt/core.h>

#include "diagnosis/data/table_import.hpp"
#include "text/json.hpp"
#include "verbs.hpp"
#include "written_files.hpp"

namespace muster::cli {

int run_import(const Arguments& arguments) {
  CommandLine line(
      "import",
      "Brings foreign tables of readings into the format of measured data, as a map file says, checks the result, and "
      "prints what was\n"
      "assumed. docs/how-to/import_a_table.md describes map files.\n"
      "Example: muster import calibration.csv --map calibration.map --out measured.csv\n"
      "         muster import run_*.csv --map runs.map --out measured.csv");
  std::string map, out;
  std::vector<std::string> files;
  bool json = false;
  line.option("file", files, "a foreign table, or several: cells between ',', ';', tabs or blanks").required();
  line.option("--map", map, "how its columns become ours").required();
  line.option("--out", out, "the table to write").required();
  line.flag("--json", json, "print the outcome as JSON");
  line.parse(arguments);
  WrittenFiles checked;
  for (const std::string& file : files) checked.reads(file, "file");
  checked.reads(map, "--map");
  checked.writes(out, "--out");
  const diagnosis::Imported done = diagnosis::import_table({files.begin(), files.end()}, map, out);
  if (json) {
    fmt::print(
        "{}\n",
        Json{{"file", out}, {"rows", done.rows}, {"not_received", done.empty}, {"assumed", done.assumed}}.dump(2));
    return 0;
  }
  fmt::print("{}: {} readings, {} of them not received. Assumed:\n", out, done.rows, done.empty);
  for (const std::string& words : done.assumed) fmt::print("  - {}\n", words);
  return 0;
}

}  // namespace muster::cli
