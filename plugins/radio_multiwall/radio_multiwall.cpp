// The multi-wall model of COST 231: distance, walls and floors, as two terms of the received level.
#include <muster/plugin.hpp>
#include <vector>

#include "link_geometry.hpp"

namespace {

using namespace muster;

struct RadioMultiwall {
  static constexpr auto id = "radio.multiwall/2";
  static constexpr auto summary = "path loss by distance and by the walls and floors that a link crosses";
  static constexpr auto manual =
      "level@distance = tx_power - l0 - 10 n log10(d), d in metres and at least 0.01;\n"
      "level@walls    = - sum over materials of (walls and floors crossed) x material/NAME/loss.\n"
      "l0 is of the mean power beside fading, else of the mean dB (docs/explanation/fit_method.md).\n"
      "Crossings are exact, in three dimensions, and the same both ways; a closed door counts as its material, an "
      "open\n"
      "one as nothing. Thickness and angle of incidence do not change a wall's loss.\n"
      "COST Action 231, Digital mobile radio towards future generation systems, final report, section 4.7 (1999).";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr bool keeps_only_caches = true;
  static constexpr Param params[] = {
      real("tx_power", 0, -100, 100, "dBm", "transmit power"),
      real("l0", 40, -30, 150, "dB", "loss at 1 m, less antenna gains").free(),
      real("n", 2, 0, 10, "", "path-loss exponent; only with model=\"multi_wall|log_distance\"").free(),
      choice("model", "multi_wall|log_distance|disc|perfect", "what is modelled"),
      real("radius", 20, 0.01, 1e6, "m", "of the disc; only with model=\"disc\""),
  };

  explicit RadioMultiwall(Setup& s)
      : tx_power(s.value("tx_power")),
        l0(s.value("l0")),
        n(s.value("n")),
        model(s.value("model")),
        radius(s.value("radius")),
        pose(s.read<Pose>("endpoint/*/pose")),
        ends(s.read<Ends>("link/*/ends")),
        wall(s.read<Wall>("wall/*/shape")),
        door(s.read<Door>("door/*/shape")),
        state(s.read<DoorState>("door/*/state")),
        floor(s.read<FloorShape>("floor/*/shape")),
        loss(s.read<Loss>("material/*/loss")),
        distance(s.add<Level>("link/*/level@distance")),
        walls(s.add<Level>("link/*/level@walls")) {}

  void step(const Step& k) {
    const auto losses = k[loss];
    try {
      geometry.set_scene(k[wall], k[door], k[state], k[floor], losses.size());
      geometry.set_links(k[ends], k[pose]);
    } catch (const std::runtime_error& e) {  // throws for walls, doors, floors and places, which are the user's input
      throw BadInput(e.what());
    }
    const auto& far = geometry.log_distances();
    const double slope = k[model] <= log_distance ? 10 * k[n] : 0, at_1m = k[tx_power] - k[l0];
    const auto by_distance = k[distance];
    for (std::size_t i = 0; i < far.size(); ++i) by_distance[i].level = at_1m - slope * far[i];
    const double edge = std::log10(k[radius]);
    for (std::size_t i = 0; k[model] == disc && i < far.size(); ++i) {
      if (far[i] > edge) by_distance[i].level = at_1m - 200;
    }
    std::vector<double> each;
    for (const Loss& material : losses) each.push_back(k[model] == multi_wall ? material.loss : 0);
    geometry.wall_losses(each, lost);
    const auto by_walls = k[walls];
    for (std::size_t i = 0; i < far.size(); ++i) by_walls[i].level = 0 - lost[geometry.pair(i)];
  }

  enum Model { multi_wall, log_distance, disc, perfect };

  Value tx_power, l0, n, model, radius;
  In<Pose> pose;
  In<Ends> ends;
  In<Wall> wall;
  In<Door> door;
  In<DoorState> state;
  In<FloorShape> floor;
  In<Loss> loss;
  Out<Level> distance, walls;
  LinkGeometry geometry;
  std::vector<double> lost;  // loss through walls, of each pair
};

}  // namespace

MUSTER_PLUGIN_IS(RadioMultiwall)
