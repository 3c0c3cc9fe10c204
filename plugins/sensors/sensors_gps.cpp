// Satellite positioning: places on the globe, with errors that last, and none where the sky is hidden.
#include <algorithm>
#include <array>
#include <cmath>
#include <muster/globe.hpp>
#include <muster/plugin.hpp>
#include <muster/senses.hpp>
#include <optional>
#include <string>
#include <vector>

#include "bearer.hpp"
#include "obstructions.hpp"
#include "plugins/periods.hpp"
#include "plugins/table_rows.hpp"
#include "turn.hpp"

namespace {

using namespace muster;

struct SensorsGps {
  static constexpr auto id = "sensors.gps/1";
  static constexpr auto summary = "places of robots by satellites: latitude, longitude, altitude; denied under roofs";
  static constexpr auto manual =
      R"(At `rate` a receiver at x, y, z of the body tells in robot/*/gps where it is: east, north and up of the world's
origin, which is at `latitude`, `longitude` and `altitude` of WGS 84, and the same place on the globe. The world's x is
east, its y north. The instance serves `robot`, or all robots that no other instance names.
Errors: on each of east and north a first-order Gauss-Markov process of standard deviation `horizontal` that
decorrelates as exp(-t/correlation), and white noise `white`; on up the same with `vertical` and `white_up`. Each robot
draws its own: receivers side by side share no error here, as they would in part.
Denied (the place is empty, its time is not): inside an area of the table `areas`; and where less than `least_sky` of
the sky is seen. That is the share of 33 directions (the zenith, and eight each at 15, 35, 55 and 75 degrees) in which
no wall, closed door or floor with a loss of `opaque` or more stands within 200 m. Under a ceiling without walls, or in
a street, the low or the high ones alone are seen. Meshes and robots hide nothing. Not modelled: single satellites and
their geometry, multipath, the time to a first fix, velocities by Doppler.)";
  static constexpr auto phase = MUSTER_SENSE;
  static constexpr Param params[] = {
      bearer_param(),
      real("rate", 5, 0, 1e6, "Hz", "of readings, at most one a step; 0: each step"),
      real("latitude", 0, -90, 90, "deg", "of the world's origin"),
      real("longitude", 0, -180, 180, "deg", "of the world's origin"),
      real("altitude", 0, -1e4, 1e5, "m", "of the world's origin, above the ellipsoid"),
      real("x", 0, -1e3, 1e3, "m", "place of its antenna on the body, forward"),
      real("y", 0, -1e3, 1e3, "m", "to the left"),
      real("z", 0, -1e3, 1e3, "m", "up"),
      real("horizontal", 0, 0, 1e3, "m", "standard deviation of the lasting error, east and north each").free(),
      real("vertical", 0, 0, 1e3, "m", "standard deviation of the lasting error of up").free(),
      real("correlation", 60, 1e-3, 1e6, "s", "time in which the lasting errors fall to 1/e").free(),
      real("white", 0, 0, 1e3, "m", "standard deviation of white noise, east and north each").free(),
      real("white_up", 0, 0, 1e3, "m", "standard deviation of white noise of up").free(),
      real("least_sky", 0.3, 0, 1, "", "share of the sky that it needs; 0: it works everywhere"),
      real("opaque", 0, 0, 1000, "dB", "least loss on the way that hides a satellite"),
      file("areas", "a table x0[m],y0[m],x1[m],y1[m] of areas where it is denied"),
  };

  struct Area {
    static constexpr const char* columns = "x0[m] y0[m] x1[m] y1[m] .";
    double x0, y0, x1, y1;
  };

  // The lasting errors. `of`: 1 + the robot's row; a robot that joins as a copy of another draws its own.
  struct Errors {
    static constexpr const char* columns = "of east[m] north[m] up[m]";
    double of, error[3];
  };

  explicit SensorsGps(Setup& s)
      : bearer(s),
        rate(s.value("rate")),
        origin{s.value("latitude"), s.value("longitude"), s.value("altitude")},
        mount{s.value("x"), s.value("y"), s.value("z")},
        horizontal(s.value("horizontal")),
        vertical(s.value("vertical")),
        correlation(s.value("correlation")),
        white(s.value("white")),
        white_up(s.value("white_up")),
        least_sky(s.value("least_sky")),
        opaque(s.value("opaque")),
        stream(s.stream("gps")),
        pose(s.read<Pose>("robot/*/pose")),
        obstructions(s),
        reading(s.write<Gps>(bearer.table("gps"), MUSTER_SENSED | bearer.flags())),
        errors(s.write<Errors>(bearer.table("gps_errors"), bearer.flags())) {
    if (s.text("areas").empty()) return;
    areas = s.file<Area>("areas");
    places.emplace(s, "areas");
  }

  void step(const Step& k) const {
    if (k.tick() == 0 && areas) warn_of_areas(k);
    const bool is_told = k.tick() == 0 || k[rate] <= 0 || is_due(k.time(), k.dt(), 1 / k[rate]);
    std::optional<Obstructions::Now> sky;
    if (is_told && k[least_sky] > 0) sky.emplace(obstructions, k);
    for (std::size_t i = 0; i < k[reading].size(); ++i) {
      const std::size_t robot = bearer.robot_of(i);
      const bool knows = k.last(errors)[i].of == static_cast<double>(robot + 1);
      k[errors][i] = gone_on(k, robot, knows ? &k.last(errors)[i] : nullptr);
      k[reading][i] = knows ? k.last(reading)[i] : nothing(null());
      if (is_told && k.alive("robot", robot)) k[reading][i] = read(k, robot, k[errors][i], sky);
    }
  }

