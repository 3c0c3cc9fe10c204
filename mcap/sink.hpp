// Where channels and their messages go: a file, or clients that watch.
#pragma once

#include "records.hpp"

namespace muster::mcap {

class Sink {
 public:
  virtual ~Sink() = default;

  // Numbers are given by the sink.
  virtual std::uint16_t schema(Schema schema) = 0;
  virtual std::uint16_t channel(Channel channel) = 0;
  // On a channel of this sink. The data are read before it returns.
  virtual void message(const Message& message) = 0;
};

}  // namespace muster::mcap
