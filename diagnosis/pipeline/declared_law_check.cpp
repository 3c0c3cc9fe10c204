#include "diagnosis/pipeline/declared_law_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include "diagnosis/radio/laws/reading_law.hpp"
#include "diagnosis/radio/links/link_model.hpp"
#include "diagnosis/radio/thresholds.hpp"
#include "text/names.hpp"
#include "text/number.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

constexpr BinGrid fine{-400, 0.005, 120000};  // dB; to +200

// Probabilities of a law on the fine grid, and of its atoms.
struct Distribution {
  std::vector<double> bins;
  std::vector<Atom> atoms;
  double mass = 0, mean = 0, variance = 0;

  Distribution(const ReadingLaw& law, const std::vector<double>& params, uint32_t draws)
      : bins(law.densities(params, draws, fine)), atoms(law.atoms(params)) {
    double first = 0, second = 0;
    const auto add = [&](double db, double probability) {
      mass += probability;
      first += probability * db;
      second += probability * db * db;
    };
    for (std::size_t i = 0; i < bins.size(); ++i) add(fine.centre(i), bins[i] *= fine.width);
    for (const Atom& atom : atoms) add(atom.db, atom.probability);
    mean = first / mass;
    variance = second / mass - mean * mean;
  }

  // Leaves out the atoms at 0 dB, and returns their probability.
  double without_zero() {
    double zero = 0;
    for (const Atom& atom : atoms) zero += atom.db == 0 ? atom.probability : 0;
    std::erase_if(atoms, [](const Atom& atom) { return atom.db == 0; });
    for (double& v : bins) v /= 1 - zero;
    for (Atom& atom : atoms) atom.probability /= 1 - zero;
    return zero;
  }

  // Kolmogorov's distance to a sample, away from the steps of atoms.
  double distance(std::vector<double> sample) const {
    std::sort(sample.begin(), sample.end());
    const auto count = static_cast<double>(sample.size());
    const auto share_below = [&](double db) {
      return static_cast<double>(std::lower_bound(sample.begin(), sample.end(), db) - sample.begin()) / count;
    };
    double most = 0, below = 0;
    for (std::size_t i = 0; i < bins.size(); ++i) {
      below += bins[i];
      const double db = fine.centre(i) + fine.width / 2;
      double of_atoms = 0;
      bool near = false;
      for (const Atom& atom : atoms) {
        of_atoms += atom.db < db ? atom.probability : 0;
        near = near || std::abs(atom.db - db) < 2 * fine.width;
      }
      if (!near) most = std::max(most, std::abs(share_below(db) - below - of_atoms));
    }
    return most;
  }
};

// Settings at which a diagnosis evaluates the law: strengths of its grid, or over its bounds, and all forms.
std::vector<std::vector<double>> settings_of(const ReadingLaw& law) {
  const muster_law& declared = law.declared();
  std::vector<double> strengths(declared.grid, declared.grid + declared.grid_count);
  constexpr int steps = 9;
  if (strengths.empty()) {
    const muster_param& p = law.strength();
    for (int k = 0; k < steps; ++k) {
      const double share = (k + 0.5) / steps;
      strengths.push_back(p.flags & MUSTER_LOG ? p.min * std::pow(p.max / p.min, share)
                                               : p.min + share * (p.max - p.min));
    }
  }
  std::vector<std::vector<double>> result;
  for (const double strength : strengths) {
    const auto params = law.at_strength(law.defaults(), strength);
    if (!declared.form) result.push_back(params);
    for (uint32_t k = 0; k < declared.form_count; ++k) result.push_back(law.at_form(params, declared.forms[k]));
  }
  return result;
}

// The cause's instance, in a world that clips nothing.
class Executed {
 public:
  Executed(const Cause& cause, const std::filesystem::path& world, const Library::SearchPath& plugins)
      : model_(world, world / "measured.csv", plugins), cause_(cause) {
    for (const auto& instance : model_.simulation().instances()) {
      const muster_clip* const clip = instance->plugin().clip;
      if (!clip) continue;
      const muster_param& p = instance->plugin().params[instance->find_param(clip->level)];
      model_.set(instance->name() + '/' + clip->level, clip->side == MUSTER_BELOW ? p.min : p.max);
    }
    without_ = drawn();
    expected_without_ = model_.expected();
  }

  void insert(const std::map<std::string, std::string>& attributes) {
    const Place place{model_.simulation().world().file.string()};
    InstanceDeclaration declared{cause_.id, "checked", 1, {}, {}, {}, place};
    for (const auto& [name, value] : attributes) declared.attributes.push_back({name, value, place, place});
    model_.simulation().share(cause_.library);
    if (inserted_) model_.simulation().remove("checked");
    model_.simulation().insert(std::move(declared));
    inserted_ = true;
  }

