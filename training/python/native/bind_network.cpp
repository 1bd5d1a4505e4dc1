// SPDX-License-Identifier: Apache-2.0
// The trainer's own network in Python, with its bits.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <filesystem>

#include "training/model/model.hpp"
#include "training/python/native/arrays.hpp"
#include "training/python/native/module.hpp"

namespace striker::training {

namespace {

// A float network as striker-evaluate plays it.
class Network {
 public:
  Network(const std::filesystem::path& file, const std::string& network)
      : model_(load_model(file, network)), actor_(model_.parameters.shape()) {}

  [[nodiscard]] int inputs() const { return model_.parameters.shape().inputs; }
  [[nodiscard]] int actions() const { return model_.parameters.shape().actions; }
  [[nodiscard]] std::string identity() const { return model_identity(model_.parameters); }
  [[nodiscard]] const std::map<std::string, std::string>& metadata() const { return model_.metadata; }

  [[nodiscard]] int choose(const Array<float>& observation) {
    return actor_.choose(model_.parameters, row(elements(observation, inputs(), "the observation")));
  }

  [[nodiscard]] Array<float> values(const Array<float>& observation) {
    const auto q = actor_.values(model_.parameters, row(elements(observation, inputs(), "the observation")));
    Array<float> result(actions());
    std::copy(q.data(), q.data() + q.size(), result.mutable_data());
    return result;
  }

  // One at a time, as the trainer does: a sum over a batch may round otherwise.
  [[nodiscard]] Array<std::int64_t> choose_all(const Array<float>& observations) {
    const py::ssize_t rows = observations.ndim() == 2 ? observations.shape(0) : 0;
    const float* const from = elements(observations, rows * inputs(), "the observations");
    Array<std::int64_t> chosen(rows);
    std::int64_t* const to = chosen.mutable_data();
    for (py::ssize_t i = 0; i < rows; ++i) {
      to[i] = actor_.choose(model_.parameters, row(from + i * inputs()));
    }
    return chosen;
  }

 private:
  [[nodiscard]] Features row(const float* from) const { return Eigen::Map<const Features>(from, inputs()); }

  Model model_;
  Actor actor_;
};

}  // namespace

void add_network(py::module_& module) {
  py::class_<Network>(module, "Network")
      .def(py::init<const std::filesystem::path&, const std::string&>(), py::arg("path"), py::arg("network"))
      .def_property_readonly("inputs", &Network::inputs)
      .def_property_readonly("actions", &Network::actions)
      .def_property_readonly("identity", &Network::identity)
      .def_property_readonly("metadata", &Network::metadata)
      .def("choose", &Network::choose)
      .def("choose_all", &Network::choose_all)
      .def("values", &Network::values);
}

}  // namespace striker::training
