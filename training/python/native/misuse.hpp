// SPDX-License-Identifier: Apache-2.0
// What the package striker is protected from: it is loaded into a process that is not its own, where a caller's mistake
// is an exception, and never the end.
#pragma once

#include <pybind11/pybind11.h>

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace striker::training {

namespace py = pybind11;

// `action` as one of `actions`: anything that Python takes as an index. TypeError or ValueError otherwise.
inline int action_of(py::handle action, int actions) {
  const auto about = [&] {
    return "action " + std::string(py::repr(action)).substr(0, 80) + ": it must be a whole number, 0 to " +
           std::to_string(actions - 1);
  };
  const auto index = py::reinterpret_steal<py::object>(PyNumber_Index(action.ptr()));
  if (!index) {
    PyErr_Clear();
    throw py::type_error(about());
  }
  int overflow = 0;
  const long long value = PyLong_AsLongLongAndOverflow(index.ptr(), &overflow);
  if (overflow != 0 || value < 0 || value >= actions) {
    throw py::value_error(about());
  }
  return static_cast<int>(value);
}

// That a copy's actions can have been played: what Python pickled may have been altered.
inline void require_played(const std::vector<std::uint8_t>& played, int actions, int decisions) {
  bool is_sound = played.size() <= static_cast<std::size_t>(decisions);
  for (const std::uint8_t action : played) {
    is_sound = is_sound && action < actions;
  }
  if (!is_sound) {
    throw py::value_error("the copy's actions are none of an episode");
  }
}

// Whoever is in a call that frees Python's lock: a second thread in the same object is refused. Made and ended with the
// lock held.
class OneAtATime {
 public:
  explicit OneAtATime(bool& busy) : busy_(busy) {
    if (busy) {
      throw std::runtime_error("another thread is in this environment: make one for each");
    }
    busy_ = true;
  }
  OneAtATime(const OneAtATime&) = delete;
  OneAtATime& operator=(const OneAtATime&) = delete;
  ~OneAtATime() { busy_ = false; }

 private:
  bool& busy_;
};

}  // namespace striker::training
