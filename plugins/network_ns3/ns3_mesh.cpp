#include "ns3_mesh.hpp"

#include <ns3/internet-module.h>
#include <ns3/sixlowpan-module.h>

#include <cmath>
#include <cstring>
#include <map>

#include "ns3_backend.hpp"

namespace muster::external {
namespace {

// Precedes each piece of a message, in an IPv6 packet of its own.
struct Head {
  std::uint64_t message;
  std::uint32_t piece, pieces;
};

constexpr std::size_t ipv6_head = 40, in_a_piece = 1280 - ipv6_head - sizeof(Head);  // the least MTU of IPv6
constexpr std::uint8_t experimental = 253;                                           // next header, RFC 3692
constexpr double patience = 10;  // s; pieces that have not arrived by then are lost

std::size_t pieces_of(std::size_t size) { return size == 0 ? 1 : (size + in_a_piece - 1) / in_a_piece; }

class Ns3Mesh;

// The received pieces of a message that is still incomplete.
struct Part {
  std::vector<std::string> pieces;
  std::size_t missing = 0;
};

// Pending messages of one radio, its incomplete receptions, and ns-3's radio under its mesh.
struct Member {
  Ns3Mesh* owner;
  std::size_t number;
  Ns3Radio air;
  ns3::Ptr<ns3::SixLowPanNetDevice> mesh;
  std::deque<Request> queue{};
  std::size_t next = 0;       // piece of the first message
  std::uint64_t sending = 0;  // the message whose pieces are in the medium access
  std::size_t frames = 0;     // in the medium access, those of others included
  std::size_t own = 0;        // of them its own, which are sent first
  bool no_access = false;     // for one of its own
  std::size_t hop = 0;        // sender of its last frame
  std::map<std::uint64_t, Part> parts{};

  void enqueued(ns3::Ptr<const ns3::Packet>) { ++frames; }
  void confirm(ns3::McpsDataConfirmParams result);
  void indicate(ns3::McpsDataIndicationParams how, ns3::Ptr<ns3::Packet> frame);
  bool hear(ns3::Ptr<ns3::NetDevice>, ns3::Ptr<const ns3::Packet> packet, std::uint16_t, const ns3::Address&);
};

class Ns3Mesh final : public Ns3Backend<Member> {
 public:
  explicit Ns3Mesh(const MeshSettings& settings) : Ns3Backend(settings.noise, settings.queue), hops_(settings.hops) {}

  // A reading that the receiver's chain makes null is not passed on.
  bool hears(std::size_t radio, std::size_t hop) const { return !std::isnan(air_.rssi(hop, radio)); }

  // Sends a radio's next piece, or next message, as soon as its medium access is empty.
  void go_on(Member& radio) {
    if (radio.frames > 0) return;
    const bool is_sent = !radio.queue.empty() && radio.sending == radio.queue.front().message;
    if (is_sent && (radio.no_access || radio.next == pieces_of(radio.queue.front().payload.size()))) {
      radio.queue.pop_front();
      finish(radio.sending, radio.no_access);
    }
    if (radio.queue.empty()) return;
    if (radio.sending != radio.queue.front().message) {
      radio.sending = radio.queue.front().message;
      radio.next = 0;
      radio.no_access = false;
    }
    send_piece(radio);
  }

  void hear(Member& at, const ns3::Ptr<ns3::Packet>& packet) {
    ns3::Ipv6Header ip;
    packet->RemoveHeader(ip);
    std::string bytes(packet->GetSize(), '\0');
    packet->CopyData(reinterpret_cast<std::uint8_t*>(bytes.data()), packet->GetSize());
    Head head;
    std::memcpy(&head, bytes.data(), sizeof head);
    Part& part = at.parts[head.message];
    if (part.pieces.empty()) {
      part.pieces.resize(head.pieces);
      part.missing = head.pieces;
    }
    std::string& piece = part.pieces[head.piece];
    if (part.missing == 0 || !piece.empty()) return;  // received before
    piece = std::move(bytes);
    if (--part.missing > 0) return;
    std::string payload;
    for (const std::string& each : part.pieces) payload.append(each, sizeof head);
    part.pieces.assign(head.pieces, {});
    deliver({head.message, at.number, at.hop, air_.now(), air_.rssi(at.hop, at.number), std::move(payload)});
  }

