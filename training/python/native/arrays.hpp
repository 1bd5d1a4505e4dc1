// SPDX-License-Identifier: Apache-2.0
// NumPy arrays as the native classes take and give them.
#pragma once

#include <pybind11/numpy.h>

#include <string>
#include <vector>

namespace striker::training {

namespace py = pybind11;

template <class Value>
using Array = py::array_t<Value, py::array::c_style>;

// The elements of an array that has exactly so many; a std::invalid_argument (ValueError) that names it otherwise.
template <class Value>
Value* elements(Array<Value>& array, py::ssize_t count, const std::string& name) {
  if (array.size() != count) {
    throw std::invalid_argument(name + " has " + std::to_string(array.size()) + " elements, not " +
                                std::to_string(count));
  }
  return array.mutable_data();
}

template <class Value>
const Value* elements(const Array<Value>& array, py::ssize_t count, const std::string& name) {
  return elements(const_cast<Array<Value>&>(array), count, name);
}

}  // namespace striker::training
