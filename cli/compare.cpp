// muster compare WORLD ...: a world against itself with an instance exchanged, or against other worlds, in step.
#include <fmt/core.h>

#include <algorithm>

#include "compare_pictures.hpp"
#include "compare_report.hpp"
#include "divergence_file.hpp"
#include "exchange.hpp"
#include "ladder_run.hpp"
#include "run_options.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace muster::cli {
namespace {

constexpr std::size_t most_runs = 26;  // labels are letters
constexpr uint64_t most_spans = 400;   // moments in the file and the picture

struct CompareWords : LadderWords {
  std::vector<std::string> others, within;
  bool ladder = false;
};

// Nothing where the word is a world's path.
std::optional<Exchange> exchange_in(const std::string& word) {
  const auto equals = word.find('='), colon = word.find(':');
  if (std::filesystem::exists(word)) return {};
  if (equals == std::string::npos && colon != std::string::npos && colon > 0)
    throw Error(Exit::invalid_input, "muster compare: " + quote(word) + " is no world; expected INSTANCE=PLUGIN, " +
                                         word.substr(0, colon) + '=' + word.substr(colon + 1));
  if (equals == std::string::npos) return {};
  Exchange result = exchange_of(word.substr(0, equals), word.substr(equals + 1));
  if (result.instance.empty() || result.plugin.empty())
    throw Error(Exit::invalid_input,
                "muster compare: " + quote(word) + " is neither a world nor INSTANCE=PLUGIN[:NAME=VALUE...]");
  return result;
}

Tolerances tolerances_of(const std::vector<std::string>& words) {
  Tolerances result;
  for (const auto& word : words) {
    const auto equals = word.rfind('=');
    if (equals == std::string::npos)
      throw Error(Exit::invalid_input,
                  "--within " + quote(word) + ": expected QUANTITY=TOLERANCE, such as pose/distance=0.05");
    const std::string option = "--within " + word.substr(0, equals + 1);
    const double tolerance =
        real_of(word.substr(equals + 1), option.c_str(), word.substr(0, equals).ends_with("distance") ? "m" : "");
    if (tolerance < 0) throw Error(Exit::invalid_input, "--within " + quote(word) + ": expected a tolerance from 0");
    result[word.substr(0, equals)] = tolerance;
  }
  return result;
}

class Comparison {
 public:
  explicit Comparison(const CompareWords& words) : words_(words) {
    if (words.others.empty())
      throw Error(Exit::invalid_input,
                  "muster compare: there is nothing to compare with; expected INSTANCE=PLUGIN or a second world");
    if (words.others.size() >= most_runs) throw Error(Exit::invalid_input, "muster compare: more than 26 runs");
    const bool all_given = std::all_of(words.others.begin(), words.others.end(),
                                       [](const auto& word) { return exchange_in(word).has_value(); });
    add(world_of(words.world, words), all_given ? "as given" : words.world);
    for (const auto& word : words.others) add_other(word);
    if (runs_.size() < 2) throw Error(*refused_);
    begin();
  }

  void run() {
    Progress progress("muster compare " + runs_[0].run->world().name);
    watch_interrupt();
    const auto goes_on = [](const ComparedRun& r) { return r.goes_on(); };
    while (std::any_of(runs_.begin(), runs_.end(), goes_on) && !interrupted()) {
      for (auto& r : runs_) {
        if (r.goes_on()) r.step();
      }
      ++tick_;
      look();
      progress.at(static_cast<double>(tick_) / static_cast<double>(longest_));
    }
    finish();
  }

  Exit report() const {
    if (words_.json)
      fmt::print("{}\n", comparison_json(runs_, not_run_).dump(2));
    else
      print_comparison(runs_, not_run_);
    std::fflush(stdout);
    for (const auto& r : runs_) r.run->close();
    if (interrupted()) return Exit::interrupted;
    for (const auto& r : runs_) {
      if (r.fault) throw Error(*r.fault);
    }
    if (refused_) throw Error(refused_->exit(), not_run_.front() + " could not be run");
    const bool within = std::all_of(runs_.begin(), runs_.end(),
                                    [](const ComparedRun& r) { return !r.divergence || r.divergence->within(); });
    return within ? Exit::done : Exit::check_failed;
  }