 private:
  // Areas without extent, in which no robot is, and such as are meant in degrees.
  void warn_of_areas(const Step& k) const {
    constexpr double little = 0.5;  // m; a thousandth of a degree is 100 m
    for (std::size_t i = 0; i < k[*areas].size(); ++i) {
      const Area& a = k[*areas][i];
      const double width = std::abs(a.x1 - a.x0), height = std::abs(a.y1 - a.y0);
      if (width == 0 || height == 0)
        return k.event("warning: " + places->at(i, width == 0 ? "x1" : "y1") + "the area has no " +
                       (width == 0 ? "width: x1 is x0" : "height: y1 is y0") +
                       ", so that no robot is in it; expected two corners");
      if (std::max(width, height) < little && std::max(std::abs(a.x0), std::abs(a.y0)) > 10 * little)
        return k.event("warning: " + places->at(i, "x0") + "the area is less than " +
                       (std::max(width, height) < 0.1 ? "0.1" : "0.5") +
                       " m wide; are these latitude and longitude? expected metres of the plan, x east and y north");
    }
  }

  static Gps nothing(double t) { return {t, null(), null(), null(), null(), null(), null()}; }

  Errors gone_on(const Step& k, std::size_t robot, const Errors* before) const {
    Errors result{static_cast<double>(robot + 1), {}};
    const double kept = before ? std::exp(-k.dt() / k[correlation]) : 0;
    for (unsigned axis = 0; axis < 3; ++axis) {
      const double deviation = k[axis < 2 ? horizontal : vertical] * std::sqrt(1 - kept * kept);
      result.error[axis] = (before ? kept * before->error[axis] : 0) + drawn(k, robot, axis, deviation);
    }
    return result;
  }

  Gps read(const Step& k, std::size_t robot, const Errors& lasting, std::optional<Obstructions::Now>& sky) const {
    const Pose& p = k[pose][robot];
    const Eigen::Vector3d at =
        Eigen::Vector3d(p.x, p.y, p.z) + attitude_of(p) * Eigen::Vector3d(k[mount[0]], k[mount[1]], k[mount[2]]);
    if (is_denied(k, at) || (sky && share_of_sky(k, at, *sky) < k[least_sky])) return nothing(k.time());
    std::array<double, 3> told;
    for (unsigned axis = 0; axis < 3; ++axis)
      told[axis] = at[axis] + lasting.error[axis] + drawn(k, robot, 3 + axis, k[axis < 2 ? white : white_up]);
    const GlobePlane plane({k[origin[0]], k[origin[1]], k[origin[2]]});
    const GlobePoint globe = plane.point(told[0], told[1], told[2]);
    return {k.time(), globe.latitude, globe.longitude, globe.altitude, told[0], told[1], told[2]};
  }

  bool is_denied(const Step& k, const Eigen::Vector3d& at) const {
    if (!areas) return false;
    const auto rows = k[*areas];
    return std::any_of(rows.begin(), rows.end(), [&](const Area& a) {
      return at.x() >= std::min(a.x0, a.x1) && at.x() <= std::max(a.x0, a.x1) && at.y() >= std::min(a.y0, a.y1) &&
             at.y() <= std::max(a.y0, a.y1);
    });
  }

  double share_of_sky(const Step& k, const Eigen::Vector3d& at, Obstructions::Now& sky) const {
    constexpr double far = 200, degree = 3.141592653589793 / 180;  // [m], [rad]
    int seen = 0, all = 0;
    const auto look = [&](double azimuth, double elevation) {
      const double out = far * std::cos(elevation);
      const auto crossed = sky.between(
          {at.x(), at.y(), at.z()},
          {at.x() + out * std::cos(azimuth), at.y() + out * std::sin(azimuth), at.z() + far * std::sin(elevation)});
      ++all;
      seen += crossed.number == 0 || crossed.loss < k[opaque];
    };
    look(0, 90 * degree);
    for (const double elevation : {15.0, 35.0, 55.0, 75.0}) {
      for (int i = 0; i < 8; ++i) look((45 * i + 22.5) * degree, elevation * degree);
    }
    return static_cast<double>(seen) / all;
  }

  double drawn(const Step& k, std::size_t robot, unsigned number, double deviation) const {
    if (k.expected() || deviation == 0) return 0;
    return deviation * stream.of(k.key("robot", robot)).normal(k.tick(), number);
  }

  Bearer bearer;
  Value rate;
  std::array<Value, 3> origin, mount;
  Value horizontal, vertical, correlation, white, white_up, least_sky, opaque;
  Stream stream;
  In<Pose> pose;
  Obstructions obstructions;
  Out<Gps> reading;
  Out<Errors> errors;
  std::optional<In<Area>> areas;
  std::optional<TableRows> places;  // of them
};

}  // namespace

MUSTER_PLUGIN_IS(SensorsGps)