 private:
  std::unique_ptr<Member> join(std::size_t number, const Ns3Radio& air) override {
    auto radio = std::make_unique<Member>(Member{this, number, air, ns3::CreateObject<ns3::SixLowPanNetDevice>()});
    radio->mesh->SetAttribute("UseMeshUnder", ns3::BooleanValue(true));
    radio->mesh->SetAttribute("MeshUnderRadius", ns3::UintegerValue(hops_ - 1));
    radio->mesh->SetAttribute("MeshCacheLength", ns3::UintegerValue(100));  // of 256 numbers
    air.node->AddDevice(radio->mesh);
    radio->mesh->SetNetDevice(air.device);
    radio->mesh->SetReceiveCallback(ns3::MakeCallback(&Member::hear, radio.get()));
    radio->mesh->AssignStreams(static_cast<int64_t>(16 * number + 8));
    auto mac = air.device->GetMac();
    mac->TraceConnectWithoutContext("MacTxEnqueue", ns3::MakeCallback(&Member::enqueued, radio.get()));
    mac->SetMcpsDataConfirmCallback(ns3::MakeCallback(&Member::confirm, radio.get()));
    mac->SetMcpsDataIndicationCallback(ns3::MakeCallback(&Member::indicate, radio.get()));
    return radio;
  }

  void start(Member& radio) override { go_on(radio); }

  void send_piece(Member& radio) {
    const Request& message = radio.queue.front();
    const Head head{message.message, static_cast<std::uint32_t>(radio.next),
                    static_cast<std::uint32_t>(pieces_of(message.payload.size()))};
    std::string bytes(sizeof head, '\0');
    std::memcpy(bytes.data(), &head, sizeof head);
    bytes += message.payload.substr(radio.next++ * in_a_piece, in_a_piece);
    const auto packet = ns3::Create<ns3::Packet>(reinterpret_cast<const std::uint8_t*>(bytes.data()),
                                                 static_cast<std::uint32_t>(bytes.size()));
    const ns3::Address to =
        message.to == everyone ? radio.air.device->GetBroadcast() : radios_[message.to]->air.device->GetAddress();
    ns3::Ipv6Header ip;
    ip.SetSource(ns3::Ipv6Address::MakeAutoconfiguredLinkLocalAddress(radio.air.device->GetAddress()));
    ip.SetDestination(message.to == everyone ? ns3::Ipv6Address::GetAllNodesMulticast()
                                             : ns3::Ipv6Address::MakeAutoconfiguredLinkLocalAddress(to));
    ip.SetNextHeader(experimental);
    ip.SetHopLimit(255);
    ip.SetPayloadLength(static_cast<std::uint16_t>(bytes.size()));
    packet->AddHeader(ip);
    radio.mesh->Send(packet, to, ns3::Ipv6L3Protocol::PROT_NUMBER);
    radio.own = radio.frames;
  }

  // No more frames of a message leave its sender.
  void finish(std::uint64_t message, bool no_access) {
    if (no_access) return forget(message, End::no_access);
    ns3::Simulator::Schedule(ns3::Seconds(patience), [this, message] { forget(message, End::lost); });
  }
  void forget(std::uint64_t message, End why) {
    for (auto& radio : radios_) radio->parts.erase(message);
    end(message, why);
  }

  unsigned hops_;
};

void Member::confirm(ns3::McpsDataConfirmParams result) {
  --frames;
  if (own > 0) {
    --own;
    no_access = no_access || result.m_status == ns3::IEEE_802_15_4_CHANNEL_ACCESS_FAILURE;
  }
  // The medium access goes on to its next frame first.
  if (frames == 0) ns3::Simulator::ScheduleNow([this] { owner->go_on(*this); });
}
void Member::indicate(ns3::McpsDataIndicationParams how, ns3::Ptr<ns3::Packet> frame) {
  hop = Ns3Radios::radio_at(how.m_srcAddr);
  if (owner->hears(number, hop)) air.device->McpsDataIndication(how, frame);
}
bool Member::hear(ns3::Ptr<ns3::NetDevice>, ns3::Ptr<const ns3::Packet> packet, std::uint16_t, const ns3::Address&) {
  owner->hear(*this, packet->Copy());
  return true;
}

}  // namespace

std::unique_ptr<Backend> make_ns3_mesh(const MeshSettings& settings) { return std::make_unique<Ns3Mesh>(settings); }

}  // namespace muster::external
