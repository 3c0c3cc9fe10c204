// Many simulations of one world, stepped, read and set in one call each.
#pragma once

#include <thread>

#include "run.hpp"

namespace muster::python {

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
        throw Error(Exit::invalid_input,
                    "simulation " + std::to_string(taken) + " of the batch is closed or in a step");
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
  Array table(const std::string& name) {
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
    return result;
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

}  // namespace muster::python
