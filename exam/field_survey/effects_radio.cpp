// Radios: powers, receivers, antennas, bodies.
#include <algorithm>
#include <iterator>
#include <numbers>
#include <set>

#include "exam/field_survey/effects.hpp"

namespace muster::exam::survey {
namespace {

constexpr double turn = 2 * std::numbers::pi;

std::vector<int> ends(const Campaign& campaign, int Row::*end) {
  std::set<int> distinct;
  for (const Row& row : campaign.rows) distinct.insert(row.*end);
  return {distinct.begin(), distinct.end()};
}

const std::string& name(const Campaign& campaign, int radio) {
  return campaign.scene.radios[static_cast<std::size_t>(radio)].name;
}

// A shift of one radio's readings as sender or as receiver, of several.
std::optional<Planted> offset(const char* id, int Row::*end, const Campaign& campaign, Draws& draws) {
  const std::vector<int> radios = ends(campaign, end);
  if (radios.size() < 2) return {};
  const int which = draws.one_of(radios);
  const double size = -draws.log_between(1.5, 10);
  Planted planted{id};
  planted.rows = {"radio/" + name(campaign, which)};
  planted.also = {"asymmetry"};
  planted.values = {{"offset", size, "dB"}};
  planted.apply = [=](Scene&, Scene& truth) {
    truth.terms.emplace_back([=](const Path& path) { return path.row.*end == which ? size : 0.0; });
  };
  return planted;
}

std::optional<Planted> weak_sender(const Campaign& campaign, Draws& draws) {
  return offset("tx_offset", &Row::tx, campaign, draws);
}
std::optional<Planted> deaf_receiver(const Campaign& campaign, Draws& draws) {
  return offset("rx_offset", &Row::rx, campaign, draws);
}

// A bad cable of one radio, of those that send and receive.
std::optional<Planted> bad_feeder(const Campaign& campaign, Draws& draws) {
  const std::vector<int> sending = ends(campaign, &Row::tx), receiving = ends(campaign, &Row::rx);
  std::vector<int> both;
  std::set_intersection(sending.begin(), sending.end(), receiving.begin(), receiving.end(), std::back_inserter(both));
  if (both.size() < 3) return {};
  const int which = draws.one_of(both);
  const double loss = draws.log_between(1.5, 10);
  Planted planted{"feeder_loss"};
  planted.rows = {"radio/" + name(campaign, which)};
  planted.values = {{"loss", loss, "dB"}};
  planted.apply = [=](Scene&, Scene& truth) {
    truth.terms.emplace_back(
        [=](const Path& path) { return path.row.tx == which || path.row.rx == which ? -loss : 0.0; });
  };
  return planted;
}

// A radio that stands.
std::optional<int> standing(const Campaign& campaign, Draws& draws) {
  std::vector<int> radios;
  for (std::size_t i = 0; i < campaign.scene.radios.size(); ++i)
    if (!campaign.scene.radios[i].moves) radios.push_back(static_cast<int>(i));
  if (radios.empty()) return {};
  return draws.one_of(radios);
}

// Direction in the plan from one end to the other; nothing where the radio is neither.
std::optional<double> bearing(const Path& path, int radio) {
  if (path.row.tx == radio) return std::atan2(path.rx.y - path.tx.y, path.rx.x - path.tx.x);
  if (path.row.rx == radio) return std::atan2(path.tx.y - path.rx.y, path.tx.x - path.rx.x);
  return {};
}

std::optional<Planted> one_lobe(const Campaign& campaign, Draws& draws) {
  const auto which = standing(campaign, draws);
  if (!which) return {};
  const double amplitude = draws.between(2, 8), direction = draws.between(-turn / 2, turn / 2);
  Planted planted{"antenna_tx"};
  planted.rows = {"radio/" + name(campaign, *which)};
  planted.also = {"antenna_rx"};
  planted.kin = {"body_shadow", "sector_antenna"};
  planted.values = {{"amplitude", amplitude, "dB"}, {"direction", direction, "rad"}};
  planted.apply = [=](Scene&, Scene& truth) {
    truth.terms.emplace_back([=](const Path& path) {
      const auto b = bearing(path, *which);
      return b ? amplitude * std::cos(*b - direction) : 0.0;
    });
  };
  return planted;
}

// A panel antenna: 12 (angle / beam width)^2 dB below its middle, at most 20 dB.
std::optional<Planted> sector(const Campaign& campaign, Draws& draws) {
  const auto which = standing(campaign, draws);
  if (!which) return {};
  const double width = draws.between(1.05, 1.6), direction = draws.between(-turn / 2, turn / 2);
  Planted planted{"sector_antenna"};
  planted.rows = {"radio/" + name(campaign, *which)};
  planted.kin = {"antenna_tx", "antenna_rx", "body_shadow"};
  planted.values = {
      {"front_to_back", 20, "dB"}, {"direction", direction, "rad"}, {"edge", width * std::sqrt(20.0 / 12), "rad"}};
  planted.apply = [=](Scene&, Scene& truth) {
    truth.terms.emplace_back([=](const Path& path) {
      const auto b = bearing(path, *which);
      const double off = b ? std::remainder(*b - direction, turn) / width : 0;
      return b ? -std::min(12 * off * off, 20.0) : 0.0;
    });
  };
  return planted;
}

// The body behind the carried radio, with flanks of a tenth of a radian.
std::optional<Planted> body(const Campaign& campaign, Draws& draws) {
  const auto carried =
      std::find_if(campaign.scene.radios.begin(), campaign.scene.radios.end(), [](const Radio& r) { return r.moves; });
  if (carried == campaign.scene.radios.end() || !campaign.headings) return {};
  const int which = static_cast<int>(carried - campaign.scene.radios.begin());
  const double loss = draws.between(3, 12), width = draws.between(1, 2.2),
               behind = draws.flip(0.7) ? turn / 2 : turn / 4;
  Planted planted{"body_shadow"};
  planted.rows = {"radio/" + carried->name};
  planted.also = {"antenna_rx", "antenna_tx"};
  planted.values = {{"loss", loss, "dB"}, {"direction", behind, "rad"}, {"width", width, "rad"}};
  planted.apply = [=](Scene&, Scene& truth) {
    truth.terms.emplace_back([=](const Path& path) {
      const auto b = bearing(path, which);
      if (!b) return 0.0;
      const double heading = path.row.tx == which ? path.tx_yaw : path.rx_yaw;
      const double off = std::abs(std::remainder(*b - heading - behind, turn));
      return -loss * std::clamp((width / 2 - off) / 0.1 + 0.5, 0.0, 1.0);
    });
  };
  return planted;
}

std::optional<Planted> wrong_powers(const Campaign& campaign, Draws& draws) {
  if (campaign.powers.empty()) return {};
  std::vector<double> errors{0};
  for (std::size_t i = 1; i < campaign.powers.size(); ++i) errors.push_back(draws.sign() * draws.log_between(0.8, 5));
  Planted planted{"power_steps"};
  planted.apply = [errors](Scene&, Scene& truth) {
    truth.terms.emplace_back([errors](const Path& path) { return errors[static_cast<std::size_t>(path.row.power)]; });
  };
  return planted;
}

}  // namespace

std::vector<Kind> radio_kinds() {
  return {{"tx_offset", weak_sender},   {"rx_offset", deaf_receiver}, {"feeder_loss", bad_feeder},
          {"antenna_tx", one_lobe},     {"sector_antenna", sector},   {"body_shadow", body},
          {"power_steps", wrong_powers}};
}

}  // namespace muster::exam::survey
