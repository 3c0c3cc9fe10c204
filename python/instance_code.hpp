// Instances of a world whose code is part of the embedding program: functions of Python, and rows that are set from
// outside. Plugins python.control, python.actuate, ..., one a phase; an instance finds its code by a number.
#pragma once

#include <muster/plugin.h>

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "kernel/simulation.hpp"

namespace muster::python {

// A table that an instance claims.
struct Port {
  // `columns` may be empty for a standard quantity. Throws Error where they are needed, or the kind is none.
  Port(const std::string& kind, std::string table, std::string columns);

  uint32_t kind = 0;  // MUSTER_READ, ...
  std::string table, columns;
  bool one_row = false;    // a row by its name: an array without the dimension of rows
  bool is_queue = false;   // rows are appended
  bool one_owner = false;  // a queue's rows of one owner, whom the kernel fills in
  int bytes = -1;          // its first column of bytes
};

// One step of an instance, as the kernel calls it.
struct Call {
  const muster_host* host;
  const muster_tick* tick;
  const muster_in* in;
  const muster_out* out;
  uint64_t seed;  // from the world's seed and the name of the code's random stream
};

class InstanceCode : public std::enable_shared_from_this<InstanceCode> {
 public:
  InstanceCode(uint32_t phase, std::vector<Port> ports, std::string stream);
  virtual ~InstanceCode();
  InstanceCode(const InstanceCode&) = delete;
  InstanceCode& operator=(const InstanceCode&) = delete;

  uint32_t phase() const { return phase_; }
  const std::vector<Port>& ports() const { return ports_; }
  const std::string& stream() const { return stream_; }  // name of its random stream
  // An instance that runs this code as long as it exists. `robot`: the one that it is bound to, or "".
  InstanceDeclaration declared(const std::string& name, const std::string& robot, uint64_t every,
                               const Place& place) const;

  // Fills every claimed output. Throws std::exception where it fails. Of several threads one at a time.
  virtual void step(const Call& call) = 0;

 private:
  uint32_t phase_;
  std::vector<Port> ports_;
  std::string stream_;
  uint64_t number_;
};

// Rows of one table that keep the values set last; until values are set, those that the table has.
class SetRows : public InstanceCode {
 public:
  // "robot/rover/command" or "robot/*/command" of a standard table that is no queue. Throws Error.
  explicit SetRows(const std::string& table);
  // Taken over by the next step. Throws Error for another number of values than the claim has.
  void set(const double* values, std::size_t count);
  // After a restore the table's values count, not those set before.
  void forget() { values_.clear(); }
  void step(const Call& call) override;

 private:
  std::vector<double> values_;
};

// Libraries of the plugins python.*.
const std::vector<std::shared_ptr<Library>>& own_libraries();
// "control" and so on. Throws Error for another word.
uint32_t phase_of(const std::string& word);

}  // namespace muster::python
