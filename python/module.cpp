// The module muster._muster: simulations, functions as instances, and calibration, for the package around it.
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <chrono>
#include <cmath>
#include <map>
#include <thread>

#include "calibration.hpp"
#include "instance_code.hpp"
#include "loader/elf.hpp"
#include "text/names.hpp"

namespace py = pybind11;

namespace muster::python {
namespace {

using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

PyObject* error_type = nullptr;  // muster.Error

// Raises muster.Error with the same text; `cause`: what a function of Python raised, or null.
void raise(Exit code, const std::string& text, PyObject* cause = nullptr) {
  py::object error = py::reinterpret_steal<py::object>(PyObject_CallFunction(error_type, "s", text.c_str()));
  if (!error) return;  // Python's own error is set
  error.attr("code") = static_cast<int>(code);
  if (cause) PyException_SetCause(error.ptr(), py::reinterpret_borrow<py::object>(cause).release().ptr());
  PyErr_SetObject(error_type, error.ptr());
}

// ---- Numbers ----

// A view without a copy, read-only. It owns `owner`.
template <class Owner>
py::array view_of(const double* data, std::vector<py::ssize_t> shape, Owner owner) {
  const py::capsule base(new Owner(std::move(owner)), [](void* held) { delete static_cast<Owner*>(held); });
  Array result(std::move(shape), data, base);
  result.attr("setflags")(py::arg("write") = false);
  return result;
}

py::array copy_of(const muster_in& view, bool one_row) {
  if (one_row) return Array(static_cast<py::ssize_t>(view.cols), view.data);
  return Array({static_cast<py::ssize_t>(view.rows), static_cast<py::ssize_t>(view.cols)}, view.data);
}

std::string shape_text(const py::array& array) {
  std::string text;
  for (py::ssize_t d = 0; d < array.ndim(); ++d) text += (d ? " x " : "") + std::to_string(array.shape(d));
  return array.ndim() ? text : "a single number";
}

Array numbers(const py::object& value, const std::string& what) {
  Array result = Array::ensure(value);
  if (result) return result;
  PyErr_Clear();
  throw Error(Exit::invalid_input, what + ": expected numbers, got " + std::string(py::str(py::type::of(value))));
}

// ---- Functions of Python ----

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
  // The other cells of the row are `values`, without that of the bytes.
  void send(const std::string& table, const py::bytes& payload, const std::vector<double>& values) const {
    const std::size_t at = find(table);
    const Port& port = ports_[at];
    const uint32_t cols = call().in[at].cols;
    if (!port.is_queue || port.bytes < 0 || port.kind != MUSTER_WRITE)
      throw Error(Exit::invalid_input, quote(table) + " is no queue of messages that the function writes");
    if (values.size() + 1 != cols)
      throw Error(Exit::invalid_input, "send to " + quote(table) + ": " + std::to_string(values.size()) +
                                           " values; expected " + std::to_string(cols - 1) + " beside the payload");
    double* row = call().host->append(call().host, static_cast<int>(at), 1);
    for (uint32_t c = 0, next = 0; c < cols; ++c) {
      if (static_cast<int>(c) != port.bytes) row[c] = std::isnan(values[next]) ? null() : values[next];
      if (static_cast<int>(c) != port.bytes) ++next;
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

  static void fill(const py::object& value, const Port& port, const muster_out& out) {
    const Array given = numbers(value, port.table);
    const std::size_t count = std::size_t{out.rows} * out.cols;
    const bool one_column = given.ndim() == 1 && out.cols == 1;  // an array of rows will do
    const bool fits = given.ndim() == 2 ? given.shape(0) == out.rows && given.shape(1) == out.cols
                                        : given.ndim() == (port.one_row && out.cols == 1 ? 0 : 1) || one_column;
    if (!fits || static_cast<std::size_t>(given.size()) != count || (given.ndim() == 1 && out.rows > 1 && !one_column))
      throw std::runtime_error("gives " + shape_text(given) + " for " + port.table + "; expected " +
                               (port.one_row ? "" : std::to_string(out.rows) + " x ") + std::to_string(out.cols));
    // One bit pattern is null; computed ones may have another sign.
    std::transform(given.data(), given.data() + count, out.data, [](double v) { return std::isnan(v) ? null() : v; });
  }

  py::object code_, raised_;
};

// ---- Simulations ----

struct NamedCode {
  std::string name, robot;
  uint64_t every = 1;
  Place place;
  std::shared_ptr<InstanceCode> code;

  InstanceDeclaration declared() const { return code->declared(name, robot, every, place); }
};

InstanceDeclaration declared_plugin(const std::string& name, const std::string& plugin,
                                    const std::map<std::string, std::string>& attributes) {
  const Place place{"swap"};
  XmlElement element{plugin, place, {}, {}};
  for (const auto& [attribute, value] : attributes) element.attributes.push_back({attribute, value, place, place});
  InstanceDeclaration result = read_instance(element, plugin);
  result.name = name;
  return result;
}

class Run {
 public:
  Run(const std::string& path, const std::vector<std::string>& plugins, std::optional<uint64_t> seed,
      std::optional<double> until, int workers, const std::vector<NamedCode>& functions,
      const std::vector<std::string>& inputs, const Run* like) {
    World world = read_world(path, standard());
    if (seed) world.seed = *seed;
    if (until) world.ticks = ticks_of(*until, world.dt, {"until"});
    Options options{{plugins.begin(), plugins.end()}, workers, {}};
    options.libraries = own_libraries();
    for (std::size_t i = 0; like && i < like->run_->instances().size(); ++i)
      options.libraries.push_back(like->run_->instances()[i]->library());
    if (like) options.tables = like->tables_;
    tables_ = options.tables = options.tables ? options.tables : std::make_shared<TableCache>();
    for (const auto& table : inputs) {
      auto rows = std::make_shared<SetRows>(table);
      std::string name = "set." + table;
      std::replace(name.begin(), name.end(), '/', '.');
      std::replace(name.begin(), name.end(), '*', '-');
      options.more.push_back(rows->declared(name, "", 1, {"inputs"}));
      inputs_[table] = rows;
      codes_.push_back(std::move(rows));
    }
    for (const auto& function : functions) {
      options.more.push_back(function.declared());
      codes_.push_back(function.code);
    }
    try {
      const py::gil_scoped_release no_gil;
      run_ = std::make_unique<Simulation>(std::move(world), standard(), std::move(options));
    } catch (const Error& e) {
      fail(e);
    }
  }
  ~Run() {
    const py::gil_scoped_release no_gil;  // its functions take the lock to go
    run_.reset();
    codes_.clear();
    inputs_.clear();
  }

  // Runs a change or a look, alone: functions that are called in a step see tables by their claims only.
  template <class Body>
  auto use(Body&& body) {
    if (busy_.exchange(true))
      throw Error(Exit::invalid_input,
                  "the simulation is in a step; a function in it reads and writes what it claims, and no more");
    struct Free {
      std::atomic<bool>& busy;
      ~Free() { busy = false; }
    } free{busy_};
    if (!run_) throw Error(Exit::invalid_input, "the simulation is closed");
    try {
      return body(*run_);
    } catch (const Error& e) {
      fail(e);
    }
  }
  template <class Body>
  auto change(Body&& body) {
    return use([&](Simulation& run) {
      const py::gil_scoped_release no_gil;
      return body(run);
    });
  }

  void step(uint64_t ticks) {
    change([&](Simulation& run) {
      auto seen = std::chrono::steady_clock::now();
      for (uint64_t i = 0; i < ticks; ++i) {
        run.step();
        if (i % 16 != 15 || std::chrono::steady_clock::now() - seen < std::chrono::milliseconds(100)) continue;
        seen = std::chrono::steady_clock::now();
        const py::gil_scoped_acquire gil;
        if (PyErr_CheckSignals()) throw py::error_already_set();
      }
    });
  }

  py::array table(const std::string& name) {
    return use([&](Simulation& run) -> py::array {
      const TableView view = run.table(name);
      const auto rows = static_cast<py::ssize_t>(view.rows()), cols = static_cast<py::ssize_t>(view.cols());
      if (rows == 0) return Array({rows, cols});
      const double* data = view.table->now().data.data();
      if (view.row >= 0) return view_of(data + view.row * cols, {cols}, view.table->hold());
      return view_of(data, {rows, cols}, view.table->hold());
    });
  }
  py::list columns(const std::string& name) {
    return use([&](Simulation& run) {
      py::list result;
      for (const Column& c : run.table(name).table->columns())
        result.append(py::make_tuple(c.name, c.unit, c.reference, c.nullable, c.bytes));
      return result;
    });
  }
  std::vector<std::string> rows(const std::string& name) {
    return use([&](Simulation& run) {
      const TableView view = run.table(name);
      const Set& set = view.table->set();
      if (view.row >= 0) return std::vector<std::string>{set.names[static_cast<std::size_t>(view.row)]};
      return set.is_named() ? set.names : std::vector<std::string>{};
    });
  }
  py::list payloads(const std::string& name) {
    return use([&](Simulation& run) {
      const TableView view = run.table(name);
      const Columns& columns = view.table->columns();
      const auto column = std::find_if(columns.begin(), columns.end(), [](const Column& c) { return c.bytes; });
      if (column == columns.end()) throw Error(Exit::invalid_input, quote(name) + " has no column of bytes");
      py::list result;
      for (std::size_t r = 0; r < view.rows(); ++r) {
        const auto blob = static_cast<std::size_t>(view.at(r, static_cast<std::size_t>(column - columns.begin())));
        const auto& blobs = view.table->now().blobs;
        result.append(blob ? py::bytes(reinterpret_cast<const char*>(blobs[blob - 1]->data()), blobs[blob - 1]->size())
                           : py::bytes());
      }
      return result;
    });
  }
  std::vector<std::string> tables() {
    return use([&](Simulation& run) {
      std::vector<std::string> result;
      for (const auto& [name, table] : run.board().tables()) result.push_back(name);
      return result;
    });
  }
  std::vector<bool> alive(const std::string& name) {
    return use([&](Simulation& run) {
      const Set& set = run.table(name).table->set();
      return std::vector<bool>(set.alive.begin(), set.alive.end());
    });
  }

  SetRows& input(const std::string& table) const {
    const auto found = inputs_.find(table);
    if (found != inputs_.end()) return *found->second;
    std::vector<std::string> valid;
    for (const auto& [name, rows] : inputs_) valid.push_back(name);
    throw Error(Exit::invalid_input, quote(table) + " is no input of the simulation; " +
                                         (valid.empty() ? "it has none: give inputs=[\"" + table + "\"] when it is made"
                                                        : suggest(table, valid)));
  }
  void set_rows(const std::string& table, const py::object& values) {
    use([&](Simulation& run) {
      SetRows& rows = input(table);
      const Array given = numbers(values, table);
      const TableView view = run.table(table);
      const auto count = view.rows() * view.cols();
      const bool flat = given.ndim() == 1 && view.rows() == 1;
      if (static_cast<std::size_t>(given.size()) != count ||
          !(flat || (given.ndim() == 2 && static_cast<std::size_t>(given.shape(1)) == view.cols())))
        throw Error(Exit::invalid_input, quote(table) + ": values are " + shape_text(given) + "; expected " +
                                             (view.row >= 0 ? "" : std::to_string(view.rows()) + " x ") +
                                             std::to_string(view.cols()));
      rows.set(given.data(), count);
    });
  }

  py::list parameters() {
    return use([&](Simulation& run) {
      py::list result;
      for (const ParameterInfo& p : run.parameters()) result.append(py::make_tuple(p.path, p.value, p.declared->unit));
      return result;
    });
  }
  double parameter(const std::string& path) {
    return use([&](Simulation& run) { return run.parameter(path).value; });
  }
  void set_parameter(const std::string& path, double value) {
    use([&](Simulation& run) { run.set_parameter(path, value); });
  }

  void swap(const std::string& instance, const std::string& plugin, const std::map<std::string, std::string>& with) {
    change([&](Simulation& run) { run.swap(instance, declared_plugin(instance, plugin, with)); });
  }
  void swap_to(const std::string& instance, NamedCode function) {
    codes_.push_back(function.code);
    function.name = instance;
    change([&](Simulation& run) { run.swap(instance, function.declared()); });
  }
  void insert(const NamedCode& function) {
    codes_.push_back(function.code);
    change([&](Simulation& run) { run.insert(function.declared()); });
  }
  void remove(const std::string& instance) {
    change([&](Simulation& run) { run.remove(instance); });
  }
  py::list instances() {
    return use([&](Simulation& run) {
      py::list result;
      for (const auto& instance : run.instances())
        result.append(py::make_tuple(instance->name(), instance->plugin().id, phase_name(instance->phase())));
      return result;
    });
  }
  py::list events() {
    return use([&](Simulation& run) {
      py::list result;
      for (const Event& event : run.events())
        result.append(
            py::make_tuple(static_cast<double>(event.tick) * run.world().dt, event.instance, event.message));
      return result;
    });
  }

  std::shared_ptr<Snapshot> snapshot() {
    return use([&](Simulation& run) { return std::make_shared<Snapshot>(run.snapshot()); });
  }
  void restore(const Snapshot& snapshot) {
    change([&](Simulation& run) { run.restore(snapshot); });
    for (const auto& [name, rows] : inputs_) rows->forget();
  }
  void evaluate(bool expected) {
    change([&](Simulation& run) { run.evaluate(MUSTER_RADIO, expected); });
  }
  void close() {
    if (!run_) return;
    change([&](Simulation& run) { run.close(); });
    const py::gil_scoped_release no_gil;
    run_.reset();
    codes_.clear();
    inputs_.clear();
  }
  template <class Get>
  auto get(Get&& get) {
    return use([&](Simulation& run) { return get(run); });
  }

 private:
  friend class Batch;
  // As an exception of Python, after what a function raised.
  [[noreturn]] void fail(const Error& error) {
    for (const auto& code : codes_) {
      auto* function = dynamic_cast<Function*>(code.get());
      const py::object cause = function ? function->raised() : py::object();
      if (!cause) continue;
      if (PyObject_IsInstance(cause.ptr(), PyExc_Exception) == 1)
        raise(error.exit(), error.what(), cause.ptr());
      else
        PyErr_SetObject(reinterpret_cast<PyObject*>(Py_TYPE(cause.ptr())), cause.ptr());  // KeyboardInterrupt and such
      throw py::error_already_set();
    }
    throw error;
  }

  std::atomic<bool> busy_{false};
  std::vector<std::shared_ptr<InstanceCode>> codes_;
  std::map<std::string, std::shared_ptr<SetRows>> inputs_;
  std::shared_ptr<TableCache> tables_;
  std::unique_ptr<Simulation> run_;
};

// Many simulations stepped, read and set in one call each.
class Batch {
 public:
  explicit Batch(std::vector<std::shared_ptr<Run>> runs) : runs_(std::move(runs)) {
    if (runs_.empty()) throw Error(Exit::invalid_input, "a batch of no simulations; expected one at least");
  }

  // Threads take equal parts. After a failure the others are stepped all the same; the first failure is raised.
  void step(uint64_t ticks, int threads) {
    std::vector<std::optional<Error>> faults(runs_.size());
    std::size_t taken = 0;
    const auto free = [&] {
      for (std::size_t i = 0; i < taken; ++i) runs_[i]->busy_ = false;
    };
    for (; taken < runs_.size(); ++taken) {
      if (!runs_[taken]->run_ || runs_[taken]->busy_.exchange(true)) {
        free();
        throw Error(Exit::invalid_input, "simulation " + std::to_string(taken) + " of the batch is closed or in a step");
      }
    }
    {
      const py::gil_scoped_release no_gil;
      const auto part = [&](std::size_t from, std::size_t to) {
        for (std::size_t i = from; i < to; ++i) {
          try {
            for (uint64_t k = 0; k < ticks; ++k) runs_[i]->run_->step();
          } catch (const Error& e) {
            faults[i] = e;
          }
        }
      };
      const auto count = std::clamp<std::size_t>(static_cast<std::size_t>(std::max(threads, 1)), 1, runs_.size());
      std::vector<std::thread> others;
      for (std::size_t t = 1; t < count; ++t)
        others.emplace_back(part, runs_.size() * t / count, runs_.size() * (t + 1) / count);
      part(0, runs_.size() / count);
      for (auto& other : others) other.join();
    }
    free();
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      if (faults[i]) runs_[i]->fail(*faults[i]);
    }
  }

  // The table of each simulation, copied beside each other.
  py::array table(const std::string& name) {
    Array result;
    std::size_t count = 0;
    for (std::size_t i = 0; i < runs_.size(); ++i) {
      runs_[i]->use([&](Simulation& run) {
        const TableView view = run.table(name);
        if (i == 0) {
          count = view.rows() * view.cols();
          std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(runs_.size())};
          if (view.row < 0) shape.push_back(static_cast<py::ssize_t>(view.rows()));
          shape.push_back(static_cast<py::ssize_t>(view.cols()));
          result = Array(shape);
        }
        if (view.rows() * view.cols() != count)
          throw Error(Exit::invalid_input, quote(name) + " has " + std::to_string(view.rows()) +
                                               " rows in simulation " + std::to_string(i) +
                                               " of the batch, and another number in the first");
        const double* from = view.table->now().data.data();
        if (view.row >= 0) from += static_cast<std::size_t>(view.row) * view.cols();
        std::copy_n(from, count, result.mutable_data() + i * count);
      });
    }
    return std::move(result);
  }

