// A plan that is mirrored or turned against the places of what moves in it.
#include <cmath>
#include <muster/plugin.hpp>

#include "link_term.hpp"
#include "standing.hpp"

namespace {

using namespace muster;

// Of the fault, in the order of the choices: columns of the matrix that turns a true place into the listed one.
struct Turn {
  double east_x, east_y, north_x, north_y;
};
constexpr Turn turns[] = {{1, 0, 0, 1},   {-1, 0, 0, 1}, {1, 0, 0, -1}, {0, 1, -1, 0},
                          {-1, 0, 0, -1}, {0, -1, 1, 0}, {0, 1, 1, 0},  {0, -1, -1, 0}};

struct PlanTurned {
  static constexpr auto id = "effect.plan_turned/1";
  static constexpr auto summary = "the stations, the robots' places or the walls are mirrored or turned about a point";
  static constexpr auto manual =
      "Undoes that the listed places are the true ones turned about (x, y): east and west exchanged (mirrored_x), "
      "north\n"
      "and south (mirrored_y), turned counter-clockwise by so many degrees, or x and y exchanged (transposed; about "
      "the\n"
      "other diagonal: transposed_back). `of` stations: of radios that stand. `of` robots: of all others. `of` walls:\n"
      "the walls are turned, so all radios are put where they are in the walls' own coordinates. Headings turn too.\n"
      "y changes nothing of mirrored_x, x nothing of mirrored_y.\n"
      "A station that stands at (10, 2) and is listed at (-2, 10) is turned_90 about (0, 0), and is put back.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      choice("of", "stations|robots|walls", "what is listed wrongly").with(MUSTER_EACH),
      choice("how", "as_listed|mirrored_x|mirrored_y|turned_90|turned_180|turned_270|transposed|transposed_back",
             "how it is listed")
          .with(MUSTER_EACH),
      real("x", 0, -1e6, 1e6, "m", "the point that stays, east").required().free().with(MUSTER_EAST),
      real("y", 0, -1e6, 1e6, "m", "the point that stays, north").required().free().with(MUSTER_NORTH),
  };
  static constexpr muster_cause cause = {
      sizeof(muster_cause),
      MUSTER_WORLD_EDIT,
      "the places of the {of} are {how} on the map, about ({x}, {y})",
      "",
      places_in_plan,
      "effect.labels_shifted effect.label_swap effect.plan_shifted effect.tx_misplaced",
      "measure the place of one radio, or levels close to it",
      nullptr,
      MUSTER_FIRST | MUSTER_OWN_WORLD,
  };

  explicit PlanTurned(Setup& s)
      : of(s.value("of")),
        how(s.value("how")),
        x(s.value("x")),
        y(s.value("y")),
        mount(s.read<Mount>("radio/*/mount")),
        endpoint(s.modify<Endpoint>("endpoint/*/radio")),
        pose(s.modify<Pose>("endpoint/*/pose")) {}

  void step(const Step& k) const {
    const auto before = k.before(pose);
    const auto ends = unchanged(k, endpoint);
    const auto out = k[pose];
    const auto wrongly = static_cast<Listed>(static_cast<int>(k[of]));
    const Standing standing(ends, before, k[mount]);
    Turn turn = turns[static_cast<std::size_t>(k[how])];
    if (wrongly != Listed::walls) std::swap(turn.east_y, turn.north_x);  // its inverse
    for (std::size_t i = 0; i < out.size(); ++i) {
      const bool turned = k[how] != 0 && standing.concerned(ends[i].radio, wrongly);
      out[i] = turned ? seen(before[i], turn, k[x], k[y]) : before[i];
    }
  }

  static Pose seen(const Pose& from, const Turn& turn, double x, double y) {
    const double east = from.x - x, north = from.y - y, heading = yaw(from);
    const double c = std::cos(heading), s = std::sin(heading);
    Pose to = from;
    to.x = x + turn.east_x * east + turn.north_x * north;
    to.y = y + turn.east_y * east + turn.north_y * north;
    const double by = std::atan2(turn.east_y * c + turn.north_y * s, turn.east_x * c + turn.north_x * s) - heading;
    const double w = std::cos(by / 2), z = std::sin(by / 2);
    to.qw = w * from.qw - z * from.qz;
    to.qx = w * from.qx - z * from.qy;
    to.qy = w * from.qy + z * from.qx;
    to.qz = w * from.qz + z * from.qw;
    return to;
  }

  Value of, how, x, y;
  In<Mount> mount;
  Stage<Endpoint> endpoint;  // unchanged: in line with other edits of either
  Stage<Pose> pose;
};

}  // namespace

MUSTER_PLUGIN_IS(PlanTurned)
