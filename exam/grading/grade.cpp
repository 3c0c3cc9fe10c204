#include "exam/grading/grade.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace muster::exam {
namespace {

// P(X <= k) of a binomial distribution.
double cumulative(int k, int n, double p) {
  if (p <= 0) return 1;
  if (p >= 1) return k >= n ? 1 : 0;
  double sum = 0;
  for (int i = 0; i <= k; ++i)
    sum += std::exp(std::lgamma(n + 1) - std::lgamma(i + 1) - std::lgamma(n - i + 1) + i * std::log(p) +
                    (n - i) * std::log1p(-p));
  return std::min(sum, 1.0);
}

template <class Above>
double root(Above above) {
  double low = 0, high = 1;
  for (int i = 0; i < 50; ++i) (above((low + high) / 2) ? high : low) = (low + high) / 2;
  return (low + high) / 2;
}

// Names of covariates without marks and units: "~battery[V]" is battery.
std::string plain(const std::string& name) {
  std::string result;
  bool unit = false;
  for (const char c : name) {
    if (c == '[') unit = true;
    if (!unit && c != '~' && c != ' ') result += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (c == ']') unit = false;
  }
  return result;
}

// True for the same factors in any order.
bool same_covariate(const std::string& said, const std::string& accepted) {
  const auto factors = [](const std::string& name) {
    std::vector<std::string> result(1);
    for (const char c : plain(name)) {
      if (c == '*')
        result.emplace_back();
      else
        result.back() += c;
    }
    std::sort(result.begin(), result.end());
    return result;
  };
  return factors(said) == factors(accepted);
}

std::string last_part(const std::string& path) { return path.substr(path.find_last_of('/') + 1); }

bool at_right_row(const Truth::Effect& effect, const Verdict::Cause& cause) {
  return std::any_of(effect.rows.begin(), effect.rows.end(), [&](const auto& row) {
    for (std::size_t from = 0; from <= cause.label.size();) {  // a label may list several rows
      const std::size_t to = std::min(cause.label.find_first_of(", ", from), cause.label.size());
      if (last_part(cause.label.substr(from, to - from)) == last_part(row)) return true;
      from = to + 1;
    }
    return false;
  });
}

// Equivalence classes of causes that readings may not separate. A wall and an obstacle both block links. A missing
// wall has no loss, like one of another material. For a radio that sends and receives, offsets of transmitter and
// receiver and an asymmetry differ only in the mean level of its pairs. Shadowing absorbs that. Of one class are also
// the causes of a headline "it is A or B (the readings do not tell which)": with readings at two times, a drift is a
// step.
bool same_class(const Truth::Effect& effect, const Verdict::Cause& cause) {
  static const std::vector<std::set<std::string>> classes{{"unmapped_wall", "obstacle"},
                                                          {"wall_material", "wall_absent"},
                                                          {"asymmetry", "feeder_loss", "rx_offset", "tx_offset"}};
  const bool right_place = effect.rows.empty() || at_right_row(effect, cause);
  const auto lists = [&](const std::vector<std::string>& ids) {
    return std::find(ids.begin(), ids.end(), cause.id) != ids.end();
  };
  if (cause.id == effect.id || (right_place && (lists(effect.also) || lists(effect.kin)))) return true;
  if (right_place && std::count(cause.beside.begin(), cause.beside.end(), effect.id) > 0) return true;
  return std::any_of(classes.begin(), classes.end(),
                     [&](const auto& one) { return one.contains(effect.id) && one.contains(cause.id) && right_place; });
}

bool names(const Verdict::Cause& cause, const Truth::Effect& effect) {
  return cause.id == effect.id || (std::count(effect.also.begin(), effect.also.end(), cause.id) > 0 &&
                                   (effect.rows.empty() || at_right_row(effect, cause)));
}

const Verdict::Cause* found(const Verdict& verdict, const Truth::Effect& effect) {
  for (const Verdict::Cause& c : verdict.named)
    if (names(c, effect)) return &c;
  return nullptr;
}

// An effect without a name in the vocabulary is reported as structure along one of its covariates.
bool reported_along_covariate(const Verdict& verdict, const Truth::Effect& effect) {
  return std::any_of(verdict.unexplained.begin(), verdict.unexplained.end(), [&](const std::string& said) {
    return std::any_of(effect.covariates.begin(), effect.covariates.end(),
                       [&](const auto& accepted) { return same_covariate(said, accepted); });
  });
}

bool is_found(const Verdict& verdict, const Truth::Effect& effect) {
  return found(verdict, effect) || (!effect.in_vocabulary && reported_along_covariate(verdict, effect));
}

bool is_found_by_class(const Verdict& verdict, const Truth::Effect& effect) {
  return is_found(verdict, effect) ||
         std::any_of(verdict.named.begin(), verdict.named.end(), [&](const auto& c) { return same_class(effect, c); });
}

// The most of the effects from `at` on that are found, each by a cause of its own or by a covariate. `finds`: that a
// cause names an effect.
template <class Finds>
int most_found(const Truth& truth, const Verdict& verdict, const Finds& finds, std::size_t at,
               std::vector<bool>& taken) {
  if (at == truth.effects.size()) return 0;
  const Truth::Effect& effect = truth.effects[at];
  int most = most_found(truth, verdict, finds, at + 1, taken) +
             (!effect.in_vocabulary && reported_along_covariate(verdict, effect));
  for (std::size_t k = 0; k < verdict.named.size(); ++k) {
    if (taken[k] || !finds(verdict.named[k], effect)) continue;
    taken[k] = true;
    most = std::max(most, 1 + most_found(truth, verdict, finds, at + 1, taken));
    taken[k] = false;
  }
  return most;
}

template <class Finds>
int most_found(const Truth& truth, const Verdict& verdict, const Finds& finds) {
  std::vector<bool> taken(verdict.named.size(), false);
  return most_found(truth, verdict, finds, 0, taken);
}

// Each effect by itself, whatever else its case has; and whether a strong one is passed over as adequate.
void add_each_effect(Grades& grades, const Truth& truth, const Verdict& verdict) {
  constexpr double beyond_doubt = 100;  // lambda
  double strongest = 0;
  for (const Truth::Effect& effect : truth.effects) {
    strongest = std::max(strongest, effect.lambda);
    for (const std::string& bin : {lambda_bin(effect.lambda), std::string("all")}) {
      grades.shares["each effect / found / " + bin].count(is_found(verdict, effect));
      grades.shares["each effect / found, by class / " + bin].count(is_found_by_class(verdict, effect));
    }
  }
  if (strongest >= beyond_doubt)
    grades.shares["any / verdict adequate / lambda >= 100"].count(verdict.verdict == "adequate");
}

double weakest(const Truth& truth) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& e : truth.effects) least = std::min(least, e.lambda);
  return least;
}