 private:
  void add(World world, std::string what) {
    const std::string label(1, static_cast<char>('A' + runs_.size()));
    auto run = std::make_unique<Simulation>(std::move(world), standard(),
                                            Options{plugin_path(words_.plugins), words_.workers, {}});
    set_parameters(*run, words_.set);
    runs_.push_back({label, std::move(what), std::move(run)});
  }

  // What cannot be run is told in the end; the others go on.
  void add_other(const std::string& word) {
    const auto wanted = exchange_in(word);
    if (!wanted) refuse_plugin(word);
    if (wanted) refuse_comma(*wanted);
    if (wanted) refuse_attribute(*wanted, word);
    World world = world_of(wanted ? words_.world : word, words_);
    if (wanted) exchange(world, *wanted, instance_names(*runs_[0].run), "muster compare");
    if (world.dt != runs_[0].run->world().dt)
      throw Error(Exit::invalid_input, word + ": ticks of " + print_real(world.dt) + " s against " +
                                           print_real(runs_[0].run->world().dt) +
                                           " s, so that no tick has one beside it; expected dt=\"" +
                                           print_real(runs_[0].run->world().dt) + "\" in both worlds");
    try {
      add(std::move(world), word);
    } catch (const Error& e) {
      if (words_.others.size() > 1) fmt::print(stderr, "muster: note: {} cannot be run: {}\n", word, e.what());
      if (!refused_) refused_ = e;
      not_run_.push_back(word);
    }
  }

  // A plugin or an instance in the place of a world: INSTANCE= is missing before it, or =PLUGIN behind it.
  void refuse_plugin(const std::string& word) const {
    if (std::filesystem::exists(word) || word.find('/') != word.npos || word.ends_with(".xml")) return;
    const auto dot = word.find('.');
    const std::string kind = word.substr(0, dot), start = quote(word) + " is no world; expected ";
    for (const InstanceDeclaration& instance : runs_[0].run->world().instances) {
      if (dot == word.npos && instance.name != word) continue;
      if (dot != word.npos && instance.plugin.substr(0, instance.plugin.find('.')) != kind) continue;
      throw Error(Exit::invalid_input,
                  "muster compare: " + start +
                      (dot == word.npos ? word + "=PLUGIN, the plugin that takes its place"
                                        : "INSTANCE=PLUGIN, such as " + instance.name + '=' + word));
    }
  }

  // "physics=physics.planar,acceleration=4": a colon is meant.
  static void refuse_comma(const Exchange& wanted) {
    const std::string& plugin = wanted.plugin;
    const auto comma = plugin.find(',');
    if (comma == plugin.npos) return;
    std::string meant = plugin;
    std::replace(meant.begin(), meant.end(), ',', ':');
    throw Error(Exit::invalid_input, "muster compare: " + quote(plugin) + " is no plugin; did you mean " +
                                         wanted.instance + '=' + meant +
                                         "? attributes follow their plugin behind a colon");
  }

  // "step=0.002" behind "physics=physics.ode": an attribute follows its plugin behind a colon.
  void refuse_attribute(const Exchange& wanted, const std::string& word) const {
    const auto names = instance_names(*runs_[0].run);
    if (std::find(names.begin(), names.end(), wanted.instance) != names.end()) return;
    const auto here = std::find(words_.others.begin(), words_.others.end(), word);
    if (here == words_.others.begin() || here == words_.others.end() || !exchange_in(*std::prev(here))) return;
    throw Error(Exit::invalid_input, "muster compare: no instance is called " + quote(wanted.instance) +
                                         "; did you mean " + *std::prev(here) + ':' + word +
                                         "? attributes follow their plugin behind a colon");
  }

