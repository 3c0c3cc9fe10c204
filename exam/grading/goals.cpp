// Grades against the goals of a diagnosis, as a table for the docs; measures without cases are left out.
#include <fmt/format.h>

#include "exam/grading/grade.hpp"

namespace muster::exam {
namespace {

struct Goal {
  const char* measure;
  std::vector<const char*> shares;  // pooled
  double goal;
  bool at_least;
};

const std::vector<Goal> goals{
    {"false name on clean worlds", {"clean / false name / all"}, 0.007, false},
    {"false \"unexplained\" on clean worlds", {"clean / false unexplained / all"}, 0.007, false},
    {"top name right, lambda >= 50", {"one / top name right / lambda >= 50"}, 0.99, true},
    {"the same, by class", {"one / top name right, by class / lambda >= 50"}, 0.99, true},
    {"found, lambda >= 50", {"one / found / lambda >= 50"}, 0.99, true},
    {"found, lambda 20-50", {"one / found / lambda 20-30", "one / found / lambda 30-50"}, 0, true},
    {"found, lambda 10-20", {"one / found / lambda 10-20"}, 0, true},
    {"wrong extra name beside a true effect",
     {"one / wrong extra name / all", "two / wrong extra name / all", "three / wrong extra name / all",
      "four / wrong extra name / all"},
     0.01,
     false},
    {"one effect in pieces",
     {"one / one effect in pieces / all", "two / one effect in pieces / all", "three / one effect in pieces / all",
      "four / one effect in pieces / all"},
     0.01,
     false},
    {"two effects both, each lambda >= 50", {"two / found / lambda >= 50"}, 0.97, true},
    {"three effects all, each lambda >= 50", {"three / found / lambda >= 50"}, 0.9, true},
    {"four effects all, each lambda >= 50", {"four / found / lambda >= 50"}, 0.9, true},
    {"each effect found, whatever is beside it, lambda >= 50", {"each effect / found / lambda >= 50"}, 0.97, true},
    {"the same, by class", {"each effect / found, by class / lambda >= 50"}, 0.97, true},
    {"only wrong names",
     {"one / only wrong names / all", "two / only wrong names / all", "three / only wrong names / all",
      "four / only wrong names / all"},
     0.01,
     false},
    {"adequate beside an effect of lambda >= 100", {"any / verdict adequate / lambda >= 100"}, 0.01, false},
    {"outside the vocabulary: right covariate, lambda >= 50", {"outside / right covariate / lambda >= 50"}, 0.97, true},
    {"outside the vocabulary: false name", {"outside / false name / all"}, 0.02, false},
    {"the extended world diagnosed again is silent", {"loop / rediagnosis silent / all"}, 0.98, true},
    {"and is silent on other data of the same truth", {"loop / second data silent / all"}, 0.98, true},
    {"of those where all that was hidden was told", {"loop / second data silent / where all was told"}, 0.98, true},
    {"the advised run settles the name, of ambiguous worlds", {"advice / settles the name / all"}, 0.9, true},
    {"of those where it is predicted to", {"advice / settles the name / predicted to"}, 0.9, true},
};

Share pooled(const Grades& g, const Goal& goal) {
  Share sum;
  for (const char* name : goal.shares) {
    const auto at = g.shares.find(name);
    if (at == g.shares.end()) continue;
    sum.hits += at->second.hits;
    sum.of += at->second.of;
  }
  return sum;
}

std::string row(const std::string& measure, const std::string& reached, const std::string& goal,
                const std::string& verdict) {
  return fmt::format("| {} | {} | {} | {} |\n", measure, reached, goal, verdict);
}

std::string percent(double share) { return fmt::format("{:.3g} %", 100 * share); }

// "Within chance" if the interval includes the goal: the cases are few.
std::string verdict_of(const Goal& goal, const Share& s) {
  if (goal.at_least ? s.value() >= goal.goal : s.value() <= goal.goal) return "reached";
  if (goal.at_least ? s.upper95() >= goal.goal : s.lower95() <= goal.goal) return "not reached, within chance";
  return "missed";
}

std::string share_row(const Goal& goal, const Share& s) {
  if (s.of == 0) return "";
  const std::string reached = fmt::format("{}/{} = {} [{:.1f}, {:.1f}]", s.hits, s.of, percent(s.value()),
                                          100 * s.lower95(), 100 * s.upper95());
  if (goal.goal <= 0) return row(goal.measure, reached, "", "");  // relative to an oracle that is not computed
  return row(goal.measure, reached, (goal.at_least ? ">= " : "<= ") + percent(goal.goal), verdict_of(goal, s));
}

std::string spread_row(const std::string& measure, const std::vector<double>& values, const char* unit,
                       double median_goal, double p90_goal) {
  if (values.empty()) return "";
  const double median = quantile(values, 0.5), p90 = quantile(values, 0.9);
  return row(measure, fmt::format("{:.2f} / {:.2f} {} ({})", median, p90, unit, values.size()),
             fmt::format("{} / {} {}", median_goal, p90_goal, unit),
             median <= median_goal && p90 <= p90_goal ? "reached" : "missed");
}

}  // namespace

std::string as_table(const Grades& g) {
  std::string out = "| measure | reached [95 % interval] | goal | |\n|---|---|---|---|\n";
  for (const Goal& goal : goals) out += share_row(goal, pooled(g, goal));
  for (const auto& [bin, oracle] : g.oracle)
    out += row("share of the oracle's held-out gain, " + bin, fmt::format("{:.3f}", g.gain.at(bin) / oracle), "", "");
  out += spread_row("wall's location, median / 90 %", g.places.wall, "m", 0.15, 0.5);
  out += spread_row("wall's loss, median / 90 %", g.places.wall_loss, "dB", 1, 1);
  if (g.covered.of > 0) {
    const double share = g.covered.value();
    out += row("95 % intervals that hold the truth",
               fmt::format("{}/{} = {}", g.covered.hits, g.covered.of, percent(share)), "93 to 97 %",
               share >= 0.93 && share <= 0.97 ? "reached" : "missed");
  }
  if (!g.seconds.empty())
    out += row("CPU seconds a case, median / largest",
               fmt::format("{:.1f} / {:.1f}", quantile(g.seconds, 0.5), quantile(g.seconds, 1)), "", "");
  if (!g.by_effect.empty()) out += "\n| effect | found (outside the vocabulary: right covariate) |\n|---|---|\n";
  for (const auto& [name, share] : g.by_effect) out += fmt::format("| {} | {}/{} |\n", name, share.hits, share.of);
  if (!g.missing.empty()) out += fmt::format("\n{} cases without a readable report.\n", g.missing.size());
  return out;
}

}  // namespace muster::exam
