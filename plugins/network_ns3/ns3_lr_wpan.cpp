#include "ns3_lr_wpan.hpp"

#include <ns3/core-module.h>
#include <ns3/lr-wpan-module.h>
#include <ns3/mobility-module.h>
#include <ns3/network-module.h>
#include <ns3/propagation-module.h>
#include <ns3/spectrum-module.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <map>
#include <unordered_map>

namespace muster::external {
namespace {

// Our channel as ns-3's: what a radio receives of another that sends at 0 dBm. A frame is received at the level of the
// moment when it begins.
class OurLoss final : public ns3::PropagationLossModel {
 public:
  void join(const ns3::MobilityModel* place) { numbers_.emplace(place, numbers_.size()); }
  void set(const World& world) {
    world_ = &world;
    rssi_.resize(world.radios());
    for (auto& row : rssi_) row.resize(world.radios());
  }
  // Of the last frame between the two.
  double rssi(std::size_t from, std::size_t to) const { return rssi_[from][to]; }

 private:
  double DoCalcRxPower(double tx_power, ns3::Ptr<ns3::MobilityModel> a, ns3::Ptr<ns3::MobilityModel> b) const override {
    const std::size_t from = numbers_.at(ns3::PeekPointer(a)), to = numbers_.at(ns3::PeekPointer(b));
    const std::size_t link = world_->link(from, to);
    rssi_[from][to] = world_->rssi[link];
    const bool both = world_->alive[from] && world_->alive[to];
    return both ? std::max(nothing, tx_power + world_->level[link]) : nothing;
  }
  int64_t DoAssignStreams(int64_t) override { return 0; }

  std::unordered_map<const ns3::MobilityModel*, std::size_t> numbers_;
  const World* world_ = nullptr;
  mutable std::vector<std::vector<double>> rssi_;
  static constexpr double nothing = -1000;  // dBm
};

// Fragments as RFC 4944 cuts them: all but the last carry a multiple of 8 octets behind a header of 4, then of 5.
constexpr std::size_t in_one_frame = 127 - 11, in_a_fragment = (in_one_frame - 5) / 8 * 8;

std::size_t fragments_of(std::size_t size) {
  return size <= in_one_frame ? 1 : (size + in_a_fragment - 1) / in_a_fragment;
}

class Ns3LrWpan final : public Backend {
 public:
  explicit Ns3LrWpan(const LrWpanSettings& settings) : settings_(settings) {}
  ~Ns3LrWpan() override {
    if (!channel_) return;
    for (auto& radio : radios_) {
      radio->device->GetMac()->SetMcpsDataConfirmCallback(ns3::McpsDataConfirmCallback());
      radio->device->GetMac()->SetMcpsDataIndicationCallback(ns3::McpsDataIndicationCallback());
    }
    ns3::Simulator::Destroy();
  }

  void init(const World& world, std::uint64_t seed) override {
    start_ = world.time;
    ns3::RngSeedManager::SetSeed(static_cast<std::uint32_t>(seed % 4294967087u) + 1);
    ns3::RngSeedManager::SetRun(1);
    loss_ = ns3::CreateObject<OurLoss>();
    channel_ = ns3::CreateObject<ns3::SingleModelSpectrumChannel>();
    channel_->SetAttribute("MaxLossDb", ns3::DoubleValue(300));
    channel_->AddPropagationLossModel(loss_);
    channel_->SetPropagationDelayModel(ns3::CreateObject<ns3::ConstantSpeedPropagationDelayModel>());
  }

  void moved(const World& world) override {
    world_ = world;
    while (radios_.size() < world.radios()) join();
    for (std::size_t i = 0; i < radios_.size(); ++i) {
      const auto& [x, y, z] = world.places[i];
      radios_[i]->place->SetPosition({x, y, z});
      if (!world.alive[i]) radios_[i]->queue.clear();
    }
    loss_->set(world_);
  }

  void request(Request request) override {
    const auto node = static_cast<std::uint32_t>(request.from);
    const ns3::Time after = std::max(at(request.at) - ns3::Simulator::Now(), ns3::Time(0));
    ns3::Simulator::ScheduleWithContext(node, after,
                                        [this, request = std::move(request)]() mutable { take(std::move(request)); });
  }

