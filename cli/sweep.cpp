// muster sweep FILE: the runs of a plan, shared by processes of this and other machines through one table, and what
// came of them.
#include <fmt/core.h>

#include <utility>

#include "installation.hpp"
#include "run_options.hpp"
#include "shell_word.hpp"
#include "sweep/job_table.hpp"
#include "sweep/summary.hpp"
#include "sweep_runs.hpp"
#include "sweep_sources.hpp"
#include "sweep_workers.hpp"
#include "text/names.hpp"
#include "text/number.hpp"
#include "written_files.hpp"

namespace muster::cli {
namespace {

namespace fs = std::filesystem;

constexpr int most_shares = 100'000;  // Slurm's arrays have fewer

struct SweepWords {
  std::string file, out;
  std::vector<std::string> plugins;
  int jobs = 1, workers = 1, slurm = 0, parallel = 0;
  std::optional<std::string> index, of;
  bool json = false;
};

int count_of(const std::string& text, const char* option) {
  const auto value = parse_integer(text);
  if (!value || *value < 1 || *value > most_shares)
    throw Error(Exit::invalid_input,
                fmt::format("{}: {} is no share; expected an integer from 1 to {}", option, quote(text), most_shares));
  return static_cast<int>(*value);
}

std::optional<sweep::Share> share_of(const SweepWords& words) {
  if (!words.index && !words.of) return {};
  if (!words.index || !words.of)
    throw Error(Exit::invalid_input, "--index and --of belong together: the share, from 1, and how many there are");
  const int of = count_of(*words.of, "--of");
  const auto index = parse_integer(*words.index);
  if (!index || *index < 1)
    throw Error(Exit::invalid_input,
                fmt::format("--index: {} is no share; expected an integer from 1 to {}{}", quote(*words.index), of,
                            index && *index == 0 ? ": shares count from 1 (of an array of Slurm from 0: --index "
                                                   "$((SLURM_ARRAY_TASK_ID + 1)))"
                                                 : ""));
  const sweep::Share result{count_of(*words.index, "--index"), of};
  if (result.index > result.of)
    throw Error(Exit::invalid_input, fmt::format("--index: there is no share {} of {}; expected one from 1 to {}",
                                                 result.index, result.of, result.of));
  return result;
}

std::string absolute(const std::string& path) { return fs::weakly_canonical(fs::absolute(path)).string(); }

// The command of one share, from any folder.
std::string command(const SweepWords& words, const std::string& index, int of) {
  std::string result = shell_word(fs::read_symlink("/proc/self/exe").string()) + " sweep " +
                       shell_word(absolute(words.file)) + " --out " + shell_word(absolute(words.out));
  for (const std::string& folder : words.plugins) result += " --plugins " + shell_word(absolute(folder));
  if (words.jobs != 1) result += fmt::format(" --jobs {}", words.jobs);
  if (words.workers != 1) result += fmt::format(" --workers {}", words.workers);
  return result + fmt::format(" --index {} --of {}", index, of);
}

void print_slurm(const SweepWords& words, const sweep::SweepFile& file) {
  fmt::print(
      "#!/bin/sh\n#SBATCH --job-name={}\n#SBATCH --array=1-{}\n#SBATCH --cpus-per-task={}\n#SBATCH --requeue\n"
      "exec {}\n",
      shell_word("sweep_" + file.name()), words.slurm, words.jobs * words.workers,
      command(words, "\"$SLURM_ARRAY_TASK_ID\"", words.slurm));
}

void print_parallel(const SweepWords& words) {
  for (int i = 1; i <= words.parallel; ++i) fmt::print("{}\n", command(words, std::to_string(i), words.parallel));
}

class Sweep {
 public:
  Sweep(const SweepWords& words, const sweep::SweepFile& file)
      : words_(words), file_(file), share_(share_of(words)), plugins_(plugin_path(words.plugins)) {}