  VectorXd drawn() {
    VectorXd result = model_.drawn();
    level_ = first_column(model_.simulation().table(model_.observable().terms));
    return result;
  }
  VectorXd expected() {
    VectorXd result = model_.expected();
    level_ = first_column(model_.simulation().table(model_.observable().terms));
    return result;
  }
  // Levels of the last evaluation, to which receivers and fading add.
  const VectorXd& level() const { return level_; }
  const VectorXd& without() const { return without_; }
  const VectorXd& expected_without() const { return expected_without_; }
  const LinkModel& model() const { return model_; }

 private:
  LinkModel model_;
  const Cause& cause_;
  bool inserted_ = false;
  VectorXd level_, without_, expected_without_;
};

std::map<std::string, std::string> attributes_of(const muster_plugin& plugin, const std::vector<double>& params) {
  std::map<std::string, std::string> result;
  for (uint32_t k = 0; k < plugin.param_count; ++k) {
    const muster_param& p = plugin.params[k];
    if (p.kind == MUSTER_REAL || p.kind == MUSTER_INTEGER) result[p.name] = print_real(params[k]);
  }
  return result;
}

std::vector<DeclarationCheck> check_density(const ReadingLaw& law) {
  double mass = 0, mean = 0;
  bool finite = true;
  std::size_t settings = 0;
  std::vector<double> variances;
  for (const auto& params : settings_of(law)) {
    for (uint32_t draws = 1; draws <= law.declared().most_draws; ++draws, ++settings) {
      const Distribution at(law, params, draws);
      finite = finite && std::isfinite(at.mass) && std::isfinite(at.variance);
      mass = std::max(mass, std::abs(at.mass - 1));
      if (draws > 1) continue;
      variances.push_back(at.variance);
      const double declared = law.declared().mean ? law.declared().mean(params.data()) : 0;
      mean = std::max(mean, std::abs(at.mean - declared));
    }
  }
  std::vector<DeclarationCheck> result{
      {"density",
       finite ? fmt::format("integrates to 1 within {:.1g} at {} settings (at most {:.0g})", mass, settings,
                            thresholds::law_mass_error)
              : "is not a number, or infinite, somewhere",
       finite && mass <= thresholds::law_mass_error},
      {"mean",
       fmt::format("within {:.1g} dB of the declared one (at most {:.2g} dB)", mean, thresholds::law_mean_error),
       mean <= thresholds::law_mean_error}};
  if (!law.replaces()) return result;
  const bool ordered =
      std::is_sorted(variances.begin(), variances.end()) || std::is_sorted(variances.rbegin(), variances.rend());
  result.push_back({"strength",
                    ordered ? "its variance grows or falls with it"
                            : "its variance grows and falls with it: not one strength for a variance",
                    ordered});
  return result;
}

// Draws of the simulator at a setting: what it adds, or, of a law that replaces, all that is added to a level.
std::vector<DeclarationCheck> check_draws(const Cause& cause, const ReadingLaw& law, Executed& run) {
  const auto all = settings_of(law);
  const std::vector<double>& params = law.replaces() ? all[all.size() / 2] : all.back();
  run.insert(attributes_of(*cause.plugin, params));
  const VectorXd means = run.expected() - (law.replaces() ? run.level() : run.expected_without());
  const double declared = law.declared().mean ? law.declared().mean(params.data()) : 0;
  double off = 0;
  for (const double m : means) off = std::isfinite(m) ? std::max(off, std::abs(m - declared)) : off;
  std::vector<DeclarationCheck> result{
      {"expected",
       fmt::format("within {:.1g} dB of the declared mean (at most {:.0g} dB)", off, thresholds::law_execution_error),
       off <= thresholds::law_execution_error}};
  if (law.apart(params) > 0) return result;  // neighbours share draws
  const VectorXd drawn = run.drawn();
  const VectorXd added = drawn - (law.replaces() ? run.level() : run.without());
  Distribution expected(law, params, 1);
  const double unchanged = expected.without_zero();
  std::vector<double> sample;
  double zeros = 0, count = 0;
  for (const double v : added) {
    if (!std::isfinite(v)) continue;
    ++count;
    if (std::abs(v) < thresholds::law_execution_error)
      ++zeros;
    else
      sample.push_back(v);
  }
  if (unchanged > 0)
    result.push_back({"unchanged", fmt::format("{:.3f} of the readings (declared {:.3f})", zeros / count, unchanged),
                      std::abs(zeros / count - unchanged) <=
                          thresholds::law_draw_errors * std::sqrt(unchanged * (1 - unchanged) / count)});
  if (sample.empty()) return result;
  const double distance = expected.distance(sample),
               most = thresholds::law_draw_errors / std::sqrt(static_cast<double>(sample.size()));
  result.push_back(
      {"draws",
       fmt::format("{} readings lie {:.3f} off its distribution (at most {:.3f})", sample.size(), distance, most),
       distance <= most});
  return result;
}