  void advance(double until) override {
    ns3::Simulator::Stop(at(until) - ns3::Simulator::Now());
    ns3::Simulator::Run();
  }

 private:
  // What one radio still has to send, and ns-3's radio.
  struct Radio {
    Ns3LrWpan* owner;
    std::size_t number;
    ns3::Ptr<ns3::ConstantPositionMobilityModel> place;
    ns3::Ptr<ns3::LrWpanNetDevice> device;
    std::deque<Request> queue;
    std::size_t next = 0;                // fragment of the first message
    std::uint64_t sending = 0, uid = 0;  // the message whose frame ns-3 has, and its number there; 0: none
    bool has_arrived = false;            // some of it, at somebody
    std::map<std::size_t, std::pair<std::size_t, std::string>> parts;  // by receiver: fragments that came, and bytes

    // Not any more, once it left.
    bool has(std::uint64_t message) const { return !queue.empty() && queue.front().message == message; }
    // Receivers hear the end of a frame later than its sender, by the time that it travels.
    void confirm(ns3::McpsDataConfirmParams result) {
      ns3::Simulator::Schedule(ns3::MicroSeconds(10), [this, result] { owner->confirm(*this, result); });
    }
    void indicate(ns3::McpsDataIndicationParams, ns3::Ptr<ns3::Packet> frame) { owner->hear(*this, frame); }
  };
  struct Sent {
    std::size_t from, fragment;
    std::uint64_t message;
  };

  // Since the simulation began; ns-3 counts nanoseconds.
  ns3::Time at(double time) const { return ns3::NanoSeconds(std::llround(1e9 * (time - start_))); }

  void join() {
    auto radio = std::make_unique<Radio>();
    radio->owner = this;
    radio->number = radios_.size();
    radio->place = ns3::CreateObject<ns3::ConstantPositionMobilityModel>();
    radio->device = ns3::CreateObject<ns3::LrWpanNetDevice>();
    radio->device->SetChannel(channel_);
    auto node = ns3::CreateObject<ns3::Node>();
    node->AggregateObject(radio->place);
    node->AddDevice(radio->device);
    ns3::LrWpanSpectrumValueHelper spectrum;
    auto phy = radio->device->GetPhy();
    phy->SetMobility(radio->place);
    phy->SetTxPowerSpectralDensity(spectrum.CreateTxPowerSpectralDensity(0, 11));
    auto noise = spectrum.CreateNoisePowerSpectralDensity(11);
    *noise *= std::pow(10, (settings_.noise - ns3_noise) / 10);
    phy->SetNoisePowerSpectralDensity(noise);
    auto mac = radio->device->GetMac();
    radio->device->SetAddress(address_of(radio->number));
    mac->SetPanId(0);
    mac->SetMcpsDataConfirmCallback(ns3::MakeCallback(&Radio::confirm, radio.get()));
    mac->SetMcpsDataIndicationCallback(ns3::MakeCallback(&Radio::indicate, radio.get()));
    radio->device->AssignStreams(static_cast<int64_t>(16 * radio->number));
    loss_->join(ns3::PeekPointer(radio->place));
    radios_.push_back(std::move(radio));
  }

  static ns3::Mac16Address address_of(std::size_t radio) {
    const std::uint8_t bytes[] = {static_cast<std::uint8_t>((radio + 1) >> 8), static_cast<std::uint8_t>(radio + 1)};
    ns3::Mac16Address result;
    result.CopyFrom(bytes);
    return result;
  }

  void take(Request request) {
    Radio& radio = *radios_[request.from];
    if (radio.queue.size() > settings_.queue) return end(request.message, End::queue_full);
    radio.queue.push_back(std::move(request));
    if (radio.queue.size() == 1 && radio.sending == 0) send(radio);
  }

