// Names of the row types of standard quantities, for messages: who claims a table by another type is told which fits.
#pragma once

#include <muster/sets.hpp>
#include <string>
#include <string_view>

namespace muster {

// "Odometry" of "x[m] y[m] yaw[rad] v[m/s] w[rad/s]"; "" of columns of no standard type.
inline std::string row_type(std::string_view columns) {
  struct Named {
    const char *name, *columns;
  };
#define MUSTER_NAMED(Type) \
  { #Type, Type::columns }
  static constexpr Named types[] = {MUSTER_NAMED(Pose),          MUSTER_NAMED(Twist),
                                    MUSTER_NAMED(Wheels),        MUSTER_NAMED(Command),
                                    MUSTER_NAMED(CarCommand),    MUSTER_NAMED(Goal2d),
                                    MUSTER_NAMED(Drive),         MUSTER_NAMED(Gait),
                                    MUSTER_NAMED(Legs),          MUSTER_NAMED(Odometry),
                                    MUSTER_NAMED(OdometryReset), MUSTER_NAMED(Stall),
                                    MUSTER_NAMED(Geometry),      MUSTER_NAMED(AttitudeThrust),
                                    MUSTER_NAMED(Velocity3d),    MUSTER_NAMED(Position3d),
                                    MUSTER_NAMED(Imu),           MUSTER_NAMED(Gps),
                                    MUSTER_NAMED(RotorDrive),    MUSTER_NAMED(Loss),
                                    MUSTER_NAMED(Colouring),     MUSTER_NAMED(Wall),
                                    MUSTER_NAMED(Door),          MUSTER_NAMED(DoorState),
                                    MUSTER_NAMED(FloorShape),    MUSTER_NAMED(MeshShape),
                                    MUSTER_NAMED(Mount),         MUSTER_NAMED(Traffic),
                                    MUSTER_NAMED(Endpoint),      MUSTER_NAMED(Ends),
                                    MUSTER_NAMED(Level),         MUSTER_NAMED(Fading),
                                    MUSTER_NAMED(Rssi),          MUSTER_NAMED(Scan),
                                    MUSTER_NAMED(Heard),         MUSTER_NAMED(Range),
                                    MUSTER_NAMED(Image),         MUSTER_NAMED(Outgoing),
                                    MUSTER_NAMED(Incoming)};
#undef MUSTER_NAMED
  for (const Named& type : types)
    if (columns == type.columns) return type.name;
  return "";
}

}  // namespace muster
