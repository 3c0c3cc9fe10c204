// The module muster._muster: simulations, functions as instances, and calibration, for the package around it.
#include "batch.hpp"
#include "calibration.hpp"
#include "loader/elf.hpp"

namespace muster::python {
namespace {

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
      .def_property_readonly("seed", &Tick::seed,
                             "From the world's seed and the function's name; with `index` the seed "
                             "of random numbers that are the same in each run.")
      .def("event", &Tick::event, "Adds a line to the events of the run.", py::arg("message"))
      .def("names", &Tick::names, "Names of the rows of a set, such as \"robot\", by number.", py::arg("set"))
      .def("last", &Tick::last, "What the function last wrote to a table, or the stage before: a copy.",
           py::arg("table"))
      .def("payloads", &Tick::payloads, "The bytes of each row of a table that the function claims.", py::arg("table"))
      .def("send", &Tick::send,
           "Appends a row to a queue: its bytes, and the values of its other columns but for the owner of a claimed "
           "row. Without values they are empty: a message to all.",
           py::arg("table"), py::arg("payload"), py::arg("values") = std::vector<double>());
  const py::class_<InstanceCode, std::shared_ptr<InstanceCode>> base(module, "InstanceCode");
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
      .def(
          "digest", [](const Snapshot& s) { return hexadecimal(s.digest()); }, "Hash of rows and tables, in hex.")
      .def(
          "save", [](const Snapshot& s, const std::string& file) { s.save(file); },
          "Writes a file that `muster run --restore` reads, too.", py::arg("file"))
      .def_static(
          "load", [](const std::string& file) { return std::make_shared<Snapshot>(Snapshot::load(file)); },
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
  py::handle(error_type).attr("code") = static_cast<int>(Exit::invalid_input);
  module.attr("Error") = py::reinterpret_borrow<py::object>(error_type);
  py::register_exception_translator([](std::exception_ptr p) {
    try {
      if (p) std::rethrow_exception(std::move(p));
    } catch (const Error& e) {
      raise(e.exit(), e.what());
    } catch (const Refusal& e) {
      raise(Exit::plugin_fault, e.what());
    }
  });
  bind_functions(module);
  bind_runs(module);
  module.def("fit", [](const std::string& world, const std::string& data, const std::string& out,
                       const std::vector<std::string>& free, const std::vector<std::string>& fix, double cell,
                       int least, bool power, const std::vector<std::string>& plugins) {
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
