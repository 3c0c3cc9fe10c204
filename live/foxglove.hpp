// Foxglove's websocket protocol (https://github.com/foxglove/ws-protocol, version 1): the channels of a log as they are
// written, parameters and services of the run. Its clients are Foxglove, Lichtblick and what speaks like them.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "live/server.hpp"
#include "live/services.hpp"
#include "mcap/sink.hpp"

namespace muster::live {

class Foxglove : public mcap::Sink, public Listener {
 public:
  struct Parameter {
    std::string name;
    double value;
  };
  // What clients may ask of the run.
  struct Run {
    std::string name;
    std::function<std::map<std::string, std::string>()> metadata;
    std::function<std::vector<Parameter>()> parameters;
    std::function<void(const std::string& name, double value)> set_parameter;  // throws Error
    Services* services = nullptr;
  };

  explicit Foxglove(Run run);
  ~Foxglove() override;

  // The first that both sides know is spoken; both are the same on the wire.
  static const std::vector<std::string>& subprotocols();

  // Call before the messages of each tick; nanoseconds.
  void begin(std::uint64_t time);
  // The run begins anew: a channel that is declared again as it was keeps its number.
  void restart();
  // Takes away the channels that were not declared again.
  void settle();
  // Some client has subscribed, ever.
  bool is_watched() const { return is_watched_; }

  std::uint16_t schema(mcap::Schema schema) override;
  std::uint16_t channel(mcap::Channel channel) override;
  void message(const mcap::Message& message) override;

  void opened(Client& client) override;
  void received(Client& client, std::string_view message, bool is_binary) override;
  void caught_up(Client& client, std::uint64_t dropped) override;
  void closed(Client& client) override;

 private:
  struct Kept {
    std::uint64_t time;
    std::shared_ptr<const std::string> data;
  };
  struct Channel {
    mcap::Channel declared;
    bool is_still = false, is_there = true, is_declared = true;
    std::uint64_t batch = 0;  // of the kept messages, unless they are still
    std::vector<Kept> kept{};
  };
  struct Watcher {
    std::uint64_t number = 0;                              // of clients, in their order
    std::map<std::uint32_t, std::uint16_t> channels;       // of a subscription
    std::map<std::uint16_t, std::uint32_t> subscriptions;  // of a channel
  };
  struct Request;  // of JSON

  void take_text(Client& client, std::string_view message);
  void take_binary(Client& client, std::string_view message);
  void subscribe(Client& client, const Request& request);
  void unsubscribe(Client& client, const Request& request);
  void get_parameters(Client& client, const Request& request);
  void set_parameters(Client& client, const Request& request);
  void call_service(Client& client, std::string_view request);
  std::string advertisement(const std::vector<std::uint16_t>& channels) const;
  std::string service_list() const;
  Frame time_frame() const;
  static Frame message_frame(std::uint32_t subscription, const Channel& channel, const Kept& kept);

  Run run_;
  std::string session_;
  std::vector<mcap::Schema> schemas_;
  std::vector<Channel> channels_;
  std::map<std::string, std::uint16_t> by_topic_;  // of those that are there
  std::map<Client*, Watcher> watchers_;
  std::uint64_t time_ = 0, batch_ = 0, clients_ = 0;
  bool is_watched_ = false;
};

}  // namespace muster::live