  Exit run() {
    watch_interrupt();
    if (const Exit prepared = in_processes(1, [&] { return prepare(); }); prepared != Exit::done) return prepared;
    if (!fs::exists(fs::path(words_.out) / sweep::JobTable::file_name) || !sweep::JobTable(words_.out).is_filled())
      throw Error(Exit::plugin_fault, words_.file + ": a combination could not be made");  // its process crashed
    const sweep::Share share = share_.value_or(sweep::Share{});
    sweep::Counts counts = counts_of(share);
    before_ = counts.done;
    Exit worked = Exit::done;
    while (counts.done < counts.all && worked == Exit::done && !interrupted()) {
      worked =
          work_in_processes(share, static_cast<int>(std::min<std::int64_t>(words_.jobs, counts.all - counts.done)));
      // A run that crashes ends its worker: others are begun for those that were not touched, as long as that helps.
      const auto untouched = std::exchange(counts, counts_of(share)).untouched;
      if (counts.untouched == 0 || counts.untouched == untouched) break;
    }
    sweep::JobTable table(words_.out);
    if (interrupted()) {
      tell_rest(table);
      return Exit::interrupted;
    }
    if (worked != Exit::done) return worked;
    return finish(table, share);
  }

 private:
  // In a process of its own: it loads plugins, and makes threads.
  Exit prepare() {
    SweepRuns runs(file_, plugins_, words_.workers);
    std::optional<SweepRuns::Checked> checked;
    if (!fs::exists(fs::path(words_.out) / sweep::JobTable::file_name)) checked = runs.check();  // or make no folder
    sweep::JobTable table(words_.out);
    if (!table.is_filled()) {
      if (!checked) checked = runs.check();
      table.fill(sources_of(file_, *checked, plugins_), checked->metrics, file_.combinations(), file_.seeds);
    }
    // Of what was filled before, or by another meanwhile.
    expect_unchanged(table.sources(), file_, plugins_, words_.out);
    return Exit::done;
  }

  // By a connection that is closed before the next fork: it is its process's own.
  sweep::Counts counts_of(const sweep::Share& share) const { return sweep::JobTable(words_.out).counts(share); }

  Exit work(const sweep::Share& share) {
    sweep::JobTable table(words_.out);
    SweepRuns runs(file_, plugins_, words_.workers);
    while (!interrupted()) {
      const auto job = table.claim(share);
      if (!job) break;
      const auto result = runs.run(*job);
      result ? table.record(*job, *result) : table.release(*job);
    }
    return interrupted() ? Exit::interrupted : Exit::done;
  }

  Exit work_in_processes(const sweep::Share& share, int count) {
    return work_on_table(words_.out, share, count, "muster sweep " + file_.name(), "runs", [&] { return work(share); });
  }

  // What was begun and not ended: by workers that still run elsewhere, or that were killed.
  static void tell_rest(sweep::JobTable& table) {
    const auto counts = table.counts();
    fmt::print(stderr, "muster: note: {} of {} runs are done; the same command goes on with the others\n", counts.done,
               counts.all);
    for (const sweep::Job& job : table.left())
      fmt::print(stderr, "muster: note: seed {} of combination {} was left by a worker that is no more\n", job.seed,
                 job.combination + 1);
  }

  Exit finish(sweep::JobTable& table, const sweep::Share& share) {
    const auto own = table.counts(share), all = table.counts();
    if (own.done < own.all) {
      tell_rest(table);
      return Exit::check_failed;
    }
    std::vector<fs::path> files;
    sweep::Summary summary;
    std::vector<sweep::DoneJob> runs;
    if (all.done == all.all) {
      // Two shares may end at once.
      table.exclusively([&] {
        runs = table.done();
        summary = sweep::summary_of(file_, table.metrics(), runs);
        files = write_summary(summary, file_, runs, words_.out);
      });
    }
    if (share_ && !words_.json)
      fmt::print("share {} of {}: {} runs, all done; {} of {} in all\n", share.index, share.of, own.all, all.done,
                 all.all);
    if (!share_ || words_.json) print(summary, all, files);
    for (const sweep::DoneJob& run : runs) {
      if (run.fault.empty()) continue;
      fmt::print(stderr, "muster: warning: {} of {} runs failed; the first, seed {} of combination {}: {}\n",
                 all.failed, all.all, run.seed, run.combination + 1, run.fault);
      break;
    }
    return own.failed > 0 ? Exit::plugin_fault : Exit::done;
  }

