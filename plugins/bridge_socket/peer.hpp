// One address at which a client is waited for, and the client that has come. No call waits longer than it is told.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>

namespace muster::bridge {

// Closes a file descriptor with its owner.
class Descriptor {
 public:
  Descriptor() = default;
  explicit Descriptor(int number) : number_(number) {}
  Descriptor(Descriptor&& other) noexcept : number_(other.number_) { other.number_ = -1; }
  Descriptor& operator=(Descriptor&& other) noexcept;
  ~Descriptor() { close(); }
  void close();
  int get() const { return number_; }
  explicit operator bool() const { return number_ >= 0; }

 private:
  int number_ = -1;
};

class Peer {
 public:
  // Listens at 127.0.0.1 (port 0: one that is free), or at a Unix socket where `path` is not empty. Throws
  // std::runtime_error.
  Peer(uint16_t port, const std::string& path);
  ~Peer();
  Peer(const Peer&) = delete;
  Peer& operator=(const Peer&) = delete;

  const std::string& place() const { return place_; }  // "127.0.0.1:47474", or the path
  bool has_client() const { return static_cast<bool>(client_); }
  // Waits so many seconds for a client. False: none came.
  bool accept(double seconds);
  void drop();

  // Queues the bytes, and sends what the client takes within so many seconds. False: it has gone.
  bool send(const std::string& bytes, double seconds);

  enum class Got { frame, nothing, gone };
  // A frame without its length. What has come of an unfinished one is kept for the next call. Throws Malformed.
  Got receive(std::string& frame, double seconds);

 private:
  bool take_frame(std::string& frame);

  Descriptor listener_, client_;
  std::string place_, path_, unsent_, unread_;
};

// Thrown out of a wait by a signal, such as Ctrl-C.
struct Interrupted : std::runtime_error {
  Interrupted() : std::runtime_error("interrupted") {}
};

}  // namespace muster::bridge
