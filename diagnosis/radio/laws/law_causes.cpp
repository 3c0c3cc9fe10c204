#include "diagnosis/radio/laws/law_causes.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "diagnosis/radio/laws/crossed_links.hpp"
#include "diagnosis/radio/laws/law_doubts.hpp"
#include "diagnosis/radio/laws/shadowing_test.hpp"
#include "diagnosis/radio/laws/testable_readings.hpp"
#include "diagnosis/radio/links/drawn_term.hpp"
#include "diagnosis/radio/thresholds.hpp"
#include "muster/random.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::Index;
using Eigen::VectorXd;

// Readings and the field about them, as the world states it where that fits.
KrigedReadings kriged(const LawSources& s, const VectorXd& residual) {
  const noise::Family fitted = s.state.fit.covariance.family;
  const std::vector<noise::Family> likely = s.state.likely_families(fitted);
  const bool as_drawn = std::any_of(likely.begin(), likely.end(), noise::is_stated);
  return {s.readings, residual, as_drawn ? s.state.field().sites().stated : nullptr, fitted, s.state.time_unit()};
}

// The same readings off by something else: `field` is that of `residual`.
KrigedReadings kriged_alike(const LawSources& s, const VectorXd& error, const VectorXd& residual,
                            const KrigedReadings& field) {
  std::vector<Index> finite;
  for (Index i = 0; i < error.size(); ++i) {
    if (std::isfinite(error[i]) != std::isfinite(residual[i])) return kriged(s, error);
    if (std::isfinite(error[i])) finite.push_back(i);
  }
  return field.with(error(finite));
}

// Monte Carlo test: true if readings that the world itself draws, with the noise of these (`likeliest`), look as much
// as by this law. Where nothing scatters single ones, the few that the field is sharpest at do: a field of waves bends
// more than a normal one.
bool scatters_by_itself(const LawSources& s, const ReadingDistribution& stated, const ReadingDistribution& likeliest,
                        const VectorXd& residual, const KrigedReadings& about, const LawTest& law,
                        const Diagnosis& found) {
  if (drawn_field(s.model).shadowing <= 0) return false;  // it draws nothing that bends
  auto laws = laws_of_causes(s);                          // the null of a law is every one that could replace another
  std::erase_if(laws, [&](const auto& one) { return one->id() != law.cause && !one->replaces(); });
  for (uint64_t k = 0; k < thresholds::law_draws; ++k) {
    const WorldDraw draw = s.draws.draw(k, found.parameters, {});
    const Stream noise(combined(key_of("noise of a draw"), k));
    VectorXd error = residual.array().isFinite().select((draw.drawn - draw.expected)(s.used), std::nan("")).matrix();
    for (Index i = 0; i < error.size(); ++i) error[i] += likeliest.noise * noise.normal(static_cast<uint64_t>(i));
    KrigedReadings field = kriged_alike(s, error, residual, about);
    const LawTests drawn =
        law_tests(field, found.receiver.step, laws, stated, s.state.fit.covariance, unsure(s, error));
    for (const LawTest& test : drawn.tests)
      if (test.cause == law.cause && test.evidence * thresholds::beyond_drawn > law.evidence) return true;
  }
  return false;
}

constexpr const char* normal_noise = "single readings scatter as normal noise does, of which the world states none";

// The law of readings: the stated one, or the one that is named.
struct Scatter {
  ReadingDistribution law;
  bool doubted = false;  // another one would be likelier, but is not named: a note says why
};

// Tests the fading law.
Scatter add_scatter(const LawSources& s, const ReadingDistribution& stated, const VectorXd& residual,
                    KrigedReadings& field, Diagnosis& found) {
  const auto [tests, likeliest] =
      law_tests(field, found.receiver.step, laws_of_causes(s), stated, s.state.fit.covariance, unsure(s, residual));
  const auto best = tests.begin();
  if (likeliest.noise > 0 && std::find(found.notes.begin(), found.notes.end(), normal_noise) == found.notes.end())
    found.notes.emplace_back(normal_noise);
  if (best == tests.end() || !beyond_chance(*best, thresholds::law_alpha)) return {likeliest};
  if (!stated.base.law && replaces(s, best->cause)) return {best->law};  // it contradicts nothing
  if (std::string doubt = doubt_of(s, residual, field, found, *best); !doubt.empty()) {
    found.notes.push_back(std::move(doubt));
    return {likeliest, true};
  }
  const bool is_exact = std::sqrt(base_variance(stated)) < thresholds::least_stated_scatter;
  if (is_exact && scatters_by_itself(s, stated, likeliest, residual, field, *best, found)) {
    found.notes.push_back("readings look like " + best->cause +
                          ", but so do readings that the world itself draws without it: it is not named");
    return {likeliest, true};
  }
  add_named(s, causes_that(s, [&](const Cause& c) { return c.id == best->cause; }), *best, found);
  std::string& doubt = found.causes.back().doubt;
  doubt = replaces(s, best->cause) ? doubt_by_level(s, residual, field, found) : doubt_by_link(s, residual, *best);
  if (doubt.empty()) doubt = doubt_of_scatter(found);
  for (const LawTest& other : tests) {
    const double gap = best->evidence - other.evidence;
    if (&other != &*best && gap < thresholds::open_law_nats)
      found.causes.back().alternatives.push_back({other.cause, "all", {}, gap, 2 * gap});
  }
  return {best->law};
}

