#include "diagnosis/pipeline/diagnose.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "diagnosis/pipeline/cause_estimate.hpp"
#include "diagnosis/pipeline/extended_world.hpp"
#include "diagnosis/pipeline/joint_refit.hpp"
#include "diagnosis/pipeline/row_summary.hpp"
#include "diagnosis/pipeline/setup.hpp"
#include "diagnosis/planning/measurement_plans.hpp"
#include "diagnosis/radio/causes/applicability.hpp"
#include "diagnosis/radio/laws/law_causes.hpp"
#include "text/number.hpp"
#include "text/temporary_folder.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

class Diagnoser {
 public:
  Diagnoser(const std::filesystem::path& world, const std::filesystem::path& file, const Library::SearchPath& plugins)
      : at_(world, file, plugins), world_(world), plugins_(plugins) {}

  void leave_out_law(const std::string& id) {
    std::erase_if(at_.causes, [&](const Cause& cause) { return cause.id == id; });
  }

  // `given`: what was found in the world as given, where this one has its first cause put right.
  Diagnosis run(const Diagnosis* given = nullptr) {
    inference::Search search(at_.problem, at_.options);
    const inference::Result result = search.run();
    at_.run->clear();
    Diagnosis out = summed_up(result, at_.sought, search.state());
    if (given) begin_as_given(*given, search.state(), out);
    add_advice(search, out, at_.sought, {world_, plugins_, at_.model, at_.data}, at_.base, at_.layout->limits());
    for (const auto* more : {&at_.sought.not_tested, &at_.untested})
      out.not_tested.insert(out.not_tested.end(), more->begin(), more->end());
    return out;
  }

 private:
  Diagnosis summed_up(const inference::Result& result, const CauseSearch& causes, const inference::ModelState& state) {
    Diagnosis out;
    out.notes = at_.data.notes;
    if (const MissingData& m = at_.fitted.missing; !m.censored && m.rises())
      out.notes.push_back(fmt::format(
          "more readings are missing where less is expected ({:.0f} % at {:.0f} dBm, {:.0f} % at {:.0f} dBm): what was "
          "heard are the stronger ones, so weak levels look too high and the exponent too low",
          100 * m.bins.front().missing / m.bins.front().rows, m.bins.front().level,
          100 * m.bins.back().missing / m.bins.back().rows, m.bins.back().level));
    for (const std::string& blind : at_.fitted.not_identifiable) out.notes.push_back("not identifiable: " + blind);
    out.residual_sd = at_.fitted.residual_sd;
    out.noise = result.noise.covariance;
    out.held_out = result.held_out;
    out.unseen = result.unseen;
    out.elsewhere = result.elsewhere;
    out.used = at_.used;
    out.readings = at_.used.size();
    out.rows = state.rows().size();
    out.row_limits = at_.layout->limits();
    const VectorXd coefficients = result.base_coefficients.cwiseMax(at_.base.lower).cwiseMin(at_.base.upper);
    for (std::size_t j = 0; j < at_.base.paths.size(); ++j)
      out.parameters[at_.base.paths[j]] = coefficients[static_cast<Index>(j)];
    for (std::size_t k = 0; k < result.findings.size(); ++k) {
      const inference::Finding& f = result.findings[k];
      const auto cause = std::find_if(causes.found.begin(), causes.found.end(),
                                      [&](const CauseCandidate& c) { return c.candidate.id == f.id; });
      if (f.status == inference::Status::unexplained || cause == causes.found.end()) {
        out.unexplained.push_back(
            {f.id.substr(f.id.rfind('~') + 1), f.evidence, f.gain, f.held_out, f.elsewhere, f.alternatives});
        std::erase_if(out.unexplained.back().alternatives,
                      [](const inference::Alternative& r) { return r.id[0] == '~'; });
        continue;
      }
      const auto [finding, candidate] = simplest(f, *cause, causes, state, coefficients);
      out.causes.push_back(cause_estimate(finding, *candidate));
      out.causes.back().sought_as = f.id;
      out.causes.back().effect = effect_of(state, candidate->candidate, finding);
      give_tables(*candidate->shape, out.causes.back());
    }
    at_.run->clear();
    for (const CauseCandidate& c : causes.found) out.searched.push_back(c.candidate.id);
    out.instrument = at_.instrument;
    out.seen = row_summary(state, *at_.layout, at_.link_columns, at_.model);
    const inference::WhitenedModel alone = state.whitened_model(state.base());
    out.fitted = at_.base.mean + at_.base.slopes * (alone.coefficients(state.base().cols()) - at_.base.values);
    add_what_scatters(state, out);
    out.stairs = result.stairs;
    out.checks = result.checks;
    out.world_values = world_values(state, at_.base.paths, coefficients, at_.model);
    for (WorldValue& v : out.world_values) {
      v.value = out.parameters.at(v.path);
      v.identifiable = std::none_of(at_.fitted.parameters.begin(), at_.fitted.parameters.end(),
                                    [&](const FitParameter& p) { return p.path == v.path && !p.identifiable; });
    }
    doubt_at_bounds(out);
    return out;
  }

