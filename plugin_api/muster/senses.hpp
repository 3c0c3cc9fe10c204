// What sensors on robots tell, beside scans: these tables have rows as long as a sensor writes them.
#pragma once

namespace muster {

// heard/*/peer: a radio's view of one peer that it has heard. rssi: as the receiver reported it, null where what it has
// is too old; noise: power in its band without messages, null where nobody states any; last_seen: when the peer's last
// message arrived; t: when this was told. A robot's rows of one `t` are its whole list.
struct Heard {
  static constexpr const char* columns = "robot:robot radio:radio peer:radio rssi[dBm]? noise[dBm]? last_seen[s] t[s]";
  double robot, radio, peer, rssi, noise, last_seen, t;
};

// robot/*/imu: specific force and angular rate in the sensor's own axes, and when they were measured; null before the
// first reading.
struct Imu {
  static constexpr const char* columns = "t[s]? fx[m/s2]? fy[m/s2]? fz[m/s2]? wx[rad/s]? wy[rad/s]? wz[rad/s]?";
  double t, fx, fy, fz, wx, wy, wz;
};

// range/*/message: one distance from a robot's radio to another radio, as measured at `t`.
struct Range {
  static constexpr const char* columns = "robot:robot peer:radio range[m] t[s]";
  double robot, peer, range, t;
};

// image/*/message: what one camera saw at `t`: `width` x `height` pixels, row by row from the top left; `fov` is the
// width of its field of view. depth{}: a float a pixel, metres along the camera's axis, as REP 118 has it: infinite
// where nothing is within its range, minus infinity where something is too near. colour{}: red, green, blue, a byte
// each.
struct Image {
  static constexpr const char* columns = "robot:robot camera t[s] width height fov[rad] depth{} colour{}";
  static constexpr unsigned payload_column = 6, colour_column = 7;
  double robot, camera, t, width, height, fov, depth, colour;
};

// robot/*/gps: a place on the globe (WGS 84, degrees; altitude above the ellipsoid) and the same east, north and up of
// the world's origin. t: of the last attempt; the place is null where that failed.
struct Gps {
  static constexpr const char* columns = "t[s]? latitude[deg]? longitude[deg]? altitude[m]? east[m]? north[m]? up[m]?";
  double t, latitude, longitude, altitude, east, north, up;
};

}  // namespace muster
