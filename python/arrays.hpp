// Arrays of numpy over a table's numbers, and errors of muster as exceptions of Python.
#pragma once

#include <muster/plugin.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <string>
#include <utility>
#include <vector>

#include "text/error.hpp"

namespace muster::python {

namespace py = pybind11;

using Array = py::array_t<double, py::array::c_style | py::array::forcecast>;

inline PyObject* error_type = nullptr;  // muster.Error

// Raises muster.Error with the same text; `cause`: what a function of Python raised, or null.
inline void raise(Exit code, const std::string& text, PyObject* cause = nullptr) {
  py::object error = py::reinterpret_steal<py::object>(PyObject_CallFunction(error_type, "s", text.c_str()));
  if (!error) return;  // Python's own error is set
  error.attr("code") = static_cast<int>(code);
  if (cause) PyException_SetCause(error.ptr(), py::reinterpret_borrow<py::object>(cause).release().ptr());
  PyErr_SetObject(error_type, error.ptr());
}

// A view without a copy, read-only. It owns `owner`.
template <class Owner>
py::array view_of(const double* data, std::vector<py::ssize_t> shape, Owner owner) {
  const py::capsule base(new Owner(std::move(owner)), [](void* held) { delete static_cast<Owner*>(held); });
  Array result(std::move(shape), data, base);
  py::detail::array_proxy(result.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return result;
}

inline py::array copy_of(const muster_in& view, bool one_row) {
  if (one_row) return Array(static_cast<py::ssize_t>(view.cols), view.data);
  return Array({static_cast<py::ssize_t>(view.rows), static_cast<py::ssize_t>(view.cols)}, view.data);
}

inline std::string shape_text(const py::array& array) {
  std::string text;
  for (py::ssize_t d = 0; d < array.ndim(); ++d) text += (d ? " x " : "") + std::to_string(array.shape(d));
  return array.ndim() ? text : "a single number";
}

inline Array numbers(const py::object& value, const std::string& what) {
  Array result = Array::ensure(value);
  if (result) return result;
  PyErr_Clear();
  throw Error(Exit::invalid_input, what + ": expected numbers, got " + std::string(py::str(py::type::of(value))));
}

}  // namespace muster::python
