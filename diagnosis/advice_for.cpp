// Plans as tables that the world is simulated at, so that what they would tell apart can be worked out.
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <numeric>
#include <set>

#include "diagnosis/plans.hpp"
#include "text/number.hpp"

namespace muster::diagnosis {
namespace {

namespace fs = std::filesystem;
using Eigen::Index;

constexpr double decided = 25;          // D
constexpr std::size_t most_rivals = 3;  // of one cause: each costs a search over its grid at every plan

// A table of readings to be made, gone with this object.
class PlannedTable {
 public:
  PlannedTable(const noise::Readings& r, const std::vector<std::string>& radios) {
    static std::atomic<int> count{0};
    file_ = fs::temp_directory_path() /
            ("muster_plan_" + std::to_string(getpid()) + "_" + std::to_string(count++) + ".csv");
    std::ofstream out(file_, std::ios::binary);
    out << (r.t.empty() ? "" : "t[s],") << "tx,rx,tx_x[m],tx_y[m],tx_z[m],rx_x[m],rx_y[m],rx_z[m]"
        << (r.rx_yaw.empty() ? "" : ",rx_yaw[rad]") << '\n';
    for (Index i = 0; i < r.size(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      if (!r.t.empty()) out << print_real(r.t[k]) << ',';
      out << quoted(radios[static_cast<std::size_t>(r.tx[k])]) << ','
          << quoted(radios[static_cast<std::size_t>(r.rx[k])]);
      for (const auto& at : {r.tx_at.col(i), r.rx_at.col(i)})
        for (Index c = 0; c < 3; ++c) out << ',' << print_real(at[c]);
      if (!r.rx_yaw.empty()) out << ',' << print_real(r.rx_yaw[k]);
      out << '\n';
    }
    if (!out.flush()) throw Error(Exit::io, file_.string() + ": cannot be written");
  }
  ~PlannedTable() {
    std::error_code none;
    fs::remove(file_, none);
  }
  PlannedTable(const PlannedTable&) = delete;

  const fs::path& file() const { return file_; }

 private:
  static std::string quoted(const std::string& name) {
    std::string out = "\"";
    for (const char c : name) out += c == '"' ? "\"\"" : std::string(1, c);
    return out + '"';
  }
  fs::path file_;
};

// A plan has no columns beyond places and times.
bool reads_a_table(const CauseSearch& causes, const std::string& id) {
  return std::any_of(causes.found.begin(), causes.found.end(),
                     [&](const CauseCandidate& c) { return c.candidate.id == id && c.shape->cause.file(); });
}

// What was found, and the rivals that are worth the work; empty if there are none.
std::set<std::string> wanted(const Diagnosis& found, const CauseSearch& causes) {
  std::set<std::string> out;
  bool open = false;
  for (const FoundCause& c : found.causes) {
    if (c.status != search::Status::named) continue;
    if (reads_a_table(causes, c.id)) return {};
    if (!c.sought_as.empty()) out.insert(c.sought_as);  // a law of readings is none of the search's
    std::size_t rivals = 0;
    for (const search::Rival& r : c.rivals) {
      if (r.separability >= decided || r.id[0] == '~' || reads_a_table(causes, r.id) || rivals++ >= most_rivals)
        continue;
      out.insert(r.id);
      open = true;
    }
  }
  return open ? out : std::set<std::string>();
}

// A plan with the simulations that its candidates are evaluated in.
struct Simulated {
  PlannedTable table;
  LinkModel model;
  search::Plan plan;

  Simulated(const PlannedReadings& planned, const Diagnosis& found, const PlanSources& sources, const BaseColumns& base)
      : table(planned.readings, found.seen.radios),
        model(sources.world, table.file(), sources.plugins),
        plan{planned.say, planned.readings, slopes_at(model, base), {}} {}
};

void add_candidates(Simulated& at, const std::set<std::string>& ids, const CauseSearch& causes,
                    const PlanSources& sources) {
  const auto run = std::make_shared<CauseModel>(at.model, sources.world, at.table.file(), sources.plugins);
  std::vector<Index> all(static_cast<std::size_t>(at.plan.readings.size()));
  std::iota(all.begin(), all.end(), 0);
  for (const CauseCandidate& c : causes.found) {
    if (ids.count(c.candidate.id)) at.plan.candidates.push_back(at_readings_of(c, {run, at.model, sources.data, all}));
  }
}

}  // namespace

std::vector<Advice> advice_for(search::Search& search, const Diagnosis& found, const CauseSearch& causes,
                               const PlanSources& sources, const BaseColumns& base) {
  const std::set<std::string> ids = wanted(found, causes);
  if (ids.empty()) return {};
  std::vector<std::unique_ptr<Simulated>> simulated;
  std::vector<search::Plan> plans;
  for (const PlannedReadings& p : planned_readings(found.seen, found.causes)) {
    simulated.push_back(std::make_unique<Simulated>(p, found, sources, base));
    add_candidates(*simulated.back(), ids, causes, sources);
    plans.push_back(simulated.back()->plan);
  }
  std::vector<Advice> out;
  for (const search::Advice& a : search.advise(plans)) {
    const auto cause = std::find_if(found.causes.begin(), found.causes.end(),
                                    [&](const FoundCause& c) { return c.sought_as == a.finding; });
    if (cause != found.causes.end()) out.push_back({a.say, cause->id, a.rival, a.separability, a.predicted});
  }
  return out;
}

}  // namespace muster::diagnosis