  void begin() {
    for (const auto& r : runs_) longest_ = std::max(longest_, r.run->world().ticks);
    span_ = std::max<uint64_t>(1, (longest_ + most_spans - 1) / most_spans);
    const auto tolerances = tolerances_of(words_.within);
    for (std::size_t i = 1; i < runs_.size(); ++i) runs_[i].divergence.emplace(tolerances, span_);
    const std::filesystem::path folder = words_.out;
    for (std::size_t i = 0; i < runs_.size() && !words_.out.empty(); ++i) runs_[i].write_to(folder / runs_[i].label);
    if (!words_.out.empty()) file_.emplace(folder / "divergence.csv");
    look();
  }

  // A tick that both runs have.
  void look() {
    const bool is_moment = tick_ % span_ == 0;
    for (auto& r : runs_) {
      if (r.run->tick() != tick_) continue;
      if (r.divergence && runs_[0].run->tick() == tick_) {
        r.divergence->look(*runs_[0].run, *r.run);
        if (file_ && is_moment) file_->write(r.label, r.run->time(), *r.divergence);
      }
      if (file_ && is_moment) r.look_at_robots();
    }
  }

  void finish() {
    for (auto& r : runs_) r.finish();
    if (!file_) return;
    file_->close();
    const std::filesystem::path folder = words_.out;
    runs_.back().files.push_back(folder / "divergence.csv");
    const auto figure = comparison_figure(runs_);
    if (figure.panels.empty()) return;
    try {
      save(figure, folder / "divergence.svg");
    } catch (const std::runtime_error& e) {
      throw Error(Exit::io, e.what());
    }
    runs_.back().files.push_back(folder / "divergence.svg");
  }

  const CompareWords& words_;
  std::vector<ComparedRun> runs_;
  std::optional<Error> refused_;  // the first that was
  std::vector<std::string> not_run_;
  std::optional<DivergenceFile> file_;
  uint64_t tick_ = 0, longest_ = 0, span_ = 1;
};

}  // namespace

int run_compare(const Arguments& arguments) {
  CommandLine line(
      "compare",
      "Runs a world as it is given and with an instance exchanged, or several worlds, with the same random numbers,\n"
      "and says what differs: where first, by how much, since when. With --ladder, runs it on channels from perfect "
      "to\n"
      "contended, and says what came of its mission on each.\n"
      "Example: muster compare worlds/square_path physics=physics.planar physics=physics.simbody:integrator=rk3 "
      "--out out");
  CompareWords words;
  line.option("world", words.world, "the world's folder or file").required();
  line.option("other", words.others,
              "INSTANCE=PLUGIN[:NAME=VALUE...], the world with this instance exchanged, or another world");
  declare(line, words);
  line.option("--within", words.within,
              "QUANTITY=TOLERANCE, such as pose/distance=0.05: exit code 1 where a difference is larger")
      .one_word_each();
  line.flag("--ladder", words.ladder, "run the world on each rung of the fidelity ladder instead");
  line.option("--metric", words.metrics,
              "TABLE/COLUMN, such as robot/leader/pose/x: what the ladder shows in place of moved and delivered")
      .one_word_each();
  line.option("--measured", words.measured, "a log of poses (docs/reference/table_format.md): the ladder's last body");
  line.only_with("--measured", "--ladder");
  line.only_with("--metric", "--ladder");
  line.parse(arguments);
  if (words.ladder && !(words.others.empty() && words.within.empty() && words.record.empty()))
    throw Error(Exit::invalid_input,
                "muster compare --ladder: takes the world alone, as its rungs are what is compared; "
                "expected no " +
                    (!words.others.empty()   ? words.others[0]
                     : !words.within.empty() ? "--within"
                                             : std::string("--record")));
  if (words.ladder) return static_cast<int>(run_ladder(words));
  Comparison comparison(words);
  comparison.run();
  return static_cast<int>(comparison.report());
}

}  // namespace muster::cli
