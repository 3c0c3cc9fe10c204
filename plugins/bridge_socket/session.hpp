// The conversation with a client: who it is that drives, tick by tick, and what is done while it is silent.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "peer.hpp"
#include "ports/ports.hpp"

namespace muster::bridge {

using namespace ports;

struct SessionSettings {
  uint16_t port = 0;
  std::string path;         // of a Unix socket; empty: the port
  double wait = 0;          // [s] for a first client
  double timeout = 0;       // [s] for an answer
  bool is_required = true;  // silence ends the run
};

class Session {
 public:
  Session(SessionSettings settings, std::vector<Port> ports)
      : settings_(std::move(settings)), ports_(std::move(ports)) {}
  // Tells the client that the run is over.
  ~Session();

  // Sends the state of a tick and waits for its commands: one GivenRows a table of commands. Empty: the client is
  // silent. Throws BadInput.
  std::vector<GivenRows> exchange(const muster_host* host, const muster_tick& tick, const muster_in* in,
                                  const muster_out* out);

 private:
  bool meet(const muster_host* host, const muster_tick& tick);
  bool greet(const muster_host* host, const muster_tick& tick);
  std::string tables_frame(const muster_host* host, const muster_tick& tick);
  std::string news(const muster_host* host);
  bool is_answered(const muster_host* host, std::string& frame, double seconds);
  std::vector<GivenRows> parsed(const std::string& frame, const muster_host* host, const muster_tick& tick,
                                const muster_out* out) const;
  void silent(const muster_host* host, const std::string& why);

  SessionSettings settings_;
  std::vector<Port> ports_;
  std::unique_ptr<Peer> peer_;
  std::map<std::string, uint32_t> told_;  // names of rows that the client knows, of a set
  std::optional<uint64_t> owed_;          // the tick whose commands are late
  bool had_client_ = false, is_silent_ = false;
};

}  // namespace muster::bridge