void add_place(Grades& grades, const Truth::Effect& effect, const Verdict::Cause& cause) {
  const auto values = [](const auto& parameters, const std::vector<std::string>& names, auto value) {
    std::vector<double> result;
    for (const auto& name : names)
      if (const auto at = parameters.find(name); at != parameters.end()) result.push_back(value(at->second));
    return result;
  };
  const bool wall = effect.id == "unmapped_wall";
  const std::vector<std::string> names =
      wall ? std::vector<std::string>{"x0", "y0", "x1", "y1"} : std::vector<std::string>{"x", "y"};
  const auto truth = values(effect.parameters, names, [](double v) { return v; });
  const auto said = values(cause.parameters, names, [](const auto& v) { return v.value; });
  if (truth.size() != names.size() || said.size() != names.size()) return;
  if (wall)
    grades.places.wall.push_back(segment_distance(truth, said));
  else if (effect.id == "obstacle")
    grades.places.obstacle.push_back(std::hypot(truth[0] - said[0], truth[1] - said[1]));
  const auto loss = cause.parameters.find("loss");
  const auto true_loss = effect.parameters.find("loss");
  if (wall && loss != cause.parameters.end() && true_loss != effect.parameters.end())
    grades.places.wall_loss.push_back(std::abs(loss->second.value - true_loss->second));
}

