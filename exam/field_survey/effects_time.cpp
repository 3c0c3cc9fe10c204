// What changes while a campaign goes on, of all levels or of what one radio sends.
#include <numbers>
#include <set>

#include "exam/field_survey/effects.hpp"

namespace muster::exam::survey {
namespace {

struct When {
  double span = 0;  // s
  int radio = -1;   // the sender concerned; -1: all
};

std::optional<When> when(const Campaign& campaign, Draws& draws, Planted& planted) {
  if (campaign.clock == Clock::none) return {};
  When result{campaign.rows.back().t};
  std::set<int> senders;
  for (const Row& row : campaign.rows) senders.insert(row.tx);
  if (senders.size() > 1 && draws.flip()) {
    result.radio = draws.one_of(std::vector<int>(senders.begin(), senders.end()));
    planted.rows = {"radio/" + campaign.scene.radios[static_cast<std::size_t>(result.radio)].name};
    planted.also.push_back("tx_" + planted.id);
  }
  return result;
}

// Adds `shape` of time to the rows concerned.
void applied(Planted& planted, int radio, std::function<double(double)> shape) {
  planted.apply = [radio, shape = std::move(shape)](Scene&, Scene& truth) {
    truth.terms.emplace_back(
        [=](const Path& path) { return radio < 0 || path.row.tx == radio ? shape(path.row.t) : 0.0; });
  };
}

std::optional<Planted> drift(const Campaign& campaign, Draws& draws) {
  Planted planted{"drift"};
  const auto w = when(campaign, draws, planted);
  if (!w) return {};
  const double whole = draws.sign() * draws.log_between(1.5, 8);
  planted.values = {{"rate", whole / w->span * 3600, "dB/h"}};
  applied(planted, w->radio, [=, span = w->span](double t) { return whole * t / span; });
  return planted;
}

std::optional<Planted> step(const Campaign& campaign, Draws& draws) {
  Planted planted{"step"};
  const auto w = when(campaign, draws, planted);
  if (!w) return {};
  const double at = w->span * draws.between(0.2, 0.8), size = draws.sign() * draws.log_between(1.5, 8);
  planted.values = {{"at", at, "s"}, {"size", size, "dB"}};
  applied(planted, w->radio, [=](double t) { return t >= at ? size : 0.0; });
  return planted;
}

// Twelve readings of a link or more in a period, and three periods or more.
std::optional<Planted> swing(const Campaign& campaign, Draws& draws) {
  Planted planted{"periodic"};
  const auto w = when(campaign, draws, planted);
  std::set<double> times;
  for (const Row& row : campaign.rows) times.insert(campaign.style == "mesh" ? std::floor(row.t / 3600) : row.t);
  if (!w || times.size() < 40) return {};
  const double most = static_cast<double>(times.size()) / 12;
  const double period = w->span / draws.between(3, std::min(most, 30.0)), amplitude = draws.log_between(0.8, 5),
               phase = draws.between(-std::numbers::pi, std::numbers::pi);
  planted.values = {{"period", period, "s"}, {"amplitude", amplitude, "dB"}};
  applied(planted, w->radio, [=](double t) { return amplitude * std::sin(2 * std::numbers::pi * t / period + phase); });
  return planted;
}

// People between one standing radio and the one that is carried.
std::optional<Planted> people(const Campaign& campaign, Draws& draws) {
  if (campaign.style != "flat" || campaign.clock != Clock::seconds) return {};
  const int last = static_cast<int>(campaign.scene.radios.size()) - 1;
  const Passers passers{draws.whole(0, last - 1), last, draws.between(5, 12), draws.between(0.04, 0.15),
                        draws.between(2, 6)};
  Planted planted{"people"};
  planted.acts = "reading_law";
  planted.rows = {"radio/" + campaign.scene.radios[static_cast<std::size_t>(passers.radio)].name};
  planted.values = {{"loss", passers.loss, "dB"}, {"share", passers.share, ""}, {"duration", passers.duration, "s"}};
  planted.apply = [passers](Scene&, Scene& truth) { truth.passers.push_back(passers); };
  return planted;
}

}  // namespace

std::vector<Kind> time_kinds() { return {{"drift", drift}, {"step", step}, {"periodic", swing}, {"people", people}}; }

}  // namespace muster::exam::survey
