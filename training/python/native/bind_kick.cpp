// SPDX-License-Identifier: Apache-2.0
// The kick in Python: one world, and many.
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <algorithm>
#include <array>
#include <initializer_list>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "training/python/native/arrays.hpp"
#include "training/python/native/kick_worlds.hpp"
#include "training/python/native/misuse.hpp"
#include "training/python/native/module.hpp"
#include "training/python/native/tasks.hpp"

namespace striker::training {

namespace {

const sil::KickOutcome nothing_happened;

Array<float> copy_of(const Features& features) {
  Array<float> copy(features.size());
  std::copy(features.data(), features.data() + features.size(), copy.mutable_data());
  return copy;
}

// One world.
class Kick {
 public:
  explicit Kick(const Tasks& tasks)
      : player_(tasks.environments), actions_(static_cast<int>(tasks.environments.front().actions.size())) {}

  Array<float> reset(std::uint64_t seed, std::uint64_t episode) {
    player_.reset(seed, episode);
    return copy_of(player_.now().features());
  }

  // Gymnasium's five.
  py::tuple step(py::handle action) {
    const int chosen = action_of(action, actions_);  // which may run Python's code, and that step this world
    if (!player_.is_playing()) {
      throw std::runtime_error("the episode has ended, or none has begun: call reset()");
    }
    const StepResult result = player_.step(chosen);
    return py::make_tuple(copy_of(player_.now().features()), result.reward, result.end && !result.truncated,
                          result.truncated, result.end ? outcome() : py::dict());
  }

  [[nodiscard]] Record record() const { return player_.record(); }

  // Episode's seed, number and actions: what restore() takes.
  [[nodiscard]] py::tuple state() const {
    return py::make_tuple(player_.seed(), player_.episode(), player_.actions());
  }

  void restore(std::uint64_t seed, std::uint64_t episode, const std::vector<std::uint8_t>& actions) {
    require_played(actions, actions_, sil::kick_decisions);
    player_.reset(seed, episode);
    for (const std::uint8_t action : actions) {
      player_.step(action);
    }
  }

  // Where robot and ball are, as the learner sees them: x, y, heading; x, y; in the field's axes.
  [[nodiscard]] std::array<double, 5> places() const {
    const Observation& seen = player_.now().seen();
    return {seen.robot.x_m, seen.robot.y_m, seen.robot.heading_rad, seen.ball.position_m.x,
            seen.ball.position_m.y};
  }

 private:
  [[nodiscard]] py::dict outcome() const {
    const sil::KickOutcome& outcome = player_.now().outcome();
    py::dict said;
    said["episode_reward"] = outcome.reward;
    said["contact"] = outcome.contact;
    if (outcome.contact) {
      said["contact_decision"] = outcome.contact_decision;
      said["theta_contact_rad"] = outcome.theta_contact_rad;
      said["v_contact_m_s"] = outcome.v_contact_m_s;
      said["front_face"] = outcome.front_face;
    }
    return said;
  }

  KickPlayer player_;
  int actions_;
};

// KickWorlds with NumPy's arrays in and out.
class Worlds {
 public:
  Worlds(const Tasks& tasks, int worlds, int threads, bool same_step)
      : worlds_(tasks.environments, std::max(worlds, 1), std::max(threads, 1),
                same_step ? Autoreset::same_step : Autoreset::next_step),
        actions_(static_cast<std::size_t>(worlds_.size())),
        same_step_(same_step) {}

  void reset(const std::vector<std::uint64_t>& seeds, std::uint64_t first, Array<float>& observations) {
    const OneAtATime alone(busy_);
    float* const to = elements(observations, py::ssize_t{worlds_.size()} * worlds_.inputs(), "observations");
    if (seeds.size() != static_cast<std::size_t>(worlds_.size())) {
      throw std::invalid_argument("seed: there are " + std::to_string(seeds.size()) +
                                  ", not one for each of " + std::to_string(worlds_.size()) + " worlds");
    }
    worlds_.reset(seeds, first, to);
  }

