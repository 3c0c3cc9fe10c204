#include "session.hpp"

#include <algorithm>
#include <cstdio>

namespace muster::bridge {
namespace {

constexpr double farewell = 0.2;  // [s] for the last frame, to a client that does not read

uint32_t names_of(const muster_host* host, const std::string& set, uint32_t first, FrameWriter& frame) {
  const uint32_t rows = host->row_name(host, set.c_str(), 0) ? host->rows(host, set.c_str()) : 0;
  frame.integer(rows - std::min(first, rows));
  for (uint32_t r = first; r < rows; ++r) frame.text(host->row_name(host, set.c_str(), r));
  return rows;
}

}  // namespace

Session::~Session() {
  if (!peer_ || !peer_->has_client()) return;
  FrameWriter frame(Kind::bye);
  frame.text("the run is over");
  try {
    peer_->send(frame.take(), farewell);
  } catch (const Interrupted&) {
  }
}

void Session::silent(const muster_host* host, const std::string& why) {
  if (settings_.is_required) throw BadInput(why + "; on_silence=\"stop\" or \"hold\" would go on without it");
  if (!is_silent_) detail::warn(host, "self", why);
  is_silent_ = true;
}

std::string Session::tables_frame(const muster_host* host, const muster_tick& tick) {
  FrameWriter frame(Kind::tables);
  frame.real(tick.dt);
  const auto sets = sets_of(ports_);
  frame.integer(static_cast<uint32_t>(sets.size()));
  for (const auto& set : sets) {
    frame.text(set);
    told_[set] = names_of(host, set, 0, frame);
  }
  frame.integer(static_cast<uint32_t>(ports_.size()));
  for (const auto& port : ports_) {
    frame.integer<uint8_t>(port.is_written);
    frame.integer<uint8_t>(port.is_queue);
    frame.text(port.table);
    frame.text(port.set);
    frame.integer(static_cast<uint32_t>(port.columns.size()));
    for (const auto& column : port.columns) {
      frame.text(column.name);
      frame.text(column.unit);
      frame.text(column.reference);
      frame.integer<uint8_t>(static_cast<uint8_t>(column.nullable | column.infinite << 1 | column.bytes << 2));
    }
  }
  return frame.take();
}

// Names of rows that have joined since the client was last told.
std::string Session::news(const muster_host* host) {
  std::string result;
  for (auto& [set, told] : told_) {
    if (!host->row_name(host, set.c_str(), told)) continue;  // none has joined, or rows have no names there
    FrameWriter frame(Kind::rows);
    frame.text(set);
    frame.integer(told);
    told = names_of(host, set, told, frame);
    result += frame.take();
  }
  return result;
}

// The first frame of a client says which format it speaks.
bool Session::greet(const muster_host* host, const muster_tick& tick) {
  std::string frame;
  if (!is_answered(host, frame, settings_.timeout)) return false;
  FrameReader reader(frame);
  if (reader.integer<uint8_t>() != static_cast<uint8_t>(Kind::join) || reader.left() != magic.size() ||
      reader.raw(magic.size()) != magic)
    throw Malformed("a first frame that is no JOIN of " + std::string(magic));
  is_silent_ = false;
  owed_.reset();
  if (had_client_) host->event(host, "a client is there again");
  had_client_ = true;
  return peer_->send(tables_frame(host, tick), settings_.timeout);
}

// True where a client is there to be asked.
bool Session::meet(const muster_host* host, const muster_tick& tick) {
  if (!peer_) {
    peer_ = std::make_unique<Peer>(settings_.port, settings_.path);
    const char* place = host->text(host, "self/place");
    std::fprintf(stderr, "%s: bridge.socket listens at %s and waits %s for a client\n", place ? place : "muster",
                 peer_->place().c_str(), seconds_text(settings_.wait).c_str());
  }
  if (peer_->has_client()) return true;
  if (peer_->accept(had_client_ ? 0 : settings_.wait)) return greet(host, tick);
  if (!had_client_)
    throw BadInput("no client came to " + peer_->place() + " within " + seconds_text(settings_.wait) +
                   "; expected one to be started, or a longer wait");
  silent(host, "no client is at " + peer_->place());
  return false;
}

bool Session::is_answered(const muster_host* host, std::string& frame, double seconds) {
  const Peer::Got got = peer_->receive(frame, seconds);
  if (got == Peer::Got::frame && static_cast<uint8_t>(frame[0]) == static_cast<uint8_t>(Kind::bye)) peer_->drop();
  if (got == Peer::Got::frame && peer_->has_client()) return true;
  if (got == Peer::Got::nothing)
    silent(host, "the client at " + peer_->place() + " gave no answer within " + seconds_text(settings_.timeout));
  else
    silent(host, "the client at " + peer_->place() + " has left");
  return false;
}

std::vector<GivenRows> Session::parsed(const std::string& frame, const muster_host* host, const muster_tick& tick,
                                       const muster_out* out) const {
  FrameReader reader(frame);
  const auto kind = reader.integer<uint8_t>();
  if (kind != static_cast<uint8_t>(Kind::commands))
    throw Malformed("a frame of kind " + std::to_string(kind) + "; expected COMMANDS");
  const auto of = reader.integer<uint64_t>();
  if (owed_ == of && of != tick.index) return {};  // late, for a tick that went without
  if (of != tick.index)
    throw Malformed("commands for tick " + std::to_string(of) + "; expected those for tick " +
                    std::to_string(tick.index));
  std::vector<GivenRows> result;
  for (const auto& port : ports_) {
    if (port.is_written) result.emplace_back(reader, port, host, out[port.claim].rows);
  }
  if (reader.left()) throw Malformed(std::to_string(reader.left()) + " bytes too many in a frame of commands");
  return result;
}

std::vector<GivenRows> Session::exchange(const muster_host* host, const muster_tick& tick, const muster_in* in,
                                         const muster_out* out) {
  try {
    if (!meet(host, tick)) return {};
    std::string frame;
    if (owed_) {  // nothing is sent to a client that is still at an old tick, nor waited for
      if (!is_answered(host, frame, 0)) return {};
      parsed(frame, host, tick, out);
      host->event(host, "the client answers again");
      owed_.reset();
      is_silent_ = false;
    }
    FrameWriter state(Kind::state);
    state.integer(tick.index);
    state.real(tick.time);
    for (const auto& port : ports_) {
      if (!port.is_written) write_rows(state, port, host, in[port.claim]);
    }
    peer_->send(news(host) + state.take(), settings_.timeout);
    owed_ = tick.index;
    if (!is_answered(host, frame, settings_.timeout)) return {};
    auto result = parsed(frame, host, tick, out);
    owed_.reset();
    return result;
  } catch (const Malformed& wrong) {
    const std::string what = "the client sent " + std::string(wrong.what());
    FrameWriter frame(Kind::fault);
    frame.text(what);
    peer_->send(frame.take(), farewell);
    peer_->drop();
    throw BadInput(what);
  } catch (const Interrupted&) {
    throw BadInput("interrupted while it waited for the client at " + peer_->place());
  } catch (const std::runtime_error& wrong) {
    throw BadInput(wrong.what());
  }
}

}  // namespace muster::bridge