// log shadowing and log decorrelation distance of a fitted field.
Eigen::Vector2d shape_of(const LawSources& s, const noise::Covariance& covariance) {
  const noise::StatedField field = stated_by(covariance, s.state.within());
  return {std::log(field.shadowing), std::log(field.decorrelation)};
}

// True if the fitted field is one of those that rows of the world's own draws yield: Hotelling's T^2 of one more draw.
// Or if nobody can tell, since the draws are too weak to be heard.
bool world_draws_alike(const LawSources& s, const Diagnosis& found) {
  constexpr int n = thresholds::field_draws;
  const Eigen::Array<bool, Eigen::Dynamic, 1> measured = s.fit.readings.rssi(s.used).array().isFinite();
  Eigen::Matrix2Xd shapes(2, n);
  for (int k = 0; k < n; ++k) {
    const WorldDraw draw = s.draws.draw(static_cast<uint64_t>(k), found.parameters, {});
    VectorXd error = (draw.drawn - draw.expected)(s.used);
    const auto heard = error.array().isFinite();
    const auto lost = static_cast<double>((measured && !heard).count());
    if (lost > (1 - thresholds::heard_of_a_draw) * static_cast<double>(measured.count())) return true;
    error = heard.select(error, 0).eval();
    shapes.col(k) = shape_of(s, fitted_to(s.state, s.state.rows().mean(error)));
  }
  const Eigen::Vector2d mean = shapes.rowwise().mean(), away = shape_of(s, s.state.fit.covariance) - mean;
  const Eigen::Matrix2Xd apart = shapes.colwise() - mean;
  const Eigen::Matrix2d spread = apart * apart.transpose() / (n - 1) + 1e-4 * Eigen::Matrix2d::Identity();
  const double t2 = away.dot(spread.inverse() * away) * n / (n + 1), f = t2 * (n - 2) / (2 * (n - 1));
  return std::pow(1 + 2 * f / (n - 2), -0.5 * (n - 2)) > thresholds::alike_field;  // tail of F with 2 and n - 2
}

// Causes that draw a field.
std::vector<const Cause*> fields_of(const LawSources& s) {
  return causes_that(s, [](const Cause& c) { return c.meaning().kind == MUSTER_LAW && c.plugin->draw; });
}

void add_field(const LawSources& s, KrigedReadings& field, const ReadingDistribution& law, Diagnosis& found) {
  const std::vector<const Cause*> causes = fields_of(s);
  if (causes.empty()) return;
  const noise::StatedField said = drawn_field(s.model);
  add_tested(causes, said.shadowing > 0 ? "" : "not testable: the world states no shadowing", found);
  if (said.shadowing <= 0) return;
  LawTest test = field_test(field, found.receiver.step, law, said, s.state);
  const muster_draw& draw = *causes.front()->plugin->draw;
  test.values[0].name = draw.scale;
  test.values[1].name = draw.distance;
  // The field needs two tests to agree (shadowing_test.hpp).
  if (!beyond_chance(test, thresholds::field_alpha) || test.evidence < thresholds::least_field ||
      test.values[0].value > thresholds::widest_field * found.residual_sd || world_draws_alike(s, found))
    return;
  if (std::string doubt = doubt_of_extent(s.readings, {test.values[0].value, test.values[1].value}, said);
      !doubt.empty()) {
    found.notes.push_back(std::move(doubt));
    return;
  }
  CauseEstimate& named = add_named(s, causes, test, found);
  named.doubt = doubt_of_field(found, named);
}

// Each of the two laws can imitate the other: the weaker one is kept only if it is beyond doubt.
void leave_the_stronger(Diagnosis& found) {
  const auto weaker =
      std::min_element(found.causes.end() - 2, found.causes.end(),
                       [](const CauseEstimate& a, const CauseEstimate& b) { return a.lambda < b.lambda; });
  if (weaker->lambda < thresholds::second_law_lambda) found.causes.erase(weaker);
}

const std::string shared = "not testable: readings of one place share a part of their scatter, such as multipath";

