#include "ns3_lr_wpan.hpp"

#include <map>
#include <unordered_map>

#include "ns3_backend.hpp"

namespace muster::external {
namespace {

// Fragments of RFC 4944: all but the last carry a multiple of 8 octets after a header of 4, then of 5. A header has 11
// octets, and 13 to another PAN.
constexpr std::size_t in_one_frame = 127 - 11, in_one_frame_across = 127 - 13, in_a_fragment = 104;

std::size_t fragments_of(std::size_t size, bool across) {
  return size <= (across ? in_one_frame_across : in_one_frame) ? 1 : (size + in_a_fragment - 1) / in_a_fragment;
}

class Ns3LrWpan;

// Pending messages of one radio, and ns-3's radio.
struct Sender {
  Ns3LrWpan* owner;
  std::size_t number;
  ns3::Ptr<ns3::LrWpanMac> mac;
  std::deque<Request> queue{};
  std::size_t next = 0, fragments = 0;  // of the first message
  std::uint64_t sending = 0, uid = 0;   // the message whose frame ns-3 holds, and its number there; 0: none
  bool has_arrived = false;             // some of it, at some receiver
  std::map<std::size_t, std::pair<std::size_t, std::string>> parts{};  // by receiver: fragments that came, and bytes

  // False after it left.
  bool has(std::uint64_t message) const { return !queue.empty() && queue.front().message == message; }
  void confirm(ns3::McpsDataConfirmParams result);
  void indicate(ns3::McpsDataIndicationParams, ns3::Ptr<ns3::Packet> frame);
};

class Ns3LrWpan final : public Ns3Backend<Sender> {
 public:
  explicit Ns3LrWpan(const LrWpanSettings& settings)
      : Ns3Backend(settings.noise, settings.queue), acknowledge_(settings.acknowledge) {}

  // A repeated frame, whose acknowledgement was lost, arrives twice.
  void hear(Sender& at, const ns3::Ptr<ns3::Packet>& frame) {
    const auto found = sent_.find(frame->GetUid());
    if (found == sent_.end()) return;
    const Sent& it = found->second;
    Sender& from = *radios_[it.from];
    if (!from.has(it.message)) return;
    auto& [count, bytes] = from.parts[at.number];
    if (count != it.fragment) return;
    from.has_arrived = true;
    const std::size_t head = from.fragments == 1 ? 0 : it.fragment == 0 ? 4 : 5;
    std::string all(frame->GetSize(), '\0');
    frame->CopyData(reinterpret_cast<std::uint8_t*>(all.data()), frame->GetSize());
    bytes.append(all, head);
    if (++count == from.fragments)
      deliver({it.message, at.number, it.from, air_.now(), air_.rssi(it.from, at.number), std::move(bytes)});
  }

  void confirm(Sender& radio, const ns3::McpsDataConfirmParams& result) {
    sent_.erase(radio.uid);
    const std::uint64_t message = std::exchange(radio.sending, 0);
    if (!radio.has(message)) {
      start_next(radio);
    } else if (result.m_status == ns3::IEEE_802_15_4_SUCCESS) {
      ++radio.next;
      if (radio.next < radio.fragments) return send(radio);
      finish(radio, End::sent);
    } else {
      const bool no_access = result.m_status == ns3::IEEE_802_15_4_CHANNEL_ACCESS_FAILURE;
      finish(radio, no_access ? End::no_access : radio.has_arrived ? End::no_ack : End::sent);
    }
  }

 private:
  std::unique_ptr<Sender> join(std::size_t number, const Ns3Radio& air) override {
    const ns3::Ptr<ns3::LrWpanMac> mac = air.device->GetMac();
    auto radio = std::make_unique<Sender>(Sender{this, number, mac});
    mac->SetMcpsDataConfirmCallback(ns3::MakeCallback(&Sender::confirm, radio.get()));
    mac->SetMcpsDataIndicationCallback(ns3::MakeCallback(&Sender::indicate, radio.get()));
    return radio;
  }

  // Otherwise it starts when ns-3 has finished the frame that it holds.
  void start(Sender& radio) override {
    if (radio.sending == 0) send(radio);
  }

  void send(Sender& radio) {
    if (radio.queue.empty()) return;
    const Request& message = radio.queue.front();
    const ns3::Ptr<ns3::LrWpanMac>& to = radios_[message.to == everyone ? radio.number : message.to]->mac;
    if (radio.next == 0)
      radio.fragments = fragments_of(message.payload.size(), to->GetPanId() != radio.mac->GetPanId());
    const bool is_whole = radio.fragments == 1;
    const std::size_t head = is_whole ? 0 : radio.next == 0 ? 4 : 5;
    std::string bytes(head, '\0');
    bytes += message.payload.substr(radio.next * in_a_fragment, is_whole ? std::string::npos : in_a_fragment);
    const auto frame = ns3::Create<ns3::Packet>(reinterpret_cast<const std::uint8_t*>(bytes.data()),
                                                static_cast<std::uint32_t>(bytes.size()));
    sent_[frame->GetUid()] = {radio.number, radio.next, message.message};
    radio.sending = message.message;
    radio.uid = frame->GetUid();
    ns3::McpsDataRequestParams how;
    how.m_dstPanId = to->GetPanId();
    how.m_srcAddrMode = how.m_dstAddrMode = ns3::SHORT_ADDR;
    how.m_dstAddr = message.to == everyone ? ns3::Mac16Address("ff:ff") : Ns3Radios::address_of(message.to);
    how.m_txOptions = message.to != everyone && acknowledge_ ? ns3::TX_OPTION_ACK : ns3::TX_OPTION_NONE;
    radio.mac->McpsDataRequest(how, frame);
  }

  void finish(Sender& radio, End why) {
    const std::uint64_t message = radio.queue.front().message;
    radio.queue.pop_front();
    start_next(radio);
    end(message, why);
  }
  void start_next(Sender& radio) {
    radio.next = 0;
    radio.has_arrived = false;
    radio.parts.clear();
    send(radio);
  }

  struct Sent {
    std::size_t from, fragment;
    std::uint64_t message;
  };

  bool acknowledge_;
  std::unordered_map<std::uint64_t, Sent> sent_;  // by ns-3's number of the packet
};

// Receivers see a frame's end later than its sender, by the propagation delay.
void Sender::confirm(ns3::McpsDataConfirmParams result) {
  ns3::Simulator::Schedule(ns3::MicroSeconds(10), [this, result] { owner->confirm(*this, result); });
}
void Sender::indicate(ns3::McpsDataIndicationParams, ns3::Ptr<ns3::Packet> frame) { owner->hear(*this, frame); }

}  // namespace

bool is_ns3_taken() { return ns3::NodeList::GetNNodes() > 0; }

std::unique_ptr<Backend> make_ns3_lr_wpan(const LrWpanSettings& settings) {
  return std::make_unique<Ns3LrWpan>(settings);
}

}  // namespace muster::external
