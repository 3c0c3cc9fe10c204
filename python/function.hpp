// Functions of Python as the code of instances.
#pragma once

#include <cmath>
#include <map>
#include <muster/plugin.hpp>

#include "arrays.hpp"
#include "instance_code.hpp"
#include "text/names.hpp"

namespace muster::python {

// What a function sees of the tick. Its calls fail after the function has returned.
class Tick {
 public:
  Tick(const Call& call, const std::vector<Port>& ports) : call_(&call), ports_(ports) {}
  void end() { call_ = nullptr; }

  double time() const { return call().tick->time; }
  double dt() const { return call().tick->dt; }
  uint64_t index() const { return call().tick->index; }
  bool expected() const { return call().tick->flags & MUSTER_EXPECTED; }
  uint64_t seed() const { return call().seed; }
  void event(const std::string& message) const { call().host->event(call().host, message.c_str()); }
  std::vector<std::string> names(const std::string& set) const {
    std::vector<std::string> result;
    const uint32_t rows = call().host->rows(call().host, set.c_str());
    for (uint32_t r = 0; r < rows; ++r) {
      const char* name = call().host->row_name(call().host, set.c_str(), r);
      result.emplace_back(name ? name : std::to_string(r));
    }
    return result;
  }
  py::array last(const std::string& table) const {
    const std::size_t port = find(table);
    return copy_of(call().in[port], ports_[port].one_row);
  }
  py::list payloads(const std::string& table) const {
    const std::size_t port = find(table);
    if (ports_[port].bytes < 0) throw Error(Exit::invalid_input, quote(table) + " has no column of bytes");
    py::list result;
    for (uint32_t r = 0; r < call().in[port].rows; ++r) {
      uint64_t count = 0;
      const uint8_t* data = call().host->get_bytes(call().host, static_cast<int>(port), r,
                                                   static_cast<uint32_t>(ports_[port].bytes), &count);
      result.append(py::bytes(reinterpret_cast<const char*>(data), count));
    }
    return result;
  }
  // `values`: of the other columns, without that of a queue's one owner; none: all are empty.
  void send(const std::string& table, const py::bytes& payload, const std::vector<double>& values) const {
    const std::size_t at = find(table);
    const Port& port = ports_[at];
    const uint32_t cols = call().in[at].cols, first = port.one_owner ? 1 : 0;
    if (!port.is_queue || port.bytes < 0 || port.kind != MUSTER_WRITE)
      throw Error(Exit::invalid_input, quote(table) + " is no queue of messages that the function writes");
    const uint32_t others = cols - first - 1;
    if (!values.empty() && values.size() != others)
      throw Error(Exit::invalid_input, "send to " + quote(table) + ": " + std::to_string(values.size()) +
                                           " values; expected " + std::to_string(others) + ", or none");
    double* row = call().host->append(call().host, static_cast<int>(at), 1);
    for (uint32_t c = first, next = 0; c < cols; ++c) {
      if (static_cast<int>(c) == port.bytes) continue;
      const double value = values.empty() ? null() : values[next++];
      row[c] = std::isnan(value) ? null() : value;
    }
    const std::string_view bytes = payload;
    call().host->put_bytes(call().host, static_cast<int>(at), sent_[at]++, static_cast<uint32_t>(port.bytes),
                           reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
  }

 private:
  const Call& call() const {
    if (call_) return *call_;
    throw Error(Exit::invalid_input, "the tick is over; expected calls while the function runs");
  }
  std::size_t find(const std::string& table) const {
    std::vector<std::string> valid;
    for (std::size_t i = 0; i < ports_.size(); ++i) {
      if (ports_[i].table == table) return i;
      valid.push_back(ports_[i].table);
    }
    throw Error(Exit::invalid_input, "the function claims no table " + quote(table) + "; " + suggest(table, valid));
  }
  const Call* call_;
  const std::vector<Port>& ports_;
  mutable std::map<std::size_t, uint32_t> sent_;
};

class Function : public InstanceCode {
 public:
  Function(py::object code, const std::string& phase, std::vector<Port> ports, std::string stream)
      : InstanceCode(phase_of(phase), std::move(ports), std::move(stream)), code_(std::move(code)) {}
  ~Function() override {
    const py::gil_scoped_acquire gil;
    code_ = {};
    raised_ = {};
  }