  // The channel's own law, at the end of what is physical, does not follow the readings: what stands beside it is what
  // it leaves. A material that costs nothing, or a cause, may well be at an end.
  void doubt_at_bounds(Diagnosis& out) const {
    constexpr double near = 1e-3;  // of the range: 0.01 of an exponent
    const auto& instances = at_.model.simulation().instances();
    std::string ends;
    for (std::size_t j = 0; j < out.world_values.size(); ++j) {
      WorldValue& v = out.world_values[j];
      const double lower = at_.base.lower[static_cast<Index>(j)], upper = at_.base.upper[static_cast<Index>(j)];
      v.at_bound = std::min(v.value - lower, upper - v.value) <= near * (upper - lower);
      const bool of_law = std::any_of(instances.begin(), instances.end(), [&](const auto& i) {
        return !i->plugin().cause && v.path.rfind(i->name() + '/', 0) == 0;
      });
      if (v.at_bound && of_law) ends += (ends.empty() ? "" : ", ") + v.path;
    }
    if (ends.empty()) return;
    const std::string doubt =
        "at its bound: " + ends + ", so that the world cannot follow these readings and no name is sure";
    out.notes.push_back(doubt);
    for (CauseEstimate& c : out.causes) c.doubt = doubt;
  }

  // What the world as given leaves, before what the one that was judged does. The cause that was put right wins what
  // that world, with all else that was found in it, errs more than the extended one.
  void begin_as_given(const Diagnosis& given, const inference::ModelState& state, Diagnosis& out) const {
    CauseEstimate& first = *out.causes.insert(out.causes.begin(), given.causes.front());
    const VectorXd left = measured(state) - state.rows().mean(given.fitted(at_.used));
    first.effect = left - out.seen.before;
    const inference::WhitenedModel alone = state.whitened_model(state.base());
    out.seen.before = left;
    out.seen.white_before = alone.at.basis.rest(alone.whitener(left));
    out.residual_sd = given.residual_sd;
    first.held_out.reset();
    out.held_out.reset();
    first.elsewhere.clear();
    out.elsewhere.clear();  // of a radio that is not seen nobody would know that it stands elsewhere
    if (!given.unseen || !out.unseen) return out.stairs.clear();
    first.held_out = inference::compared(errors_beside(given, first.unseen_without, out));
    out.unseen = errors_beside(given, given.unseen->before, out);
    out.held_out = inference::compared(*out.unseen);
    out.stairs.insert(out.stairs.begin(), inference::stair_of(*out.unseen));
  }

  // Errors `before`, of the world as given, and those of the extended one, at the readings that both have.
  static inference::Unseen errors_beside(const Diagnosis& given, const VectorXd& before, const Diagnosis& out) {
    std::map<Index, Index> place;
    for (std::size_t k = 0; k < given.used.size(); ++k) place[given.used[k]] = static_cast<Index>(k);
    std::vector<Index> theirs, ours;
    inference::Unseen both;
    both.seed = out.unseen->seed;
    for (std::size_t k = 0; k < out.used.size(); ++k) {
      const auto at = place.find(out.used[k]);
      if (at == place.end()) continue;
      theirs.push_back(at->second);
      ours.push_back(static_cast<Index>(k));
      both.block.push_back(out.unseen->block[k]);
    }
    both.before = before(theirs);
    both.after = out.unseen->after(ours);
    return both;
  }

