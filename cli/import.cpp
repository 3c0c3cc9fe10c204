// muster import FILE --map MAP --out FILE: a foreign table in the project's format, and what was assumed on the way.
#include <fmt/core.h>

#include "diagnosis/data/table_import.hpp"
#include "text/json.hpp"
#include "verbs.hpp"

namespace muster::cli {

int run_import(const Arguments& arguments) {
  CommandLine line(
      "import",
      "Brings a foreign table of readings into the format of measured data, as a map file says, checks it, and prints "
      "what was\n"
      "assumed. docs/how-to/import_a_table.md describes map files.\n"
      "Example: muster import calibration.csv --map calibration.map --out measured.csv");
  std::string file, map, out;
  bool json = false;
  line.option("file", file, "the foreign table: cells between ',', ';' or tabs").required();
  line.option("--map", map, "how its columns become ours").required();
  line.option("--out", out, "the table to write").required();
  line.flag("--json", json, "print the outcome as JSON");
  line.parse(arguments);
  const diagnosis::Imported done = diagnosis::import_table(file, map, out);
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
