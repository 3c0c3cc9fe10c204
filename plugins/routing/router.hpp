// Connects a routing protocol to the blackboard: a stage of the outbox turns requests into packets for neighbours, and
// a stage of the inbox turns packets into messages. Counts the outcomes of each request.
#pragma once

#include <array>
#include <deque>
#include <map>
#include <muster/plugin.hpp>
#include <muster/routing.hpp>

#include "medium/transmit_queue.hpp"
#include "protocol.hpp"

namespace muster::routing {

class Router final : private Fabric {
 public:
  static constexpr auto phase = MUSTER_SENSE;
  // Parameter that each plugin declares.
  static constexpr Param queue_param = integer("queue", 64, 1, 1e6, "packets that may wait at a radio");

  explicit Router(Setup& s);
  void step(const Step& k, Protocol& protocol);

 private:
  // The whole state from step to step, as bytes.
  struct State {
    static constexpr const char* columns = "router{} protocol{}";
    double router, protocol;
  };

  struct Journey {
    Radio origin = 0;
    medium::Receivers receivers;  // receivers not yet reached
    std::uint32_t copies = 0;     // copies queued, given to the network, or parked
    Outcome worst = Outcome::lost;
    std::vector<std::uint8_t> seen;  // by radio
  };
  struct Queued {
    Radio to;
    Packet packet;
  };
  struct Given {  // to the network
    Radio to;
    std::uint32_t journey;  // 0: control
    std::uint64_t head;     // a hash of its first bytes
    std::uint8_t arrived;
  };
  struct Node {
    std::deque<Queued> queue;
    std::vector<Packet> parked;
    // The packets now in the network; the next ones follow when it has finished all of them.
    std::vector<Given> given;
    double asked = 0, under_way = 0;  // the radio's counts at that time
    double least = 0;                 // least growth of `asked`
    double patience = 0;              // time at which they count as lost in any case
  };

  double now() const override { return now_; }
  void send(Radio at, Radio to, Packet packet) override;
  void deliver(Radio at, const Packet& packet) override;
  void end(const Packet& packet, Outcome outcome) override;
  void park(Radio at, Packet packet) override;
  std::vector<Packet> unpark(Radio at, Radio target) override;
  bool is_first(Radio at, const Packet& packet) override;

  void look(const Step& k, Protocol& protocol);
  void take_arrivals(const Step& k, Protocol& protocol);
  void note_arrival(Radio at, Radio from, std::string_view bytes);
  void settle(const Step& k, Protocol& protocol);
  bool is_settled(const Node& node, const Traffic& traffic) const;
  void settle(Radio at, Protocol& protocol);
  void clear(Radio at, Protocol& protocol);
  void take_requests(const Step& k, Protocol& protocol);
  void hand_over(const Step& k);
  void close();
  void count(const Step& k);

  void count_copy(std::uint32_t journey);
  void drop_copy(std::uint32_t journey);
  std::string save() const;
  void load(std::string_view bytes);

  Value queue_;
  Stage<Outgoing> outbox_;
  Stage<Incoming> inbox_;
  In<Traffic> traffic_;
  Out<Journeys> journeys_count_;
  Out<Relaying> relaying_count_;
  Out<State> state_;

  std::map<std::uint32_t, Journey> journeys_;
  std::uint32_t last_journey_ = 0;
  std::vector<Node> nodes_;
  std::string saved_, saved_protocol_;

  // Of this step.
  const Step* k_ = nullptr;
  double now_ = 0;
  std::size_t limit_ = 0;
  std::vector<std::uint8_t> alive_;
  const Incoming* hop_ = nullptr;  // the arrival being processed
  std::size_t delivered_ = 0;
  std::vector<double> asked_;
  std::vector<std::array<double, static_cast<std::size_t>(Outcome::count)>> outcomes_;
  std::vector<Relaying> relaying_;
};

}  // namespace muster::routing