  void step(const Call& call) override {
    const py::gil_scoped_acquire gil;
    raised_ = {};
    const auto tick = std::make_shared<Tick>(call, ports());
    try {
      const py::object result = code_(*arguments(tick, call));
      tick->end();
      take(result, call);
    } catch (py::error_already_set& e) {
      tick->end();
      raised_ = e.value();
      if (e.trace()) PyException_SetTraceback(raised_.ptr(), e.trace().ptr());
      const std::string type = py::str(py::type::of(raised_).attr("__name__")), text = py::str(raised_);
      throw std::runtime_error(text.empty() ? type : type + ": " + text);
    } catch (...) {
      tick->end();
      throw;
    }
  }

  // The exception that ended the last step, or none; once.
  py::object raised() { return std::exchange(raised_, {}); }

 private:
  py::tuple arguments(const std::shared_ptr<Tick>& tick, const Call& call) const {
    py::list result;
    result.append(tick);
    for (std::size_t i = 0; i < ports().size(); ++i) {
      const uint32_t kind = ports()[i].kind;
      if (kind == MUSTER_READ || kind == MUSTER_MODIFY) result.append(copy_of(call.in[i], ports()[i].one_row));
    }
    return py::tuple(result);
  }

  // The function's result: an array for each output that is no queue.
  void take(const py::object& result, const Call& call) const {
    std::vector<std::size_t> outs;
    for (std::size_t i = 0; i < ports().size(); ++i) {
      if (ports()[i].kind != MUSTER_READ && !ports()[i].is_queue) outs.push_back(i);
    }
    if (outs.empty()) {
      if (!result.is_none()) throw std::runtime_error("returned a value, but writes no table; expected None");
      return;
    }
    if (outs.size() == 1) return fill(result, ports()[outs[0]], call.out[outs[0]]);
    if (!py::isinstance<py::tuple>(result) || py::len(result) != outs.size())
      throw std::runtime_error("returned " + std::string(py::str(py::type::of(result))) + "; expected a tuple of " +
                               std::to_string(outs.size()) + ", one for each table that it writes");
    const auto parts = py::reinterpret_borrow<py::tuple>(result);
    for (std::size_t i = 0; i < outs.size(); ++i) fill(parts[i], ports()[outs[i]], call.out[outs[i]]);
  }

  // "v[m/s] w[rad/s]" becomes "v[m/s], w[rad/s]".
  static std::string with_commas(const std::string& columns) {
    std::string result;
    for (const char c : columns) result += c == ' ' ? std::string(", ") : std::string(1, c);
    return result;
  }

  static void fill(const py::object& value, const Port& port, const muster_out& out) {
    const Array given = numbers(value, port.table);
    const std::size_t count = std::size_t{out.rows} * out.cols;
    const bool as_table = given.ndim() == 2 && given.shape(0) == out.rows && given.shape(1) == out.cols;
    const bool as_row = port.one_row && (given.ndim() == 1 || (given.ndim() == 0 && out.cols == 1));
    const bool as_column = !port.one_row && given.ndim() == 1 && out.cols == 1;
    if (!(as_table || as_row || as_column) || static_cast<std::size_t>(given.size()) != count)
      throw std::runtime_error("gives " + shape_text(given) + " for " + port.table + "; expected " +
                               (port.one_row ? "" : std::to_string(out.rows) + " x ") + std::to_string(out.cols) +
                               ": " + with_commas(port.columns));
    // One bit pattern is null; computed ones may have another sign.
    std::transform(given.data(), given.data() + count, out.data, [](double v) { return std::isnan(v) ? null() : v; });
  }

  py::object code_, raised_;
};

}  // namespace muster::python