  void reset_one_seed(std::uint64_t seed, std::uint64_t first, Array<float>& observations) {
    const OneAtATime alone(busy_);
    worlds_.reset(seed, first,
                  elements(observations, py::ssize_t{worlds_.size()} * worlds_.inputs(), "observations"));
  }

  void go_on(Array<float>& observations) {
    const OneAtATime alone(busy_);
    worlds_.go_on(elements(observations, py::ssize_t{worlds_.size()} * worlds_.inputs(), "observations"));
  }

  int step(const Array<std::int64_t>& actions, Array<float>& observations, Array<double>& rewards,
           Array<bool>& terminated, Array<bool>& truncated, std::optional<Array<double>>& records,
           std::optional<Array<float>>& finals) {
    const OneAtATime alone(busy_);
    const py::ssize_t worlds = worlds_.size();
    const std::int64_t* const chosen = elements(actions, worlds, "actions");
    // Copied, as the array is the caller's, who may change it meanwhile.
    for (py::ssize_t world = 0; world < worlds; ++world) {
      const std::int64_t action = chosen[world];
      if (action < 0 || action >= worlds_.actions()) {
        static_cast<void>(action_of(py::int_(action), worlds_.actions()));  // says what is wrong
      }
      actions_[static_cast<std::size_t>(world)] = static_cast<int>(action);
    }
    StepArrays out;
    out.observations = elements(observations, worlds * worlds_.inputs(), "observations");
    out.rewards = elements(rewards, worlds, "rewards");
    out.terminated = elements(terminated, worlds, "terminated");
    out.truncated = elements(truncated, worlds, "truncated");
    if (records) {
      out.records = elements(*records, worlds * static_cast<py::ssize_t>(record_fields.size()), "records");
    }
    if (finals) {
      out.final_observations = elements(*finals, worlds * worlds_.inputs(), "final observations");
    }
    if (same_step_ && out.final_observations == nullptr) {
      throw py::value_error("same_step: final observations need an array");
    }
    const py::gil_scoped_release others_may_run;
    return worlds_.step(actions_, out);
  }

  // Gymnasium's infos of the worlds whose episode these flags end: arrays, 0 for the others, and their masks.
  [[nodiscard]] py::dict infos(const Array<bool>& terminated, const Array<bool>& truncated) {
    const OneAtATime alone(busy_);
    const py::ssize_t worlds = worlds_.size();
    const bool* const by_contact = elements(terminated, worlds, "terminated");
    const bool* const by_time = elements(truncated, worlds, "truncated");
    std::array<Array<bool>, 4> flags{Array<bool>(worlds), Array<bool>(worlds), Array<bool>(worlds),
                                     Array<bool>(worlds)};
    std::array<Array<double>, 3> numbers{Array<double>(worlds), Array<double>(worlds), Array<double>(worlds)};
    Array<std::int64_t> decisions(worlds);
    auto& [ended, met, contact, front_face] = flags;
    auto& [reward, theta_contact_rad, v_contact_m_s] = numbers;
    for (py::ssize_t world = 0; world < worlds; ++world) {
      const bool ends = by_contact[world] || by_time[world];
      const sil::KickOutcome& outcome = ends ? worlds_.outcome(static_cast<int>(world)) : nothing_happened;
      ended.mutable_data()[world] = ends;
      met.mutable_data()[world] = outcome.contact;
      contact.mutable_data()[world] = outcome.contact;
      front_face.mutable_data()[world] = outcome.front_face;
      reward.mutable_data()[world] = outcome.reward;
      theta_contact_rad.mutable_data()[world] = outcome.theta_contact_rad;
      v_contact_m_s.mutable_data()[world] = outcome.v_contact_m_s;
      decisions.mutable_data()[world] = outcome.contact ? outcome.contact_decision : 0;
    }
    py::dict said;
    for (const auto& [name, values, mask] :
         std::initializer_list<std::tuple<const char*, py::array, py::array>>{
             {"episode_reward", reward, ended},
             {"contact", contact, ended},
             {"contact_decision", decisions, met},
             {"theta_contact_rad", theta_contact_rad, met},
             {"v_contact_m_s", v_contact_m_s, met},
             {"front_face", front_face, met}}) {
      said[name] = values;
      said[py::str("_{}").format(name)] = mask;
    }
    return said;
  }

