#include "exam/case_spec.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace muster::exam {
namespace {

bool wanted(const Syllabus& syllabus, const Recipe& r) {
  const auto& ids = syllabus.effects;
  if (r.needs.plan.corridor_station && !syllabus.corridor) return false;
  return ids.empty() || std::find(ids.begin(), ids.end(), r.id) != ids.end();
}

// Each effect in turn, including those outside the vocabulary.
const Recipe& in_turn(const Syllabus& syllabus, int number) {
  std::vector<const Recipe*> all;
  for (const Recipe& r : recipes()) {
    if (wanted(syllabus, r)) all.push_back(&r);
  }
  if (all.empty()) throw std::invalid_argument("no effect is left for cases of kind \"each\"");
  return *all[static_cast<std::size_t>(number - 1) % all.size()];
}

std::size_t how_many(const std::string& kind) { return kind == "three" ? 3 : kind == "two" ? 2 : 1; }

std::vector<std::string> candidates(const Syllabus& syllabus, const std::string& kind) {
  std::vector<std::string> result;
  for (const Recipe& r : recipes()) {
    // Exchanged names move every level of two stations: another effect would lose its meaning.
    const bool alone = std::string_view(r.id) == "label_swap";
    if (wanted(syllabus, r) && r.in_vocabulary == (kind != "outside") && !(how_many(kind) > 1 && alone))
      result.push_back(r.id);
  }
  if (result.empty()) throw std::invalid_argument("no effect is left for cases of kind \"" + kind + "\"");
  return result;
}

// False for two laws of single readings: their joint scatter identifies neither.
bool go_together(const std::string& a, const std::string& b) {
  const auto scatters = [](const std::string& id) {
    return id == "fading_law" || id == "channel_mixture" || id == "outliers";
  };
  const auto clips = [](const std::string& id) { return id == "rssi_floor" || id == "rssi_saturation"; };
  return a != b && !(scatters(a) && scatters(b)) && !(clips(a) && clips(b));
}

double log_uniform(Random& random, double low, double high) { return low * std::pow(high / low, random.uniform()); }

}  // namespace

std::uint64_t seed_of(const Syllabus& syllabus, int number) {
  return Random(syllabus.seed, "case " + std::to_string(number)).bits();
}

std::string name_of(int number) { return fmt::format("case_{:04}", number); }

Order draw_order(const Syllabus& syllabus, int number) {
  Random random(seed_of(syllabus, number), "order");
  Order order{random.pick(syllabus.kinds),
              {},
              {},
              static_cast<int>(log_uniform(random, syllabus.least_rows, syllabus.most_rows)),
              syllabus.walls};
  if (order.kind == "clean") return order;
  if (order.kind == "each") {
    const Recipe& r = in_turn(syllabus, number);
    order.kind = r.in_vocabulary ? "one" : "outside";
    order.effects.push_back(r.id);
  } else {
    order.effects.push_back(random.pick(candidates(syllabus, order.kind)));
  }
  while (order.effects.size() < how_many(order.kind)) {
    const std::vector<std::string> from = candidates(syllabus, order.kind);
    std::vector<std::string> others;
    std::copy_if(from.begin(), from.end(), std::back_inserter(others), [&](const auto& id) {
      return std::all_of(order.effects.begin(), order.effects.end(),
                         [&](const auto& one) { return go_together(one, id); });
    });
    if (others.empty()) throw std::invalid_argument("no other effect is left beside \"" + order.effects[0] + "\"");
    order.effects.push_back(random.pick(others));
  }
  for (std::size_t i = 0; i < order.effects.size(); ++i)
    order.lambdas.push_back(log_uniform(random, syllabus.least_lambda, syllabus.most_lambda));
  return order;
}

}  // namespace muster::exam
