// Causes of how readings scatter.
#include "exam/simulated/planted_cause.hpp"

namespace muster::exam::simulated {
namespace {

std::optional<PlantedCause> people(const Setting& s, Random& random) {
  const std::string station = random.pick(s.site.plan.stations).name,
                    robot = "robot" + std::to_string(1 + random.below(s.site.robots));
  PlantedCause cause{"people", Acts::blockage};
  cause.texts = {{"radio", station}, {"other", robot}};
  cause.rows = {"radio/" + station, "radio/" + robot};
  cause.numbers = {{"loss", random.uniform(5, 14), "dB"},
                   {"share", random.uniform(0.04, 0.15)},
                   {"duration", random.uniform(2, 8), "s"}};
  return cause;
}

std::optional<PlantedCause> outliers(const Setting&, Random& random) {
  PlantedCause cause{"outliers", Acts::reading_law};
  cause.numbers = {{"share", random.uniform(0.01, 0.1)}, {"half_width", 20, "dB"}};
  return cause;
}

std::optional<PlantedCause> channels(const Setting&, Random& random) {
  PlantedCause cause{"channel_mixture", Acts::reading_law};
  cause.numbers = {{"sd", random.uniform(2, 7), "dB"}};
  return cause;
}

// Draws anew for each reading, which only a world whose fading does so can be held against.
std::optional<PlantedCause> fading_law(const Setting& s, Random& random) {
  if (!s.fades_by_reading) return {};
  const double k = s.rician_k < 3 ? random.uniform(7, 12) : random.uniform(-10, s.rician_k - 3);
  PlantedCause cause{"fading_law", Acts::reading_law};
  cause.numbers = {{"rician_k", k, "dB"}};
  return cause;
}

std::optional<PlantedCause> shadowing(const Setting& s, Random& random) {
  if (s.shadowing < 1) return {};
  PlantedCause cause{"shadowing_correlation", Acts::field_law};
  cause.numbers = {{"shadowing", s.shadowing * random.uniform(0.6, 1.6), "dB"},
                   {"decorrelation",
                    s.decorrelation * (random.chance(0.5) ? random.uniform(0.3, 0.6) : random.uniform(1.8, 3)), "m"}};
  return cause;
}

}  // namespace

std::vector<CauseKind> law_causes() {
  return {{"people", {}, people},
          {"outliers", {}, outliers},
          {"channel_mixture", {}, channels},
          {"fading_law", {}, fading_law},
          {"shadowing_correlation", {}, shadowing}};
}

}  // namespace muster::exam::simulated