  void send(Radio& radio) {
    if (radio.queue.empty()) return;
    const Request& message = radio.queue.front();
    const bool is_whole = fragments_of(message.payload.size()) == 1;
    const std::size_t head = is_whole ? 0 : radio.next == 0 ? 4 : 5;
    std::string bytes(head, '\0');
    bytes += message.payload.substr(radio.next * in_a_fragment, is_whole ? std::string::npos : in_a_fragment);
    const auto frame = ns3::Create<ns3::Packet>(reinterpret_cast<const std::uint8_t*>(bytes.data()),
                                                static_cast<std::uint32_t>(bytes.size()));
    sent_[frame->GetUid()] = {radio.number, radio.next, message.message};
    radio.sending = message.message;
    radio.uid = frame->GetUid();
    ns3::McpsDataRequestParams how;
    how.m_dstPanId = 0;
    how.m_srcAddrMode = how.m_dstAddrMode = ns3::SHORT_ADDR;
    how.m_dstAddr = message.to == everyone ? ns3::Mac16Address("ff:ff") : address_of(message.to);
    how.m_txOptions = message.to != everyone && settings_.acknowledge ? ns3::TX_OPTION_ACK : ns3::TX_OPTION_NONE;
    radio.device->GetMac()->McpsDataRequest(how, frame);
  }

  // A frame that was sent again, since its acknowledgement was lost, comes twice.
  void hear(Radio& at, const ns3::Ptr<ns3::Packet>& frame) {
    const auto found = sent_.find(frame->GetUid());
    if (found == sent_.end()) return;
    const Sent& it = found->second;
    Radio& from = *radios_[it.from];
    if (!from.has(it.message)) return;
    auto& [count, bytes] = from.parts[at.number];
    if (count != it.fragment) return;
    from.has_arrived = true;
    const std::size_t size = from.queue.front().payload.size(), fragments = fragments_of(size);
    const std::size_t head = fragments == 1 ? 0 : it.fragment == 0 ? 4 : 5;
    std::string all(frame->GetSize(), '\0');
    frame->CopyData(reinterpret_cast<std::uint8_t*>(all.data()), frame->GetSize());
    bytes.append(all, head);
    if (++count == fragments)
      deliver({it.message, at.number, start_ + ns3::Simulator::Now().GetSeconds(), loss_->rssi(it.from, at.number),
               std::move(bytes)});
  }

  void confirm(Radio& radio, const ns3::McpsDataConfirmParams& result) {
    sent_.erase(radio.uid);
    const std::uint64_t message = std::exchange(radio.sending, 0);
    if (!radio.has(message)) {
      start_next(radio);
    } else if (result.m_status == ns3::IEEE_802_15_4_SUCCESS) {
      ++radio.next;
      if (radio.next < fragments_of(radio.queue.front().payload.size())) return send(radio);
      finish(radio, End::sent);
    } else {
      const bool no_access = result.m_status == ns3::IEEE_802_15_4_CHANNEL_ACCESS_FAILURE;
      finish(radio, no_access ? End::no_access : radio.has_arrived ? End::no_ack : End::sent);
    }
  }

  void finish(Radio& radio, End why) {
    const std::uint64_t message = radio.queue.front().message;
    radio.queue.pop_front();
    start_next(radio);
    end(message, why);
  }
  void start_next(Radio& radio) {
    radio.next = 0;
    radio.has_arrived = false;
    radio.parts.clear();
    send(radio);
  }

  static constexpr double ns3_noise = -106.987;  // dBm, of 5 MHz at 290 K
  LrWpanSettings settings_;
  World world_;
  double start_ = 0;
  ns3::Ptr<OurLoss> loss_;
  ns3::Ptr<ns3::SingleModelSpectrumChannel> channel_;
  std::vector<std::unique_ptr<Radio>> radios_;
  std::unordered_map<std::uint64_t, Sent> sent_;  // by ns-3's number of the packet
};

}  // namespace

bool is_ns3_taken() { return ns3::NodeList::GetNNodes() > 0; }

std::unique_ptr<Backend> make_ns3_lr_wpan(const LrWpanSettings& settings) {
  return std::make_unique<Ns3LrWpan>(settings);
}

}  // namespace muster::external
