// Predicts the separability of causes under each plan by simulating the world at its readings.
#include <algorithm>
#include <map>
#include <set>

#include "diagnosis/inference/thresholds.hpp"
#include "diagnosis/planning/measurement_plans.hpp"
#include "diagnosis/radio/causes/simulated_readings.hpp"

namespace muster::diagnosis {
namespace {

constexpr std::size_t most_rivals = 3;  // of one cause: each costs a search over its grid at every plan

// True if the cause reads a table: plans have no columns beyond places and times.
bool reads_a_table(const CauseSearch& causes, const std::string& id) {
  return std::any_of(causes.found.begin(), causes.found.end(),
                     [&](const CauseCandidate& c) { return c.candidate.id == id && c.shape->cause.file(); });
}

// Ids of the findings and of their undecided alternatives; empty if none is undecided.
std::set<std::string> wanted(const Diagnosis& found, const CauseSearch& causes) {
  std::set<std::string> out;
  bool open = false;
  for (const CauseEstimate& c : found.causes) {
    if (c.status != inference::Status::named) continue;
    if (reads_a_table(causes, c.id)) return {};
    if (c.sought_as.empty()) continue;  // a law of readings or a cause corrected first is not from the search
    out.insert(c.sought_as);
    std::size_t alternatives = 0;
    for (const inference::Alternative& r : c.alternatives) {
      if (r.separability >= inference::thresholds::decided || r.id[0] == '~' || r.id == c.sought_as ||
          reads_a_table(causes, r.id) || alternatives++ >= most_rivals)
        continue;
      out.insert(r.id);
      open = true;
    }
  }
  return open ? out : std::set<std::string>();
}

}  // namespace

std::optional<PlannedReadings> most_telling(const Diagnosis& found, std::vector<PlannedReadings> plans) {
  const auto open = std::find_if(found.causes.begin(), found.causes.end(), [&](const CauseEstimate& c) {
    return std::any_of(found.advice.begin(), found.advice.end(), [&](const Advice& a) { return a.cause == c.id; });
  });
  if (open == found.causes.end()) return {};
  std::map<std::string, double> more;
  for (const Advice& a : found.advice) {
    if (a.cause == open->id && a.predicted)
      more[a.say] += std::min(*a.predicted, inference::thresholds::decided) - a.separability;
  }
  const auto tells_less = [&](const PlannedReadings& a, const PlannedReadings& b) { return more[a.say] < more[b.say]; };
  const auto most = std::max_element(plans.begin(), plans.end(), tells_less);
  if (more[most->say] < 1) return {};
  return std::move(*most);
}

void add_advice(inference::Search& search, Diagnosis& found, const CauseSearch& causes, const PlanSources& sources,
                const Sensitivities& base, const LinkRowLimits& limits) {
  const std::set<std::string> ids = wanted(found, causes);
  if (ids.empty() || holds_a_table_reader(sources.model)) return;
  std::vector<std::unique_ptr<SimulatedReadings>> simulated;
  std::vector<PlannedReadings> planned = planned_readings(found.seen, found.causes);
  std::vector<inference::Plan> plans;
  for (const PlannedReadings& p : planned) {
    simulated.push_back(std::make_unique<SimulatedReadings>(p.readings, found.seen.radios, sources.world,
                                                            sources.plugins, base, sources.model.libraries()));
    plans.push_back(
        {p.say, std::make_shared<const LinkLayout>(p.readings, limits), simulated.back()->slopes(base), {}});
    for (const CauseCandidate& c : causes.found) {
      if (ids.count(c.candidate.id)) plans.back().candidates.push_back(simulated.back()->at(c));
    }
  }
  for (const inference::Advice& a : search.advise(plans)) {
    const auto cause = std::find_if(found.causes.begin(), found.causes.end(),
                                    [&](const CauseEstimate& c) { return c.sought_as == a.finding; });
    if (cause != found.causes.end())
      found.advice.push_back({a.say, cause->id, a.alternative, a.separability, a.predicted});
  }
  found.advised = most_telling(found, std::move(planned));
}

}  // namespace muster::diagnosis
