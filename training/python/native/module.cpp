// SPDX-License-Identifier: Apache-2.0
#include "training/python/native/module.hpp"

#include <exception>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "training/task/episode_numbers.hpp"

namespace {

// A message may hold a path, and a path any bytes: Python's own way from C's text would leave the exception without one.
void raise(PyObject* type, std::string_view text) {
  PyObject* const message =
      PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "backslashreplace");
  if (message != nullptr) {
    PyErr_SetObject(type, message);
    Py_DECREF(message);
  }
}

void translate(std::exception_ptr thrown) {
  try {
    std::rethrow_exception(std::move(thrown));
  } catch (const pybind11::builtin_exception&) {
    throw;
  } catch (const pybind11::error_already_set&) {
    throw;
  } catch (const std::invalid_argument& error) {
    raise(PyExc_ValueError, error.what());
  } catch (const std::runtime_error& error) {
    raise(PyExc_RuntimeError, error.what());
  }
}

}  // namespace

PYBIND11_MODULE(_native, module) {
  using namespace striker::training;
  pybind11::register_exception_translator(&translate);
  module.attr("FIRST_TRAINING_EPISODE") = first_training_episode;
  module.attr("FIRST_VALIDATION_EPISODE") = first_validation_episode;
  add_network(module);
  add_kick(module);
  add_match(module);
}
