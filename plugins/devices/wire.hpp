// What carries datagrams: a socket, one that loses and delays them, or a test's own.
#pragma once

#include <cstdint>
#include <muster/random.hpp>
#include <string>
#include <vector>

namespace muster::devices {

struct Address {
  std::uint32_t host = 0;
  std::uint16_t port = 0;
  bool operator==(const Address& other) const { return host == other.host && port == other.port; }
  std::string text() const;  // "127.0.0.1:47480"
};
// "127.0.0.1" and a port. Throws BadInput where the text is no IPv4 address.
Address address_of(const std::string& host, std::uint16_t port);

// Datagrams that are taken in one tick: more than a socket's buffer holds unless somebody has enlarged it, so that all
// of before are taken, and whoever sends on and on does not keep the run from its next tick.
constexpr std::size_t most_at_once = 4096;

class Wire {
 public:
  virtual ~Wire() = default;
  // What cannot be sent is lost.
  virtual void send(const Address& to, const std::string& bytes) = 0;
  // False: nothing has come. Never waits.
  virtual bool receive(Address& from, std::string& bytes) = 0;
};

class UdpSocket : public Wire {
 public:
  // Port 0: one that is free. Throws BadInput.
  explicit UdpSocket(const Address& at);
  ~UdpSocket() override;
  UdpSocket(const UdpSocket&) = delete;
  UdpSocket& operator=(const UdpSocket&) = delete;
  void send(const Address& to, const std::string& bytes) override;
  bool receive(Address& from, std::string& bytes) override;
  const Address& at() const { return at_; }

 private:
  int descriptor_ = -1;
  Address at_;
};

// Loses a share of the datagrams of either direction, and delivers the others after a delay with a uniform jitter, in
// which they overtake one another.
class RoughWire : public Wire {
 public:
  struct Settings {
    double loss = 0, delay = 0, jitter = 0;  // share, s, s
  };
  RoughWire(Wire& inner, const Settings& settings, Stream random)
      : inner_(inner), settings_(settings), random_(random) {}
  // To be told before each use: [s] of the run. Sends what is due.
  void at(double now);
  void send(const Address& to, const std::string& bytes) override;
  bool receive(Address& from, std::string& bytes) override;

 private:
  struct Underway {
    double due;
    Address other;
    std::string bytes;
  };
  void send_due();
  void put(std::vector<Underway>& to, const Address& other, const std::string& bytes);
  static bool take(std::vector<Underway>& from, double now, Underway& taken);

  Wire& inner_;
  Settings settings_;
  Stream random_;
  double now_ = 0;
  std::uint64_t count_ = 0;
  std::size_t left_ = most_at_once;  // to be taken from the inner wire now
  std::vector<Underway> out_, in_;
};

}  // namespace muster::devices
