// Connects an external network simulator to the blackboard: levels, places and requests go in, messages and counts come
// out.
#pragma once

#include <map>
#include <memory>
#include <muster/pan.hpp>
#include <muster/plugin.hpp>

#include "backend.hpp"
#include "medium/request_moments.hpp"
#include "medium/transmit_queue.hpp"

namespace muster::external {

class Adaptor {
 public:
  explicit Adaptor(Setup& s);

  // `make`: the backend, called in the first step; `noise`: at each radio, in dBm.
  void step(const Step& k, const std::function<std::unique_ptr<Backend>()>& make, double noise);

 private:
  // State of an external simulator cannot be put on the blackboard. This much can: its progress, and a hash of all its
  // inputs.
  struct Progress {
    static constexpr const char* columns = "ticks history";
    double ticks, history;
  };
  struct Message {
    std::size_t from;
    double asked;  // s
    medium::Receivers receivers;
    bool is_unicast;
  };

  void begin(const Step& k, const std::function<std::unique_ptr<Backend>()>& make);
  void check_history(const Step& k) const;
  void look(const Step& k);
  void ask(const Step& k);
  void deliver(Arrival arrival);
  void end(std::uint64_t number, End why);
  medium::DeliveryOutcome fate_of(const Message& message, std::size_t to, End why) const;
  bool hears_anybody(std::size_t radio) const;
  void settle(Message& message, medium::DeliveryOutcome fate);
  void hand_over(const Step& k);
  void count(const Step& k);
  void note(std::uint64_t what) { history_ = combined(history_, what); }
  double history() const { return static_cast<double>(history_ >> 12); }  // exact in a double

  In<Outgoing> request_;
  In<Endpoint> endpoint_;
  In<Pose> pose_;
  In<Ends> ends_;
  In<Level> level_;
  In<Fading> fading_;
  In<Rssi> rssi_;
  In<Pan> pan_;
  Out<Incoming> inbox_;
  Out<Traffic> traffic_;
  Out<Progress> progress_;
  medium::RequestMoments moments_;
  std::uint64_t seed_;

  std::unique_ptr<Backend> backend_;
  std::uint64_t ticks_ = 0, history_ = 0, last_message_ = 0;
  std::map<std::uint64_t, Message> messages_;  // under way

  // Of this step.
  World world_;
  double noise_ = 0;
  std::vector<std::pair<Message, Arrival>> arrivals_;
  std::vector<std::array<double, static_cast<std::size_t>(medium::DeliveryOutcome::count)>> fates_;
};

}  // namespace muster::external