  // A strength that may as well be the one at which the row has no effect at all is that: a wall that loses nothing is
  // a wall that is not there. Asked with the base model's parameters as they are beside what was found.
  std::pair<inference::Finding, const CauseCandidate*> simplest(const inference::Finding& f,
                                                                const CauseCandidate& cause, const CauseSearch& causes,
                                                                const inference::ModelState& state,
                                                                const VectorXd& base) {
    constexpr double alike = 0.9, normal95 = 1.96;
    if (cause.shape->columns() != 1 || cause.shape->linear.empty() || cause.candidate.refinement.any())
      return {f, &cause};
    const VectorXd own = state.columns_of(cause.candidate, f.theta);
    set_base(base);
    for (const CauseCandidate& other : causes.found) {
      if (!other.candidate.design.whole || other.candidate.refinement.any()) continue;
      VectorXd theta = other.candidate.design.grid[0];
      for (std::size_t row = 0; row < other.shape->rows.size(); ++row) {  // also those that cost nothing before
        theta[0] = static_cast<double>(row);
        if (f.label.empty() || other.shape->row_label(theta) != f.label) continue;
        const VectorXd none = state.columns_of(other.candidate, theta);
        const double product = own.dot(none), strength = product / own.squaredNorm();
        if (product * product < alike * own.squaredNorm() * none.squaredNorm() ||
            std::abs(f.coefficients[0] - strength) > normal95 * std::sqrt(f.uncertainty(0, 0)))
          continue;
        inference::Finding simple = f;
        simple.id = other.candidate.id;
        simple.theta = theta;
        simple.thetas = {theta};
        simple.coefficients = f.coefficients / strength;
        simple.uncertainty = f.uncertainty / (strength * strength);
        std::erase_if(simple.alternatives, [&](const inference::Alternative& r) { return r.id == simple.id; });
        set_base(at_.base.values);
        return {simple, &other};
      }
    }
    set_base(at_.base.values);
    return {f, &cause};
  }

  void set_base(const VectorXd& values) {
    at_.run->clear();
    for (std::size_t j = 0; j < at_.base.paths.size(); ++j)
      at_.model.set(at_.base.paths[j], values[static_cast<Index>(j)]);
  }

  void add_what_scatters(const inference::ModelState& state, Diagnosis& out) {
    const LawSources sources{at_.model, at_.data, at_.causes, state, at_.layout->readings(), at_.used, at_.fitted};
    add_clips(sources, out);
    if (add_silence_beside(sources, extend(state, out), out)) extend(state, out);
    const std::size_t before = out.causes.size();
    add_laws(sources, out);
    if (out.causes.size() > before) extend(state, out);  // a law of fading has a mean of its own
    std::stable_sort(out.causes.begin(), out.causes.end(), [](const CauseEstimate& a, const CauseEstimate& b) {
      return std::tuple(a.status, -a.lambda) < std::tuple(b.status, -b.lambda);
    });
    std::sort(out.searched.begin(), out.searched.end());
  }

  // A cause that reads a table gets the measured columns that it needs.
  void give_tables(const CauseShape& shape, CauseEstimate& found) const {
    const muster_param* file = shape.cause.file();
    if (!file) return;
    const std::string column = own_column(shape.cause);
    if (column == "walls") {
      found.files[file->name] = counts_of_walls();
      return;
    }
    const auto values = std::find_if(at_.data.covariates.begin(), at_.data.covariates.end(),
                                     [&](const Covariate& c) { return c.name.substr(0, c.name.find('[')) == column; });
    std::string text = "t[s],tx,rx," + values->name + '\n';
    for (std::size_t row = 0; row < at_.data.rows(); ++row)
      text += print_real(at_.data.t[row]) + ',' + at_.data.tx.levels[at_.data.tx.level[row]] + ',' +
              at_.data.rx.levels[at_.data.rx.level[row]] + ',' + print_real(values->values[row]) + '\n';
    found.files[file->name] = text;
  }

