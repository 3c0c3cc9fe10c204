// muster log ACTION FILE: what an MCAP file holds; a damaged one made whole; a span of time; its tables as one CSV
// file.
#include <fmt/core.h>

#include "log_contents.hpp"
#include "mcap/rewrite.hpp"
#include "run_log/table_log.hpp"
#include "run_log/wide_table.hpp"
#include "run_options.hpp"
#include "text/number.hpp"
#include "written_files.hpp"

namespace muster::cli {
namespace {

namespace fs = std::filesystem;

struct LogVerbWords {
  std::string action, file, out;
  std::optional<std::string> from, to;
  std::vector<std::string> columns;
  bool json = false;
};

int log_info(const LogVerbWords& words) {
  const LogContents contents = contents_of(words.file);
  if (words.json)
    fmt::print("{}\n", json_of(contents).dump(2));
  else
    print(contents);
  return static_cast<int>(contents.scan.damages.empty() ? Exit::done : Exit::check_failed);
}

// The log's name once it is whole: "run.mcap" of "run.mcap.part".
fs::path whole_name(const LogVerbWords& words) {
  const fs::path file = words.file;
  return file.extension() == ".part" ? fs::path(file).replace_extension() : file;
}

// "run.mcap" of "run.mcap.part", "run_recovered.mcap" of "run.mcap".
fs::path recovered_name(const LogVerbWords& words) {
  if (!words.out.empty()) return words.out;
  const fs::path whole = whole_name(words);
  if (whole == fs::path(words.file)) return fs::path(whole).replace_extension().string() + "_recovered.mcap";
  if (fs::exists(whole))
    throw Error(Exit::invalid_input, whole.string() +
                                         " is there already, which may be an earlier run's log; expected " +
                                         "another file to write: -o FILE");
  return whole;
}

void print_rewritten(const LogVerbWords& words, const mcap::Rewritten& done, const fs::path& out) {
  const auto seconds = [](std::uint64_t time) { return static_cast<double>(time) / 1e9; };
  if (words.json) {
    fmt::print("{}\n", Json{{"file", out.string()},
                            {"bytes", done.bytes},
                            {"messages", done.messages},
                            {"from", seconds(done.first_time)},
                            {"to", seconds(done.last_time)},
                            {"damages", done.scan.damages},
                            {"attachments_left_out", done.scan.attachments}}
                           .dump(2));
    return;
  }
  for (const std::string& damage : done.scan.damages) fmt::print("  {}\n", damage);
  if (done.scan.attachments > 0) fmt::print("  {} attachments are left out\n", done.scan.attachments);
  fmt::print("wrote {}: {} messages, {} s to {} s\n", out.string(), done.messages, print_real(seconds(done.first_time)),
             print_real(seconds(done.last_time)));
}

void check_written(const LogVerbWords& words, const fs::path& out) {
  WrittenFiles files;
  files.reads(words.file, "the log");
  files.writes(out, "--out");
}

int log_recover(const LogVerbWords& words) {
  const fs::path out = recovered_name(words);
  check_written(words, out);
  const auto done = mcap::rewrite(words.file, out, mcap::Damage::skipped);
  print_rewritten(words, done, out);
  return 0;
}

std::uint64_t time_of(const std::optional<std::string>& given, const char* option, std::uint64_t otherwise) {
  if (!given) return otherwise;
  const double time = real_of(*given, option, "s");
  if (!(time >= 0 && time < 1e10))
    throw Error(Exit::invalid_input, std::string(option) + ": " + *given + " s is out of range; expected 0 to 1e10 s");
  return run_log::log_time(time);
}

int log_cut(const LogVerbWords& words) {
  if (words.out.empty()) throw Error(Exit::invalid_input, "cut needs --out, the file to write");
  check_written(words, words.out);
  const mcap::Span span{time_of(words.from, "--from", 0), time_of(words.to, "--to", ~std::uint64_t{0})};
  if (span.first > span.end)
    throw Error(Exit::invalid_input, "--from " + words.from.value_or("0") + " is after --to " + *words.to +
                                         "; expected --from " + *words.to + " --to " + words.from.value_or("0"));
  if (span.first == span.end)
    throw Error(Exit::invalid_input,
                "--from " + words.from.value_or("0") + " is not before --to " + *words.to + ", which is not included");
  const LogContents contents = contents_of(words.file);
  if (contents.messages > 0 && span.first > contents.last_time)
    throw Error(Exit::invalid_input, "--from: " + words.from.value_or("0") + " s is after the end of " + words.file +
                                         " at " + print_real(static_cast<double>(contents.last_time) / 1e9) +
                                         " s; nothing is written");
  print_rewritten(words, mcap::rewrite(words.file, words.out, mcap::Damage::refused, span), words.out);
  return 0;
}

int log_csv(const LogVerbWords& words) {
  const fs::path out = words.out.empty() ? whole_name(words).replace_extension(".csv") : fs::path(words.out);
  check_written(words, out);
  const auto done = run_log::write_wide(words.file, out, words.columns);
  if (words.json) {
    fmt::print(
        "{}\n",
        Json{{"file", out.string()}, {"rows", done.rows}, {"columns", done.columns}, {"replaced", done.replaced}}.dump(
            2));
    return 0;
  }
  fmt::print("wrote {}: {} times, {} columns\n", out.string(), done.rows, done.columns);
  if (done.replaced > 0)
    fmt::print("  {} values are left out, for a later one has the same time and name\n", done.replaced);
  return 0;
}

}  // namespace

int run_log(const Arguments& arguments) {
  CommandLine line("log",
                   "Reads what `muster run --mcap FILE` wrote, or another MCAP file.\n"
                   "  info     its channels, counts, times and sizes; exit code 1 where it is damaged\n"
                   "  recover  a valid file of what is whole in a damaged one, such as run.mcap.part after a crash\n"
                   "  cut      the messages from --from up to --to\n"
                   "  csv      its tables as one: a row a time, a column a number, such as link/base/rover/rssi/rssi\n"
                   "Example: muster log info out/run.mcap\n"
                   "         after: muster run worlds/connectivity --mcap out/run.mcap");
  LogVerbWords words;
  line.option("action", words.action, "what to do").required().one_of({"info", "recover", "cut", "csv"});
  line.option("file", words.file, "the MCAP file").required();
  line.option("-o,--out", words.out, "the file to write; cut needs it");
  line.option("--from", words.from, "start of the cut in seconds, included");
  line.option("--to", words.to, "end of the cut in seconds, not included");
  line.option("--column", words.columns, "csv: a table or column with a star for any names, such as 'link/*/rssi'")
      .one_word_each();
  line.flag("--json", words.json, "print the outcome as JSON");
  line.parse(arguments);
  const bool cuts = words.action == "cut";
  if (!cuts && (words.from || words.to))
    throw Error(Exit::invalid_input,
                "--from and --to are of cut, not of " + words.action + "; expected first muster log cut " + words.file +
                    (words.from ? " --from " + *words.from : "") + (words.to ? " --to " + *words.to : "") +
                    " -o part.mcap, then muster log " + words.action + " part.mcap");
  if (words.action != "csv" && !words.columns.empty())
    throw Error(Exit::invalid_input, "--column is of csv, not of " + words.action);
  if (words.action == "info" && !words.out.empty())
    throw Error(Exit::invalid_input,
                "--out is of recover, cut and csv; info writes no file; expected no --out, or info > " + words.out);
  if (words.action == "info") return log_info(words);
  if (words.action == "recover") return log_recover(words);
  return cuts ? log_cut(words) : log_csv(words);
}

}  // namespace muster::cli
