// Measured readings as links, so that every term of a channel is evaluated at the places and times of measurement.
#include <cmath>
#include <muster/plugin.hpp>
#include <string>

namespace {

using namespace muster;

// Required columns of a row of the measured table, which place its radios.
struct Reading {
  static constexpr const char* columns =
      "t[s]? tx:radio+ rx:radio+ tx_x[m]? tx_y[m]? tx_z[m]? tx_yaw[rad]? rx_x[m]? rx_y[m]? rx_z[m]? rx_yaw[rad]? "
      "distance[m]?";
  struct Place {
    double x, y, z, yaw;
  };
  double t, tx, rx;
  Place from, to;
  double distance;

  bool has_places() const { return !is_null(from.x) && !is_null(from.y) && !is_null(to.x) && !is_null(to.y); }
};

struct DataLinks {
  static constexpr auto id = "data.links/2";
  static constexpr auto summary = "lists the links of a table of measured readings";
  static constexpr auto manual =
      "Lists in every tick all readings of `file`: reading i is link i, from endpoint 2 i to endpoint 2 i + 1, at the\n"
      "places and the time that were measured. It stands in for radio.links; the terms of the channel do not notice.\n"
      "Columns: t[s],tx,rx,tx_x[m],tx_y[m],tx_z[m],tx_yaw[rad],rx_x[m],rx_y[m],rx_z[m],rx_yaw[rad]; t, z and yaw may\n"
      "be absent: then the time is the tick's, height and heading are those of the radio's mount,\n"
      "such as the yaw of a station; a robot's own is not known.\n"
      "Without x and y, distance[m]: the sender stands at the origin, the receiver so far to the east of it.\n"
      "`aside` and `along` move whole links and change neither lengths nor bearings: what changes all the same, such "
      "as\n"
      "which walls are crossed, hangs on how well places are known.";
  static constexpr auto phase = MUSTER_RADIO;
  static constexpr Param params[] = {
      file("file", "measured readings, a CSV table with units").required(),
      real("aside", 0, -10, 10, "m", "both ends of each link, to the left of the way from sender to receiver"),
      real("along", 0, -10, 10, "m", "both ends of each link, along that way")};

  explicit DataLinks(Setup& s)
      : readings(s.file<Reading>("file")),
        aside(s.value("aside")),
        along(s.value("along")),
        mount(s.read<Mount>("radio/*/mount")),
        endpoint(s.write<Endpoint>("endpoint/*/radio")),
        pose(s.write<Pose>("endpoint/*/pose")),
        ends(s.write<Ends>("link/*/ends")) {}

  void step(const Step& k) const {
    const auto measured = k[readings];
    const auto mounts = k[mount];
    const auto radios = k.append(endpoint, 2 * measured.size());
    const auto poses = k.append(pose, 2 * measured.size());
    const auto links = k.append(ends, measured.size());
    for (std::size_t i = 0; i < measured.size(); ++i) {
      const Reading& it = measured[i];
      const double t = is_null(it.t) ? k.time() : it.t;
      radios[2 * i] = {it.tx, t};
      radios[2 * i + 1] = {it.rx, t};
      if (it.has_places()) {
        poses[2 * i] = placed(it.from, mounts[static_cast<std::size_t>(it.tx)]);
        poses[2 * i + 1] = placed(it.to, mounts[static_cast<std::size_t>(it.rx)]);
        if (k[aside] != 0 || k[along] != 0) move(poses[2 * i], poses[2 * i + 1], k[aside], k[along]);
      } else {
        if (!(it.distance > 0))  // null too
          throw BadInput("row " + std::to_string(i + 1) + " of the readings has neither both places nor a distance");
        poses[2 * i] = {0, 0, 0, 1, 0, 0, 0};
        poses[2 * i + 1] = {it.distance, 0, 0, 1, 0, 0, 0};
      }
      links[i] = {static_cast<double>(2 * i), static_cast<double>(2 * i + 1)};
    }
  }

  static Pose placed(const Reading::Place& at, const Mount& on) {
    const double yaw = is_null(at.yaw) ? on.yaw : at.yaw;
    return {at.x, at.y, is_null(at.z) ? on.z : at.z, std::cos(yaw / 2), 0, 0, std::sin(yaw / 2)};
  }

  static void move(Pose& from, Pose& to, double aside, double along) {
    const double x = to.x - from.x, y = to.y - from.y, way = std::hypot(x, y);
    if (way == 0) return;
    for (Pose* end : {&from, &to}) {
      end->x += (along * x - aside * y) / way;
      end->y += (along * y + aside * x) / way;
    }
  }

  In<Reading> readings;
  Value aside, along;
  In<Mount> mount;
  Out<Endpoint> endpoint;
  Out<Pose> pose;
  Out<Ends> ends;
};

}  // namespace

MUSTER_PLUGIN_IS(DataLinks)
