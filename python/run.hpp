// A simulation as Python holds it: one call at a time, without the interpreter's lock while it steps.
#pragma once

#include <pybind11/stl.h>

#include <atomic>
#include <chrono>
#include <map>
#include <optional>

#include "function.hpp"

namespace muster::python {

struct NamedCode {
  std::string name, robot;
  uint64_t every = 1;
  Place place;
  std::shared_ptr<InstanceCode> code;

  InstanceDeclaration declared() const { return code->declared(name, robot, every, place); }
};

inline InstanceDeclaration declared_plugin(const std::string& name, const std::string& plugin,
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
    if (like && !like->run_) throw Error(Exit::invalid_input, "like: the simulation is closed");
    World world = read_world(path, standard());
    if (seed) world.seed = *seed;
    if (until) world.ticks = ticks_of(*until, world.dt, {"until"});
    Options options{{plugins.begin(), plugins.end()}, workers, {}};
    options.libraries = own_libraries();
    if (like) {
      for (const auto& instance : like->run_->instances()) {
        if (!instance->declared().library) options.libraries.push_back(instance->library());
      }
      options.tables = like->tables_;
    }
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
    function.name = instance;
    change([&](Simulation& run) { run.swap(instance, function.declared()); });
    codes_.push_back(function.code);
  }
  void insert(const NamedCode& function) {
    change([&](Simulation& run) { run.insert(function.declared()); });
    codes_.push_back(function.code);
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
        result.append(py::make_tuple(static_cast<double>(event.tick) * run.world().dt, event.instance, event.message));
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

}  // namespace muster::python
