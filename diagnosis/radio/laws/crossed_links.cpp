#include "diagnosis/radio/laws/crossed_links.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "diagnosis/radio/laws/blockage_test.hpp"
#include "diagnosis/radio/laws/standing_links_test.hpp"
#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {
namespace {

using Eigen::VectorXd;

// True if every effect found changes in time: it may be the blockage itself.
bool all_changes_in_time(const Diagnosis& found) {
  const auto in_time = [](const auto& one) { return one.changes_in_time(); };
  return std::all_of(found.causes.begin(), found.causes.end(), in_time) &&
         std::all_of(found.unexplained.begin(), found.unexplained.end(), in_time);
}

// What the world states of people.
std::optional<Crossed> stated_crossings(const LinkModel& model) {
  std::optional<Crossed> result;
  for (const auto& instance : model.simulation().instances()) {
    const muster_burst* const burst = instance->plugin().burst;
    if (!burst) continue;
    if (!result) result.emplace();
    const auto& given = instance->declared().attributes;
    result->all |= std::none_of(given.begin(), given.end(),
                                [&](const XmlAttribute& a) { return a.name == burst->one || a.name == burst->other; });
  }
  return result;
}

CauseEstimate& add_crossings(const LawSources& s, const std::vector<const Cause*>& causes, LawTest test,
                             Diagnosis& found) {
  const muster_burst& burst = *causes.front()->plugin->burst;
  const std::array names{burst.loss, burst.share, burst.duration};
  for (std::size_t k = 0; k < names.size(); ++k) test.values[k].name = names[k];
  return add_named(s, causes, test, found);
}

}  // namespace

Crossed add_blockage(const LawSources& s, const VectorXd& residual, Diagnosis& found) {
  const std::vector<const Cause*> causes =
      causes_that(s, [](const Cause& c) { return c.meaning().kind == MUSTER_LAW && c.plugin->burst; });
  if (causes.empty()) return {};
  const std::optional<Crossed> stated = stated_crossings(s.model);
  if (s.data.t.empty() || stated) {
    add_tested(causes, s.data.t.empty() ? "not testable: the data have no t" : "", found);
    return stated && stated->all ? *stated : Crossed();
  }
  const WalkersTest walkers = walkers_test(s.readings, residual);
  if (!walkers.test.values.empty() && walkers.test.values.front().value > thresholds::least_walker_loss &&
      beyond_chance(walkers.test, thresholds::law_alpha)) {
    add_tested(causes, "", found);
    add_crossings(s, causes, walkers.test, found);
    return {{}, true};
  }
  const Blockage passages = blockage_test(s.state, s.readings, residual.array().isFinite());
  add_tested(causes, passages.links ? "" : "not testable: no link has 40 rows of readings that are no bounds", found);
  if (passages.radio < 0 || !beyond_chance(passages.test, thresholds::law_alpha) ||
      (passages.test.log_p > thresholds::blockage_in_company && !all_changes_in_time(found)) ||
      (passages.is_slight && found.causes.empty() && found.unexplained.empty()))
    return {};
  const muster_burst& burst = *causes.front()->plugin->burst;
  CauseEstimate& out = add_crossings(s, causes, passages.test, found);
  out.row_parameter = burst.one;
  out.row = s.model.radio_name(passages.radio);
  const std::string other = out.words[burst.other] = s.model.radio_name(passages.other);
  out.label = "radio/" + out.row + " radio/" + other;
  for (inference::Alternative& alike : out.alternatives) alike.label = out.label;
  return {{out.row, other}};
}

}  // namespace muster::diagnosis