  void set_rows(const std::string& name, const py::object& values) {
    const Array given = numbers(values, name);
    const TableView first = runs_[0]->get([&](Simulation& run) { return run.table(name); });
    const std::size_t count = first.rows() * first.cols();
    if (given.ndim() == 0 || static_cast<std::size_t>(given.shape(0)) != runs_.size() ||
        static_cast<std::size_t>(given.size()) != runs_.size() * count)
      throw Error(Exit::invalid_input, quote(name) + ": values are " + shape_text(given) + "; expected " +
                                           std::to_string(runs_.size()) + " x " +
                                           (first.row >= 0 ? "" : std::to_string(first.rows()) + " x ") +
                                           std::to_string(first.cols()));
    for (std::size_t i = 0; i < runs_.size(); ++i)
      runs_[i]->use([&](Simulation&) { runs_[i]->input(name).set(given.data() + i * count, count); });
  }

 private:
  std::vector<std::shared_ptr<Run>> runs_;
};

bool interrupted_by_python() {
  const py::gil_scoped_acquire gil;
  return PyErr_CheckSignals() != 0;
}

py::str fit_json(const FitWords& words, const std::vector<std::string>& plugins) {
  std::string result;
  {
    const py::gil_scoped_release no_gil;
    result = fit(words, {plugins.begin(), plugins.end()});
  }
  return result;
}

py::str diagnose_json(const std::string& world, const std::string& data, const std::string& out,
                      const std::vector<std::string>& plugins) {
  std::string result;
  bool stopped = false;
  {
    const py::gil_scoped_release no_gil;
    result = diagnose(world, data, out, {plugins.begin(), plugins.end()},
                      [&] { return stopped = stopped || interrupted_by_python(); });
  }
  if (stopped) throw py::error_already_set();
  return result;
}

std::string hexadecimal(uint64_t digest) {
  char text[17];
  std::snprintf(text, sizeof text, "%016llx", static_cast<unsigned long long>(digest));
  return text;
}

void bind_functions(py::module_& module) {
  py::class_<Tick, std::shared_ptr<Tick>>(module, "Tick", "What a function sees of the tick that it is called in.")
      .def_property_readonly("time", &Tick::time, "Time of the values that are written, in s.")
      .def_property_readonly("dt", &Tick::dt, "The instance's own period, in s.")
      .def_property_readonly("index", &Tick::index, "Number of the tick; 0 before the first.")
      .def_property_readonly("expected", &Tick::expected, "True where a mean is wanted instead of a draw.")
      .def_property_readonly("seed", &Tick::seed, "From the world's seed and the function's name; with `index` the seed "
                                                  "of random numbers that are the same in each run.")
      .def("event", &Tick::event, "Adds a line to the events of the run.", py::arg("message"))
      .def("names", &Tick::names, "Names of the rows of a set, such as \"robot\", by number.", py::arg("set"))
      .def("last", &Tick::last, "What the function last wrote to a table, or the stage before: a copy.",
           py::arg("table"))
      .def("payloads", &Tick::payloads, "The bytes of each row of a table that the function claims.", py::arg("table"))
      .def("send", &Tick::send, "Appends a row to a queue: its bytes, and the values of its other columns.",
           py::arg("table"), py::arg("payload"), py::arg("values"));
  py::class_<InstanceCode, std::shared_ptr<InstanceCode>>(module, "InstanceCode");
  py::class_<Function, InstanceCode, std::shared_ptr<Function>>(module, "Code")
      .def(py::init([](py::object code, const std::string& phase,
                       const std::vector<std::tuple<std::string, std::string, std::string>>& claims,
                       const std::string& stream) {
        std::vector<Port> ports;
        for (const auto& [kind, table, columns] : claims) ports.emplace_back(kind, table, columns);
        return std::make_shared<Function>(std::move(code), phase, std::move(ports), stream);
      }));
  py::class_<NamedCode>(module, "NamedCode")
      .def(py::init([](const std::string& name, const std::string& robot, uint64_t every, const std::string& file,
                       int line, std::shared_ptr<Function> code) {
        return NamedCode{name, robot, every, Place{file, line, 0}, std::move(code)};
      }));
}

void bind_runs(py::module_& module) {
  py::class_<Snapshot, std::shared_ptr<Snapshot>>(module, "Snapshot", "The state of a simulation between two ticks.")
      .def_readonly("tick", &Snapshot::tick)
      .def("digest", [](const Snapshot& s) { return hexadecimal(s.digest()); }, "Hash of rows and tables, in hex.")
      .def("save", [](const Snapshot& s, const std::string& file) { s.save(file); },
           "Writes a file that `muster run --restore` reads, too.", py::arg("file"))
      .def_static("load", [](const std::string& file) { return std::make_shared<Snapshot>(Snapshot::load(file)); },
                  "Reads a file of save() or `muster run --save`.", py::arg("file"));
  py::class_<Run, std::shared_ptr<Run>>(module, "Run")
      .def(py::init<const std::string&, const std::vector<std::string>&, std::optional<uint64_t>, std::optional<double>,
                    int, const std::vector<NamedCode>&, const std::vector<std::string>&, const Run*>())
      .def("step", &Run::step)
      .def("table", &Run::table)
      .def("columns", &Run::columns)
      .def("rows", &Run::rows)
      .def("alive", &Run::alive)
      .def("payloads", &Run::payloads)
      .def("tables", &Run::tables)
      .def("set_rows", &Run::set_rows)
      .def("parameters", &Run::parameters)
      .def("parameter", &Run::parameter)
      .def("set_parameter", &Run::set_parameter)
      .def("swap", &Run::swap)
      .def("swap_to", &Run::swap_to)
      .def("insert", &Run::insert)
      .def("remove", &Run::remove)
      .def("instances", &Run::instances)
      .def("events", &Run::events)
      .def("snapshot", &Run::snapshot)
      .def("restore", &Run::restore)
      .def("evaluate", &Run::evaluate)
      .def("close", &Run::close)
      .def("tick", [](Run& r) { return r.get([](Simulation& s) { return s.tick(); }); })
      .def("ticks", [](Run& r) { return r.get([](Simulation& s) { return s.world().ticks; }); })
      .def("time", [](Run& r) { return r.get([](Simulation& s) { return s.time(); }); })
      .def("dt", [](Run& r) { return r.get([](Simulation& s) { return s.world().dt; }); })
      .def("name", [](Run& r) { return r.get([](Simulation& s) { return s.world().name; }); })
      .def("seed", [](Run& r) { return r.get([](Simulation& s) { return s.world().seed; }); })
      .def("digest", [](Run& r) { return r.get([](Simulation& s) { return hexadecimal(s.digest()); }); });
  py::class_<Batch>(module, "Runs")
      .def(py::init<std::vector<std::shared_ptr<Run>>>())
      .def("step", &Batch::step)
      .def("table", &Batch::table)
      .def("set_rows", &Batch::set_rows);
}

}  // namespace