  // The columns walls_MATERIAL, in the order of the readings.
  std::string counts_of_walls() const {
    std::vector<const Covariate*> columns;
    std::string text;
    for (const Covariate& c : at_.data.covariates) {
      if (c.name.rfind("walls_", 0) != 0 || c.values.empty()) continue;
      text += (columns.empty() ? "" : ",") + c.name;
      columns.push_back(&c);
    }
    for (std::size_t row = 0; row < at_.data.rows(); ++row) {
      for (const Covariate* c : columns) text += (c == columns[0] ? "\n" : ",") + print_real(c->values[row]);
    }
    return text + '\n';
  }

  VectorXd measured(const inference::ModelState& state) const {
    const VectorXd offset = at_.base.offset()(at_.used);
    return state.y() + state.rows().mean(offset);
  }

  // What the extended world expects of every reading, dBm.
  VectorXd extend(const inference::ModelState& state, Diagnosis& out) {
    out.mean = VectorXd::Constant(at_.base.mean.size(), std::nan(""));
    VectorXd mean = refit_jointly({at_.model, at_.causes, at_.file, state, at_.used, measured(state)}, at_.base.lower,
                                  at_.base.upper, at_.base.paths, out);
    out.mean(at_.used) = mean(at_.used);
    return mean;
  }

  DiagnosisSetup at_;
  std::filesystem::path world_;
  Library::SearchPath plugins_;
};

}  // namespace

namespace {

const std::string people = "effect.people";

bool edits_world(const Cause& cause) {
  return cause.meaning().kind == MUSTER_WORLD_EDIT || cause.meaning().kind == MUSTER_INSTRUMENT;
}

// People are a law of what is random, about no covariate.
bool something_changes_in_time(const Diagnosis& found) {
  return std::any_of(
             found.causes.begin(), found.causes.end(),
             [](const CauseEstimate& c) { return c.status == inference::Status::named && c.changes_in_time(); }) ||
         std::any_of(found.unexplained.begin(), found.unexplained.end(),
                     [](const Unexplained& u) { return u.changes_in_time(); });
}

// The strongest named cause by which radios stand elsewhere, if anything was found beside it; or people, beside what
// changes in time.
const CauseEstimate* first_in_company(const Diagnosis& found, const std::vector<Cause>& causes) {
  const CauseEstimate* first = nullptr;
  std::size_t named = found.unexplained.size();
  for (const CauseEstimate& c : found.causes) {
    if (c.status != inference::Status::named) continue;
    ++named;
    const auto cause = std::find_if(causes.begin(), causes.end(), [&](const Cause& k) { return k.id == c.id; });
    if (first || cause == causes.end()) continue;
    if (edits_world(*cause) || (c.id == people && something_changes_in_time(found))) first = &c;
  }
  return named > 1 ? first : nullptr;
}

}  // namespace

// With a radio in the wrong place everything else was judged wrongly: it is judged again with the radio in the right
// one; and so it is with people who are known of, whose link is then left out. What still changes in time is no burst
// of theirs, and beside it they must be beyond doubt.
Diagnosis diagnose(const std::filesystem::path& world, const std::filesystem::path& data,
                   const Library::SearchPath& plugins) {
  Diagnosis found = Diagnoser(world, data, plugins).run();
  const CauseEstimate* const spoiler = first_in_company(found, causes_on(plugins));
  if (!spoiler) return found;
  Diagnosis first = found;
  first.causes = {*spoiler};
  first.causes[0].sought_as.clear();
  const TemporaryFolder folder;
  Diagnoser with_it(write_extended_world(first, world, folder.path()), data, plugins);
  if (first.causes[0].id != people) {
    first.causes[0].put_right_first = true;
    return with_it.run(&first);
  }
  Diagnosis again = with_it.run();
  if (first.causes[0].log_p > people_in_company && something_changes_in_time(again)) {
    Diagnoser without(world, data, plugins);
    without.leave_out_law(people);
    Diagnosis result = without.run();
    result.searched = found.searched;
    return result;
  }
  first.causes[0].effect = VectorXd::Zero(again.rows);
  again.causes.insert(again.causes.begin(), first.causes[0]);
  return again;
}

}  // namespace muster::diagnosis
