#include "link.hpp"

#include <algorithm>
#include <muster/plugin.hpp>

namespace muster::devices {
namespace {

using ports::FrameReader;
using ports::FrameWriter;
using ports::Kind;
using ports::Malformed;

constexpr std::size_t remembered = 256;   // commands of which the time of sending is known
constexpr std::size_t most_reason = 500;  // bytes of a refusal that are shown

}  // namespace

// ---- The controller's end ----

FrameWriter ControllerEnd::begun(Kind kind, double now) {
  sent_at_.resize(remembered);
  ++sent_;
  sent_at_[sent_ % remembered] = now;
  return begun_datagram(kind, {session_, sent_, from_robot_.last(), now});
}

void ControllerEnd::ask(double now) {
  FrameWriter frame = begun(Kind::join, now);
  write_tables(frame, shapes_);
  wire_.send(robot_, frame.take());
}

void ControllerEnd::command(double now, const std::string& rows) {
  if (!has_agreed_) return;
  FrameWriter frame = begun(Kind::commands, now);
  frame.raw(rows);
  wire_.send(robot_, frame.take());
}

void ControllerEnd::say_bye(double now) {
  if (has_agreed_) wire_.send(robot_, begun(Kind::bye, now).take());
}

void ControllerEnd::receive(double now, const TakeRows& rows) {
  Address from;
  std::string bytes;
  for (std::size_t left = most_at_once; left > 0 && wire_.receive(from, bytes); --left) {
    if (!(from == robot_)) {
      ++refused_.foreign;
      continue;
    }
    try {
      take(now, parsed_datagram(bytes), rows);
    } catch (const Malformed&) {
      ++refused_.malformed;
    }
  }
}

void ControllerEnd::take(double now, const Datagram& datagram, const TakeRows& rows) {
  const Stamp& stamp = datagram.stamp;
  if (datagram.kind == Kind::fault) {
    FrameReader reader(datagram.body);
    std::string why(reader.text().substr(0, most_reason));
    std::replace_if(
        why.begin(), why.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
    throw BadInput("the robot at " + robot_.text() + " refuses: " + why);
  }
  if (datagram.kind == Kind::tables) {
    const auto theirs = read_tables(datagram.body);
    if (stamp.session < from_robot_.session()) {
      ++refused_.foreign;
      return;
    }
    const std::string fault = disagreement(shapes_, theirs, "the robot at " + robot_.text());
    if (!fault.empty()) throw BadInput(fault);
    if (stamp.session != from_robot_.session()) from_robot_.restart(stamp.session);
    from_robot_.take(stamp.sequence);
    has_agreed_ = true;
    has_left_ = false;
    return;
  }
  if (datagram.kind != Kind::state && datagram.kind != Kind::bye)
    throw Malformed("a datagram that a robot does not send");
  if (!has_agreed_ || stamp.session != from_robot_.session()) {
    if (stamp.session > from_robot_.session()) has_agreed_ = false;  // it has started anew: it is asked again
    ++refused_.foreign;
    return;
  }
  if (from_robot_.take(stamp.sequence) != Sequence::Taken::fresh) return;
  if (datagram.kind == Kind::bye) {
    has_left_ = true;
    has_agreed_ = false;
    return;
  }
  rows(datagram.body);
  heard_ = now;
  if (stamp.echo > 0 && stamp.echo <= sent_ && sent_ - stamp.echo < remembered)
    round_trip_ = now - sent_at_[stamp.echo % remembered];
}

// ---- The robot's end ----

FrameWriter RobotEnd::begun(Kind kind, double now) {
  return begun_datagram(kind, {session_, ++sent_, from_controller_.last(), now});
}

void RobotEnd::tell(double now, const std::string& rows) {
  if (!has_controller_) return;
  FrameWriter frame = begun(Kind::state, now);
  frame.raw(rows);
  wire_.send(controller_, frame.take());
}

void RobotEnd::say_bye(double now) {
  if (has_controller_) wire_.send(controller_, begun(Kind::bye, now).take());
}

void RobotEnd::refuse(double now, const Address& to, const std::string& why) {
  // Of no session's sequence: who is refused has none with this robot.
  FrameWriter frame = begun_datagram(Kind::fault, {session_, 1, 0, now});
  frame.text(why);
  wire_.send(to, frame.take());
}

void RobotEnd::meet(double now, double watchdog, const Address& from, const Datagram& datagram) {
  const std::string fault =
      devices::disagreement(shapes_, read_tables(datagram.body), "the controller at " + from.text());
  const bool is_other = has_controller_ && !(from == controller_);
  if (is_other && now - std::max(heard_, met_) <= watchdog) {
    ++refused_.foreign;
    return refuse(now, from, "it is driven by " + controller_.text() + " already");
  }
  if (!fault.empty()) {
    disagreement_ = fault;
    ++refused_.foreign;
    return refuse(now, from, fault);
  }
  disagreement_.clear();
  const std::uint64_t session = datagram.stamp.session;
  if (!is_other && has_controller_ && session < from_controller_.session()) {
    ++refused_.foreign;
    return;
  }
  if (!has_controller_ || is_other || session != from_controller_.session()) {
    from_controller_.restart(session);
    heard_ = -1;
  }
  controller_ = from;
  has_controller_ = true;
  met_ = now;
  from_controller_.take(datagram.stamp.sequence);
  FrameWriter frame = begun(Kind::tables, now);
  write_tables(frame, shapes_);
  wire_.send(controller_, frame.take());
}

void RobotEnd::receive(double now, double watchdog, const TakeRows& rows) {
  Address from;
  std::string bytes;
  for (std::size_t left = most_at_once; left > 0 && wire_.receive(from, bytes); --left) {
    try {
      const Datagram datagram = parsed_datagram(bytes);
      if (datagram.kind == Kind::join) {
        meet(now, watchdog, from, datagram);
        continue;
      }
      if (datagram.kind != Kind::commands && datagram.kind != Kind::bye)
        throw Malformed("a datagram that a controller does not send");
      if (!has_controller_ || !(from == controller_) || datagram.stamp.session != from_controller_.session()) {
        ++refused_.foreign;
        continue;
      }
      if (from_controller_.take(datagram.stamp.sequence) != Sequence::Taken::fresh) continue;
      if (datagram.kind == Kind::bye) {
        has_controller_ = false;
        heard_ = -1;
        continue;
      }
      rows(datagram.body);
      heard_ = now;
    } catch (const Malformed&) {
      ++refused_.malformed;
    }
  }
}

}  // namespace muster::devices