  [[nodiscard]] py::tuple state() {
    const OneAtATime alone(busy_);
    py::list players;
    for (int world = 0; world < worlds_.size(); ++world) {
      const KickPlayer& player = worlds_.player(world);
      players.append(py::make_tuple(player.seed(), player.episode(), player.actions()));
    }
    return py::make_tuple(worlds_.stride(), players);
  }

  void restore(
      std::uint64_t stride,
      const std::vector<std::tuple<std::uint64_t, std::uint64_t, std::vector<std::uint8_t>>>& players) {
    const OneAtATime alone(busy_);
    if (players.size() != static_cast<std::size_t>(worlds_.size())) {
      throw py::value_error("the copy is one of so many worlds: " + std::to_string(players.size()));
    }
    worlds_.set_stride(stride);
    for (std::size_t world = 0; world < players.size(); ++world) {
      const auto& [seed, episode, actions] = players[world];
      require_played(actions, worlds_.actions(), sil::kick_decisions);
      worlds_.restore(static_cast<int>(world), seed, episode, actions);
    }
  }

 private:
  KickWorlds worlds_;
  std::vector<int> actions_;
  bool same_step_;
  bool busy_ = false;
};

std::vector<std::pair<double, double>> set_points(const Tasks& tasks) {
  std::vector<std::pair<double, double>> pairs;
  for (const SetPoint& action : tasks.environments.front().actions) {
    pairs.emplace_back(action.left_m_s, action.right_m_s);
  }
  return pairs;
}

}  // namespace

void add_kick(py::module_& module) {
  module.attr("RECORD_FIELDS") = py::tuple(py::cast(record_fields));
  py::class_<Tasks>(module, "Tasks")
      .def(py::init(&tasks_of), py::arg("config"), py::arg("text"), py::arg("robot"), py::arg("changes"))
      .def_readonly("text", &Tasks::text)
      .def_property_readonly("inputs",
                             [](const Tasks& tasks) { return tasks.environments.front().inputs.size(); })
      .def_property_readonly("set_points", &set_points);
  py::class_<Kick>(module, "Kick")
      .def(py::init<const Tasks&>())
      .def("reset", &Kick::reset)
      .def("step", &Kick::step)
      .def("record", &Kick::record)
      .def("state", &Kick::state)
      .def("restore", &Kick::restore)
      .def("places", &Kick::places);
  py::class_<Worlds>(module, "KickWorlds")
      .def(py::init<const Tasks&, int, int, bool>(), py::arg("tasks"), py::arg("worlds"), py::arg("threads"),
           py::arg("same_step"))
      // No array is converted: it would be a copy, and the caller's would stay as it is.
      .def("reset", &Worlds::reset, py::arg("seeds"), py::arg("first"), py::arg("observations").noconvert())
      .def("reset_one_seed", &Worlds::reset_one_seed, py::arg("seed"), py::arg("first"),
           py::arg("observations").noconvert())
      .def("go_on", &Worlds::go_on, py::arg("observations").noconvert())
      .def("step", &Worlds::step, py::arg("actions").noconvert(), py::arg("observations").noconvert(),
           py::arg("rewards").noconvert(), py::arg("terminated").noconvert(),
           py::arg("truncated").noconvert(), py::arg("records").noconvert(),
           py::arg("final_observations").noconvert())
      .def("infos", &Worlds::infos, py::arg("terminated").noconvert(), py::arg("truncated").noconvert())
      .def("state", &Worlds::state)
      .def("restore", &Worlds::restore);
}

}  // namespace striker::training