DeclarationCheck check_clip(const muster_clip& clip, Executed& run) {
  const bool above = clip.side == MUSTER_ABOVE;
  VectorXd sorted = run.without();
  std::sort(sorted.begin(), sorted.end());
  const double level = sorted[sorted.size() / 2];
  run.insert({{clip.level, print_real(level)}});
  const VectorXd drawn = run.drawn();
  Index beyond = 0, kept = 0, wrong = 0;
  for (Index i = 0; i < drawn.size(); ++i) {
    const double before = run.without()[i];
    const bool outside = above ? before > level : before < level;
    outside ? ++beyond : ++kept;
    const bool lost = std::isnan(drawn[i]);
    const bool as_declared = !outside      ? drawn[i] == before
                             : clip.choice ? lost || drawn[i] == level
                             : clip.silent ? lost
                                           : drawn[i] == level;
    wrong += !as_declared;
  }
  return {"clip",
          fmt::format("{} readings beyond {:.4g} dBm and {} others: {} not as declared (at most 0)", beyond, level,
                      kept, wrong),
          wrong == 0};
}

// On the link with most readings.
DeclarationCheck check_burst(const muster_burst& burst, Executed& run) {
  constexpr double loss = 6, share = 0.3, duration = 10;  // dB; s
  std::map<std::set<std::string>, std::size_t> counts;
  std::vector<std::set<std::string>> links;
  for (const auto& [tx, rx] : run.model().ends()) {
    links.push_back(run.model().link_of(tx.radio, rx.radio));
    ++counts[links.back()];
  }
  const auto most =
      std::max_element(counts.begin(), counts.end(), [](const auto& a, const auto& b) { return a.second < b.second; });
  const std::set<std::string> link = most->first;
  run.insert({{burst.one, *link.begin()},
              {burst.other, *link.rbegin()},
              {burst.loss, print_real(loss)},
              {burst.share, print_real(share)},
              {burst.duration, print_real(duration)}});
  const VectorXd added = run.drawn() - run.without();
  double lost = 0, elsewhere = 0, beyond = 0;
  for (Index i = 0; i < added.size(); ++i) {
    const bool here = links[static_cast<std::size_t>(i)] == link;
    if (!here) elsewhere = std::max(elsewhere, std::abs(added[i]));
    if (here) beyond = std::max({beyond, added[i], -loss - added[i]});
    if (here) lost -= added[i] / loss / static_cast<double>(most->second);
  }
  return {
      "burst",
      fmt::format("takes up to its loss for {:.2f} of the readings of {} {} (declared {:.2f}), and nothing elsewhere",
                  lost, *link.begin(), *link.rbegin(), share),
      lost > share / 3 && lost < share * 3 && elsewhere < thresholds::law_execution_error &&
          beyond < thresholds::law_execution_error};
}

}  // namespace

Cause cause_on(const Library::SearchPath& plugins, const std::string& id) {
  std::string file = id;
  std::replace(file.begin(), file.end(), '.', '_');
  std::vector<std::string> known;
  for (const Cause& cause : causes_on(plugins)) {
    if (cause.id == id) return cause;
    known.push_back(cause.id);
  }
  for (const ListedPlugin& listed : list_plugins(plugins)) {
    if (!listed.library && listed.file.stem() == file)
      throw Error(Exit::plugin_fault, listed.file.string() + ": " + listed.reason);
  }
  throw Error(Exit::invalid_input, "there is no cause " + quote(id) + "; " + suggest(id, known));
}

std::vector<DeclarationCheck> check_declared_law(const Cause& cause, const std::filesystem::path& world,
                                                 const Library::SearchPath& plugins) {
  std::vector<DeclarationCheck> result;
  const muster_plugin& plugin = *cause.plugin;
  if (!plugin.law && !plugin.clip && !plugin.burst)
    throw Error(Exit::invalid_input,
                cause.id + " shifts no level, and declares no law, clip or burst that could be checked");
  Executed run(cause, world, plugins);
  if (plugin.law) {
    const ReadingLaw law(cause.id, cause.library, plugin);
    result = check_density(law);
    for (DeclarationCheck& check : check_draws(cause, law, run)) result.push_back(std::move(check));
  }
  if (plugin.clip) result.push_back(check_clip(*plugin.clip, run));
  if (plugin.burst) result.push_back(check_burst(*plugin.burst, run));
  return result;
}

}  // namespace muster::diagnosis