// What the directions of a link share is the same in both; a draw of each alone, such as an outlier, is in the mean of
// twins half as large and twice as often. Names such a law by the means, where one direction has too few of its draws;
// its numbers are those of the readings of one direction, `each` with `field_of_each`, where these have any.
void add_scatter_of_means(const LawSources& s, const ReadingDistribution& stated, const VectorXd& all,
                          const VectorXd& each, KrigedReadings& field_of_each, Diagnosis& found) {
  if (s.readings.twin.empty() ||
      s.readings.twin_variance > thresholds::twins_differ * s.state.fit.covariance.reading_variance())
    return;
  std::vector<std::string> told;
  const VectorXd means = means_of_twins(s.readings, s.state.rows(), all);
  const VectorXd residual = without_grazing(s, stated.base.law ? drawn_anew(s, stated.base, means) : means, told);
  KrigedReadings field = kriged(s, residual);
  Diagnosis of_means = found;
  add_scatter(s, stated, residual, field, of_means);
  if (of_means.causes.size() == found.causes.size() || replaces(s, of_means.causes.back().id)) return;
  found = std::move(of_means);
  CauseEstimate& named = found.causes.back();
  auto laws = laws_of_causes(s);
  std::erase_if(laws, [&](const auto& law) { return law->id() != named.id; });
  const LawTests tests =
      law_tests(field_of_each, found.receiver.step, laws, stated, s.state.fit.covariance, unsure(s, each));
  if (!tests.tests.empty() && tests.tests.front().gain > thresholds::numbers_of_one_direction)
    named.values = values_of(s, tests.tests.front());
  else
    found.notes.push_back("the numbers of " + named.id +
                          " are those of the mean of a link's two directions: one alone is up to twice as far off, and "
                          "half as often");
}

// Runs the tests on single readings in turn. Where the world states no law, normal noise and every law that could
// replace another are the null: what adds outliers must be likelier.
// `why`: they are not testable; empty if they are.
void add_laws_of_readings(const LawSources& s, const VectorXd& both_ways, std::string why, Diagnosis& found) {
  const VectorXd all = without_second_twins(s.readings, s.state.rows(), both_ways);
  ReadingDistribution stated = stated_law(s.model);
  VectorXd anew = stated.base.law ? drawn_anew(s, stated.base, all) : all;
  std::string of_base = stated.base.law ? "" : "not testable: no plugin of the world states a law of readings";
  // One draw a link or a place belongs to the field; what single readings do beside it is testable.
  const bool is_of_places = tested(anew) < tested(all) && noise::fixed_share(s.state.fit.covariance.family) > 0 &&
                            repeated(s.readings) >= thresholds::fewest_law_readings;
  if (stated.base.law &&
      (is_of_places || (tested(anew) < thresholds::fewest_law_readings && repeat_places(s.readings)))) {
    of_base = is_of_places ? shared : why_not(s, anew);
    stated.base = {};
    anew = all;
  }
  std::vector<std::string> notes;
  std::optional<KrigedReadings> field;
  VectorXd residual;
  if (why.empty()) why = why_not(s, anew);
  if (why.empty()) {
    residual = without_grazing(s, anew, notes);
    field = kriged(s, residual);
    if (static_cast<Index>(field->judged().size()) < thresholds::fewest_law_readings)
      why = shared + ", and fewer than 300 repeat another one";
  }
  const std::string of_stated = !why.empty() || of_base.empty() ? why : of_base;
  for (const bool replacing : {false, true})
    add_tested(causes_that(s,
                           [&](const Cause& c) {
                             return c.meaning().kind == MUSTER_LAW && c.plugin->law && replaces(s, c.id) == replacing;
                           }),
               replacing ? of_stated : why, found);
  std::string of_field = of_stated;
  if (of_field.empty() && s.state.time_unit() > 0)
    of_field = "not testable: links that stand wander in time, and no field over places can be seen";
  if (of_field.empty() && noise::fixed_share(s.state.fit.covariance.family) > 0) of_field = shared;
  if (!of_field.empty()) add_tested(fields_of(s), of_field, found);
  if (!why.empty()) return;
  found.notes.insert(found.notes.end(), notes.begin(), notes.end());
  const std::size_t before = found.causes.size();
  const Scatter scatter = add_scatter(s, stated, residual, *field, found);
  if (found.causes.size() == before && !scatter.doubted)
    add_scatter_of_means(s, stated, both_ways, residual, *field, found);
  if (!of_field.empty()) return;
  add_field(s, *field, scatter.law, found);
  if (found.causes.size() == before + 2) leave_the_stronger(found);
}

// At any moment people are on the way of more or fewer of the links: all readings together then follow time, which is
// nothing else that is wrong.
void leave_time_to_people(Diagnosis& found) {
  const auto of_people = std::stable_partition(found.unexplained.begin(), found.unexplained.end(),
                                               [](const Unexplained& u) { return !u.changes_in_time(); });
  if (of_people == found.unexplained.end()) return;
  found.notes.push_back(
      "readings follow time beyond chance, as people who walk about make them do: nothing else is named for it");
  found.of_people.assign(of_people, found.unexplained.end());
  found.unexplained.erase(of_people, found.unexplained.end());
}

}  // namespace

void add_laws(const LawSources& s, Diagnosis& found) {
  const VectorXd residual = residual_of(s, found);
  const Crossed crossed = add_blockage(s, residual, found);
  if (crossed.all) leave_time_to_people(found);
  add_laws_of_readings(s, without_link(s, crossed.link, residual),
                       crossed.all ? "not testable: people who cross the links change readings, too" : "", found);
}

}  // namespace muster::diagnosis