  // As JSON it is the same each time.
  void print(const sweep::Summary& summary, const sweep::Counts& all, const std::vector<fs::path>& files) const {
    if (words_.json) {
      Json json{{"sweep", file_.name()},
                {"runs", all.all},
                {"done", all.done},
                {"failed", all.failed},
                {"combinations", json_of(summary)},
                {"files", Json::array()}};
      for (const fs::path& file : files) json["files"].push_back(file.string());
      fmt::print("{}\n", json.dump(2));
      return;
    }
    const std::size_t seeds = file_.seeds.size();
    fmt::print("{}: {} combinations of {} seed{}, {} runs, {} of them done before\n\n{}", file_.name(),
               file_.combinations(), seeds, seeds == 1 ? "" : "s", all.all, before_, text_of(summary));
    for (const fs::path& file : files) fmt::print("  wrote {}\n", file.string());
  }

  const SweepWords& words_;
  const sweep::SweepFile& file_;
  std::optional<sweep::Share> share_;
  Library::SearchPath plugins_;
  std::int64_t before_ = 0;
};

// One seed above 1 may be meant as the number of seeds.
void note_single_seed(const sweep::SweepFile& file) {
  constexpr std::int64_t most = 1000;  // of seeds that are meant as a number
  if (file.seeds.size() != 1 || file.seeds[0] < 2 || file.seeds[0] > most) return;
  fmt::print(stderr,
             "muster: note: {}: seeds=\"{}\" is one seed, the number {}, so that there are no intervals; "
             "expected seeds=\"1..{}\" for {} seeds\n",
             file.seeds_place.text(), file.seeds[0], file.seeds[0], file.seeds[0], file.seeds[0]);
}

}  // namespace

int run_sweep(const Arguments& arguments) {
  CommandLine line(
      "sweep",
      "Runs a world with every combination of the values in a file, each with the same seeds, and says what came of "
      "it:\n"
      "means with their intervals, and differences from the first combination, seed by seed. A run is done once, also\n"
      "where the command was killed and is given again, and where several commands share the runs.\n"
      "Example: muster sweep docs/samples/sweep/routing.xml --out out/routing --jobs 2");
  SweepWords words;
  line.option("file", words.file, "the sweep, an XML file").required();
  line.option("--out", words.out, "folder for the table of runs (SQLite), the summary and its picture").required();
  line.option("--jobs", words.jobs, "runs at a time, each in a process").within(1, 256);
  line.option("--workers", words.workers, "threads of a run; the results do not depend on it").within(1, 256);
  line.option("--plugins", words.plugins, "a folder of plugins, looked in first").one_word_each();
  line.option("--index", words.index, "with --of: which share of the runs to do, from 1");
  line.option("--of", words.of, "how many shares there are");
  line.option("--slurm", words.slurm, "run nothing: print a script for sbatch, an array of so many shares")
      .within(1, most_shares)
      .excludes("--index")
      .excludes("--of");
  line.option("--parallel", words.parallel, "run nothing: print so many commands, a share each, for GNU parallel")
      .within(1, most_shares)
      .excludes("--index")
      .excludes("--of")
      .excludes("--slurm");
  line.flag("--json", words.json, "print the outcome as JSON");
  line.void_beside("--slurm", {"--json"}, "prints a script");
  line.void_beside("--parallel", {"--json"}, "prints commands");
  line.parse(arguments);
  const sweep::SweepFile file = sweep::read_sweep(words.file);
  note_single_seed(file);
  WrittenFiles::writes_folder(words.out, "--out");
  if (words.slurm > 0) return print_slurm(words, file), 0;
  if (words.parallel > 0) return print_parallel(words), 0;
  return static_cast<int>(Sweep(words, file).run());
}

}  // namespace muster::cli