PYBIND11_MODULE(_muster, module) {
  module.doc() = "The part of the package muster that is C++; use the package.";
  error_type = PyErr_NewExceptionWithDoc(
      "muster.Error", "A fault that muster reports, in its own words. `code` is the exit code of the program.",
      PyExc_Exception, nullptr);
  module.attr("Error") = py::reinterpret_borrow<py::object>(error_type);
  py::register_exception_translator([](std::exception_ptr p) {
    try {
      if (p) std::rethrow_exception(p);
    } catch (const Error& e) {
      raise(e.exit(), e.what());
    } catch (const Refusal& e) {
      raise(Exit::plugin_fault, e.what());
    }
  });
  bind_functions(module);
  bind_runs(module);
  module.def("fit", [](const std::string& world, const std::string& data, const std::string& out,
                       const std::vector<std::string>& free, const std::vector<std::string>& fix, double cell, int least,
                       bool power, const std::vector<std::string>& plugins) {
    return fit_json({world, data, out, free, fix, cell, least, power}, plugins);
  });
  module.def("diagnose", diagnose_json);
  module.def("plot", [](const std::string& file, const std::vector<double>& x,
                        const std::vector<std::pair<std::string, std::vector<double>>>& lines,
                        const std::string& x_label, const std::string& y_label, const std::string& title) {
    std::vector<NamedLine> named;
    for (const auto& [name, values] : lines) named.push_back({name, values});
    plot(file, x, named, x_label, y_label, title);
  });
}

}  // namespace muster::python
