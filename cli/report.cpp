// muster report DIR -o run.html: a recorded run as one page that needs no network.
#include <fmt/core.h>

#include "installation.hpp"
#include "text/file_kind.hpp"
#include "text/json.hpp"
#include "verbs.hpp"
#include "viewer/page.hpp"
#include "written_files.hpp"

namespace muster::cli {

int run_report(const Arguments& arguments) {
  CommandLine line("report",
                   "Writes the record of a run as one HTML page: the scene in three dimensions, a slider of time, and "
                   "plots of every\n"
                   "recorded column. The page holds all that it needs and loads nothing. docs/how-to/watch_a_run.md "
                   "says what it shows.\n"
                   "Example: muster report out/connectivity -o talk.html\n"
                   "         after: muster run worlds/connectivity --out out/connectivity");
  std::string folder, out;
  uint64_t most = viewer::most_numbers;
  bool json = false;
  line.option("folder", folder, "the folder that `muster run --out` wrote").required();
  line.option("-o,--out", out, "the page to write; run.html in the folder if not given");
  line.option("--most", most, "numbers that the page holds; longer tables are thinned evenly in time")
      .at_least(1)
      .shows_default();
  line.flag("--json", json, "print the outcome as JSON");
  line.parse(arguments);
  if (file_kind_of(folder) == "an MCAP file")
    throw Error(Exit::invalid_input,
                folder + ": is an MCAP file; expected a folder that `muster run WORLD --out DIR` wrote");
  if (out.empty()) out = (std::filesystem::path(folder) / "run.html").string();
  WrittenFiles files;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
    const auto kind = entry.path().extension();
    if (kind == ".json" || kind == ".csv") files.reads(entry.path(), "the record");
  }
  files.writes(out, "--out");
  const viewer::WrittenPage page = viewer::write_page(folder, out, installation().parts, most);
  if (json) {
    fmt::print("{}\n", Json{{"file", out}, {"bytes", page.bytes}, {"notes", page.notes}}.dump(2));
    return 0;
  }
  fmt::print("wrote {}, {:.2f} MB\n", out, static_cast<double>(page.bytes) / 1e6);
  for (const std::string& note : page.notes) fmt::print("  {}\n", note);
  return 0;
}

}  // namespace muster::cli