// Parameter errors. A wall's ends have no order, so its error is that of the whole segment, not of single
// coordinates. Values on another row do not count: for two receivers, one too low equals the other too high.
void add_parameters(Grades& grades, const Truth::Effect& effect, const Verdict::Cause& cause) {
  if (!effect.rows.empty() && !at_right_row(effect, cause)) return;
  add_place(grades, effect, cause);
  // rad; a rectangle is the same after half a turn
  static const std::map<std::string, double> periods{{"direction", 2 * M_PI}, {"phase", 2 * M_PI}, {"heading", M_PI}};
  for (const auto& [name, value] : effect.parameters) {
    const auto said = cause.parameters.find(name);
    if (said == cause.parameters.end() || name == "x0" || name == "y0" || name == "x1" || name == "y1") continue;
    double error = said->second.value - value;
    const auto period = periods.find(name);
    const double turn = period == periods.end() ? 0 : std::round(error / period->second) * period->second;
    error -= turn;
    if (value != 0) grades.relative_errors.push_back(std::abs(error / value));
    if (said->second.lower95 && said->second.upper95)
      grades.covered.count(*said->second.lower95 - turn <= value && value <= *said->second.upper95 - turn);
  }
}

// Settled: with the advised readings the right cause is first, and no alternative is left.
void add_followed(Grades& grades, const Truth& truth, const Verdict& verdict) {
  if (!verdict.advised_decides || !verdict.named_when_followed) return;
  const auto& after = *verdict.named_when_followed;
  const auto right = [&](const std::vector<Verdict::Cause>& named) {
    return !named.empty() &&
           std::any_of(truth.effects.begin(), truth.effects.end(), [&](const auto& e) { return names(named[0], e); });
  };
  const bool settled = right(after) && after[0].rivals.empty();
  grades.shares["advice / top name right before / all"].count(right(verdict.named));
  grades.shares["advice / top name right when followed / all"].count(right(after));
  grades.shares["advice / settles the name / all"].count(settled);
  if (*verdict.advised_decides) grades.shares["advice / settles the name / predicted to"].count(settled);
}

void add_inside(Grades& grades, const Truth& truth, const Verdict& verdict) {
  const std::string bin = lambda_bin(weakest(truth));
  const auto count = [&](const std::string& measure, bool hit) {
    grades.shares[truth.kind + " / " + measure + " / " + bin].count(hit);
    grades.shares[truth.kind + " / " + measure + " / all"].count(hit);
  };
  const int hits = most_found(truth, verdict, [](const auto& c, const auto& e) { return names(c, e); });
  const int class_hits =
      most_found(truth, verdict, [](const auto& c, const auto& e) { return names(c, e) || same_class(e, c); });
  for (const auto& effect : truth.effects) {
    const Verdict::Cause* cause = found(verdict, effect);
    grades.by_effect[effect.id + " / " + lambda_bin(effect.lambda)].count(is_found(verdict, effect));
    if (!cause) continue;
    const bool right_row = effect.rows.empty() || at_right_row(effect, *cause);
    if (right_row) add_parameters(grades, effect, *cause);  // on another radio they are other quantities
    if (!effect.rows.empty()) count("right row, where found", right_row);
  }
  const int all = static_cast<int>(truth.effects.size());
  const auto is_true = [&](const Verdict::Cause& c) {
    return std::any_of(truth.effects.begin(), truth.effects.end(), [&](const auto& e) { return names(c, e); });
  };
  const auto is_kin = [&](const Verdict::Cause& c) {
    return std::any_of(truth.effects.begin(), truth.effects.end(), [&](const auto& e) { return same_class(e, c); });
  };
  count("found", hits == all);
  count("found, by class", class_hits == all);
  if (all > 1) count("at least one found", hits > 0);
  count("top name right", !verdict.named.empty() && is_true(verdict.named[0]));
  count("top name right, by class", !verdict.named.empty() && is_kin(verdict.named[0]));
  const bool nothing_else = std::all_of(verdict.named.begin(), verdict.named.end(), is_true);
  count("wrong extra name", hits > 0 && !nothing_else);
  if (verdict.second_silent && hits == all && nothing_else)
    grades.shares["loop / second data silent / where all was told"].count(*verdict.second_silent);
  count("only wrong names", hits == 0 && !verdict.named.empty());
  count("silent", verdict.named.empty() && verdict.unexplained.empty());
  // Several causes of one id for one effect: a wall in pieces.
  count("one effect in pieces", std::any_of(truth.effects.begin(), truth.effects.end(), [&](const auto& e) {
          return std::count_if(verdict.named.begin(), verdict.named.end(), [&](const auto& c) { return names(c, e); }) >
                 1;
        }));
  add_followed(grades, truth, verdict);
  if (truth.oracle_gain > 0 && verdict.gain) {
    grades.gain[bin] += *verdict.gain;
    grades.oracle[bin] += truth.oracle_gain;
  }
}

