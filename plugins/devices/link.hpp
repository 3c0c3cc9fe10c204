// Both ends of the conversation between a controller's run and a robot, without a clock and without a socket: all is
// told by the time of the run and by what the wire brings.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "datagram.hpp"
#include "wire.hpp"

namespace muster::devices {

// Datagrams that are not taken, by the reason; what is taken is counted by Sequence.
struct Refused {
  std::uint64_t malformed = 0;  // no datagram of the format, or rows that are none
  std::uint64_t foreign = 0;    // from another address, or of another session
};

// Takes the rows of a datagram that is fresh; throws ports::Malformed where they are none.
using TakeRows = std::function<void(std::string_view body)>;

// The controller's end.
class ControllerEnd {
 public:
  // `session` is larger than that of any earlier start.
  ControllerEnd(Wire& wire, const Address& robot, std::vector<TableShape> shapes, std::uint64_t session)
      : wire_(wire), robot_(robot), shapes_(std::move(shapes)), session_(session) {}

  // Takes what has come until now, most_at_once datagrams at most. Throws BadInput where the robot exchanges other
  // tables, or refuses this end.
  void receive(double now, const TakeRows& take);
  // Asks the robot to speak, as long as it has not agreed or is silent.
  void ask(double now);
  // Commands: rows of each table that the robot takes. Nothing is sent before the robot has agreed.
  void command(double now, const std::string& rows);
  void say_bye(double now);

  bool has_agreed() const { return has_agreed_; }
  bool has_heard() const { return heard_ >= 0; }     // a state, ever
  double heard() const { return heard_; }            // [s] of the run: when the last fresh state came
  double round_trip() const { return round_trip_; }  // [s] of the run from a command to a state that has it; < 0: none
  bool has_left() const { return has_left_; }        // the robot said so
  const Sequence& from_robot() const { return from_robot_; }
  const Refused& refused() const { return refused_; }
  std::uint64_t sent() const { return sent_; }

 private:
  void take(double now, const Datagram& datagram, const TakeRows& rows);
  ports::FrameWriter begun(ports::Kind kind, double now);

  Wire& wire_;
  Address robot_;
  std::vector<TableShape> shapes_;
  std::uint64_t session_, sent_ = 0;
  Sequence from_robot_;
  Refused refused_;
  bool has_agreed_ = false, has_left_ = false;
  double heard_ = -1, round_trip_ = -1;
  std::vector<double> sent_at_;  // [s], a sequence modulo its size
};

// The robot's end.
class RobotEnd {
 public:
  RobotEnd(Wire& wire, std::vector<TableShape> shapes, std::uint64_t session)
      : wire_(wire), shapes_(std::move(shapes)), session_(session) {}

  // Takes what has come, most_at_once datagrams at most. `watchdog` [s]: a controller that was silent for longer may be
  // followed by another one.
  void receive(double now, double watchdog, const TakeRows& take);
  // What the robot senses: rows of each table that it gives. Nothing is sent where no controller is there.
  void tell(double now, const std::string& rows);
  void say_bye(double now);

  bool has_controller() const { return has_controller_; }
  bool has_heard() const { return heard_ >= 0; }  // a command of this controller
  double heard() const { return heard_; }
  const Address& controller() const { return controller_; }
  const std::string& disagreement() const { return disagreement_; }  // with who asked last; empty: none
  const Sequence& from_controller() const { return from_controller_; }
  const Refused& refused() const { return refused_; }

 private:
  void meet(double now, double watchdog, const Address& from, const Datagram& datagram);
  void refuse(double now, const Address& to, const std::string& why);
  ports::FrameWriter begun(ports::Kind kind, double now);

  Wire& wire_;
  std::vector<TableShape> shapes_;
  std::uint64_t session_, sent_ = 0;
  Sequence from_controller_;
  Refused refused_;
  Address controller_;
  bool has_controller_ = false;
  double heard_ = -1, met_ = -1;
  std::string disagreement_;
};

}  // namespace muster::devices
