#include "diagnosis/radio/laws/law_sources.hpp"

#include <algorithm>
#include <cmath>

#include "diagnosis/radio/thresholds.hpp"

namespace muster::diagnosis {
namespace {

std::vector<CauseValue> values_of(const Cause& cause, const LawTest& test) {
  std::vector<CauseValue> result;
  for (const LawValue& v : test.values) {
    const auto* const end = cause.plugin->params + cause.plugin->param_count;
    const auto* const p =
        std::find_if(cause.plugin->params, end, [&](const muster_param& q) { return q.name == v.name; });
    if (p == end) continue;
    result.push_back({v.name, p->unit, std::clamp(v.value, p->min, p->max),
                      (v.upper95 - v.lower95) / (2 * thresholds::normal95), v.lower95, v.upper95, p->min, p->max});
  }
  return result;
}

CauseEstimate named(const LawSources& s, const Cause& cause, const LawTest& test) {
  CauseEstimate out;
  out.id = cause.id;
  out.label = "all";
  out.title = cause.meaning().title;
  out.tell_apart = cause.meaning().tell_apart;
  out.covariates = {"reading"};
  out.values = values_of(cause, test);
  out.words = names_of_instances(cause, s.model.simulation());
  out.evidence = test.evidence;
  out.log_p = test.log_p;
  out.lambda = test.gain;
  out.effect = Eigen::VectorXd::Zero(s.state.rows().size());
  return out;
}

}  // namespace

std::vector<std::shared_ptr<const ReadingLaw>> laws_of_causes(const LawSources& s) {
  std::vector<std::shared_ptr<const ReadingLaw>> result;
  for (const Cause& cause : s.causes) {
    if (cause.meaning().kind == MUSTER_LAW && cause.plugin->law)
      result.push_back(std::make_shared<const ReadingLaw>(cause.id, cause.library, *cause.plugin));
  }
  return result;
}

std::vector<CauseValue> values_of(const LawSources& s, const LawTest& test) {
  const std::vector<const Cause*> causes = causes_that(s, [&](const Cause& c) { return c.id == test.cause; });
  return causes.empty() ? std::vector<CauseValue>() : values_of(*causes.front(), test);
}

bool replaces(const LawSources& s, const std::string& cause) {
  const auto laws = laws_of_causes(s);
  return std::any_of(laws.begin(), laws.end(), [&](const auto& law) { return law->id() == cause && law->replaces(); });
}

ReadingDistribution stated_law(const LinkModel& model) {
  ReadingDistribution result;
  for (const auto& instance : model.simulation().instances()) {
    if (!instance->plugin().law) continue;
    LawPart part{
        std::make_shared<const ReadingLaw>(instance->declared().plugin, instance->library(), instance->plugin()),
        instance->params()};
    if (part.law->replaces())
      result.base = std::move(part);
    else
      result.added.push_back(std::move(part));
  }
  return result;
}

bool beyond_chance(const LawTest& test, double share) { return test.evidence > 0 && test.log_p < std::log(share); }

void add_tested(const std::vector<const Cause*>& causes, const std::string& why_not, Diagnosis& found) {
  for (const Cause* cause : causes)
    why_not.empty() ? found.searched.push_back(cause->id) : found.not_tested.push_back(cause->id + ": " + why_not);
}

CauseEstimate& add_named(const LawSources& s, const std::vector<const Cause*>& alike, const LawTest& test,
                         Diagnosis& found) {
  found.causes.push_back(named(s, *alike.front(), test));
  for (std::size_t k = 1; k < alike.size(); ++k)
    found.causes.back().alternatives.push_back({alike[k]->id, "all", {}, 0, 0});
  return found.causes.back();
}

}  // namespace muster::diagnosis