void add_outside(Grades& grades, const Truth& truth, const Verdict& verdict) {
  const auto& effect = truth.effects.at(0);
  const bool hit = reported_along_covariate(verdict, effect) || found(verdict, effect);
  const bool false_name =
      std::any_of(verdict.named.begin(), verdict.named.end(), [&](const auto& cause) { return !names(cause, effect); });
  for (const std::string& bin : {lambda_bin(effect.lambda), std::string("all")}) {
    grades.shares["outside / right covariate / " + bin].count(hit);
    grades.shares["outside / false name / " + bin].count(false_name);
    grades.shares["outside / silent / " + bin].count(verdict.named.empty() && verdict.unexplained.empty());
  }
  grades.by_effect[effect.id + " / " + lambda_bin(effect.lambda)].count(hit);
}

}  // namespace

double Share::lower95() const {
  return hits == 0 ? 0 : root([&](double p) { return 1 - cumulative(hits - 1, of, p) > 0.025; });
}
double Share::upper95() const {
  return hits == of ? 1 : root([&](double p) { return cumulative(hits, of, p) < 0.025; });
}

int least_hits(int of, double share) {
  int hits = 0;
  while (hits < of && cumulative(hits, of, share) < 0.001) ++hits;
  return hits;
}

std::string lambda_bin(double lambda) {
  if (lambda < 10) return "lambda < 10";
  if (lambda < 20) return "lambda 10-20";
  if (lambda < 30) return "lambda 20-30";
  return lambda < 50 ? "lambda 30-50" : "lambda >= 50";
}

double segment_distance(const std::vector<double>& a, const std::vector<double>& b) {
  constexpr int points = 50;
  const auto away = [](const std::vector<double>& from, const std::vector<double>& to) {
    double sum = 0;
    for (int i = 0; i <= points; ++i) {
      const double u = static_cast<double>(i) / points, x = from[0] + u * (from[2] - from[0]),
                   y = from[1] + u * (from[3] - from[1]);
      const double dx = to[2] - to[0], dy = to[3] - to[1], square = std::max(dx * dx + dy * dy, 1e-12);
      const double v = std::clamp(((x - to[0]) * dx + (y - to[1]) * dy) / square, 0.0, 1.0);
      sum += std::hypot(x - to[0] - v * dx, y - to[1] - v * dy) / (points + 1);
    }
    return sum;
  };
  return (away(a, b) + away(b, a)) / 2;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::numeric_limits<double>::quiet_NaN();
  std::sort(values.begin(), values.end());
  const double at = share * static_cast<double>(values.size() - 1);
  const auto low = static_cast<std::size_t>(at), high = std::min(low + 1, values.size() - 1);
  return values[low] + (at - static_cast<double>(low)) * (values[high] - values[low]);
}

void add(Grades& grades, const Truth& truth, const Verdict& verdict) {
  if (verdict.loop) grades.shares["loop / rediagnosis silent / all"].count(*verdict.loop == "silent");
  if (verdict.second_silent) grades.shares["loop / second data silent / all"].count(*verdict.second_silent);
  if (truth.kind != "clean") add_each_effect(grades, truth, verdict);
  if (truth.kind == "outside") return add_outside(grades, truth, verdict);
  if (truth.kind != "clean") return add_inside(grades, truth, verdict);
  grades.shares["clean / false name / all"].count(!verdict.named.empty());
  grades.shares["clean / false unexplained / all"].count(!verdict.unexplained.empty());
  grades.shares["clean / verdict adequate / all"].count(verdict.verdict == "adequate");
}

}  // namespace muster::exam
