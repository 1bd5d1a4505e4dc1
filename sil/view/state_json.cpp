// SPDX-License-Identifier: Apache-2.0
#include "sil/view/state_json.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "firmware/can/codec.hpp"
#include "firmware/policy/network.hpp"
#include "sil/bus/frame_bits.hpp"
#include "sil/fault/link/frame_fault.hpp"

namespace striker::sil {

namespace {

using Json = nlohmann::ordered_json;

std::int64_t mm(double metres) {
  return std::llround(metres * 1e3);
}

Json place(Vec2 metres) {
  return {mm(metres.x), mm(metres.y)};
}

Json place(const Pose& pose) {
  const double degrees = pose.heading_rad * 180.0 / std::numbers::pi;
  return {mm(pose.x_m), mm(pose.y_m), std::round(degrees * 10.0) / 10.0};
}

template <class Message>
constexpr std::size_t kind_of() {
  std::size_t kind = 0;
  std::size_t next = 0;
  can::for_each_layout([&](const auto& message) {
    kind = message.info.id == can::layout<Message>.info.id ? next : kind;
    ++next;
  });
  return kind;
}

template <class Message>
bool read(const can::Frame& frame, Message& into) {
  if constexpr (can::layout<Message>.info.data_ids == can::unprotected) {
    return can::is<Message>(frame) && can::unpack(frame, into) == can::Verdict::accepted;
  } else {
    return can::receive(frame, into) == can::Verdict::accepted;
  }
}

// The last one on the bus, if it came and its bytes are right.
template <class Message>
std::optional<Message> last_of(const LiveRobot& robot) {
  const SeenMessage& seen = robot.messages[kind_of<Message>()];
  Message message;
  const bool is_right = seen.count > 0 && read(seen.last, message);
  return is_right ? std::optional(message) : std::nullopt;
}

Json measured(std::int32_t value) {
  return value == can::not_available ? Json(nullptr) : Json(value);
}

Json decision_of(const LiveRobot& robot) {
  const auto decision = last_of<can::Decision>(robot);
  return decision ? Json{{"number", decision->number},
                         {"action", decision->action},
                         {"extrapolated", decision->extrapolated == 1},
                         {"best_q", decision->best_q_256th / 256.0},
                         {"next_q", decision->next_q_256th / 256.0}}
                  : Json(nullptr);
}

// Of all actions, as the built-in network gives them for what it read last.
Json q_values_of(const LiveRobot& robot) {
  if (!robot.inputs) {
    return nullptr;
  }
  Json values = Json::array();
  for (const std::int32_t sum : policy::infer<policy::built_in>(*robot.inputs).sums) {
    values.push_back((sum >> policy::built_in.output.shift) / 256.0);
  }
  return values;
}

Json fault_names(std::uint32_t faults) {
  Json names = Json::array();
  for (std::size_t code = 1; code < core::fault_names.size(); ++code) {
    if ((faults & (1U << code)) != 0) {
      names.push_back(core::fault_names[code]);
    }
  }
  return names;
}

void add_condition(const LiveRobot& robot, Json& into) {
  if (const auto status = last_of<can::Status>(robot)) {
    into["state"] = core::name_of(static_cast<core::State>(status->state));
    into["fault"] = core::name_of(static_cast<core::Fault>(status->fault));
    into["ignored"] = {status->wrong_length, status->wrong_crc, status->wrong_counter, status->out_of_range};
  }
  if (const auto safety = last_of<can::Safety>(robot)) {
    into["faults"] = fault_names(static_cast<std::uint32_t>(safety->faults));
    into["limits"] = safety->limits;
    into["blocked"] = safety->blocked;
    into["lost"] = safety->lost_frames;
  }
  if (const auto timing = last_of<can::Timing>(robot)) {
    into["timing_us"] = {{"lateness", measured(timing->lateness_max_us)},
                         {"execution", measured(timing->execution_max_us)},
                         {"latency", measured(timing->latency_max_us)},
                         {"overruns", measured(timing->overruns)}};
  }
}

// [tick, set-points left and right, measured left and right, torques left and right], oldest first.
Json wheels_of(const LiveRobot& robot) {
  Json samples = Json::array();
  const std::uint32_t kept = std::min<std::uint32_t>(robot.wheel_samples, kept_wheel_samples);
  for (std::uint32_t i = robot.wheel_samples - kept; i < robot.wheel_samples; ++i) {
    const WheelSample& sample = robot.wheels[i % kept_wheel_samples];
    can::WheelCommand command;
    can::WheelState state;
    if (read(sample.command, command) && read(sample.state, state)) {
      samples.push_back({sample.tick, 2 * command.left_set_point_2mm_s, 2 * command.right_set_point_2mm_s,
                         state.left_mm_s, state.right_mm_s, command.left_torque_mNm,
                         command.right_torque_mNm});
    }
  }
  return samples;
}

Json robot_json(const LiveRobot& robot) {
  Json counts = Json::array();
  for (const SeenMessage& message : robot.messages) {
    counts.push_back(message.count);
  }
  Json json = {
      {"pose", place(robot.pose)}, {"speed", mm(std::hypot(robot.velocity_m_s.x, robot.velocity_m_s.y))},
      {"counts", counts},          {"decision", decision_of(robot)},
      {"q", q_values_of(robot)},   {"wheels", wheels_of(robot)}};
  add_condition(robot, json);
  if (const auto order = last_of<can::MotionOrder>(robot)) {
    json["order"] = {order->x_quarter_mm / 4, order->y_quarter_mm / 4};
  }
  return json;
}

Json match_json(const LiveMatch& match) {
  const auto numbers = [](const RobotSet& set) {
    Json robots = Json::array();
    for (std::size_t robot = 0; robot < robots_in_match; ++robot) {
      if (set[robot]) {
        robots.push_back(robot);
      }
    }
    return robots;
  };
  return {{"score", match.score},
          {"half", match.half},
          {"clock", match.clock_ms},
          {"state", name_of(match.state)},
          {"owner", match.owner ? Json(*match.owner == Team::red ? "red" : "blue") : Json(nullptr)},
          {"touching", numbers(match.touching)},
          {"sent_out", numbers(match.sent_out)}};
}

Json messages_json() {
  Json messages = Json::array();
  can::for_each_layout([&](const auto& message) {
    can::Frame frame;
    frame.id = message.info.id;
    messages.push_back({{"name", message.info.name},
                        {"id", message.info.id},
                        {"bits", worst_case_frame_bits(message.info.length)},
                        {"lockstep", is_lockstep(frame)}});
  });
  messages.push_back(
      {{"name", "others"}, {"id", nullptr}, {"bits", worst_case_frame_bits(8)}, {"lockstep", false}});
  return messages;
}

Json actions_json() {
  Json actions = Json::array();
  for (const policy::WheelSetPoint& action : loop::BuiltInPilot::set_points) {
    actions.push_back({action.left_mm_s, action.right_mm_s});
  }
  return actions;
}

// JSON whatever the bytes of a text: those that are no UTF-8 are replaced.
std::string text_of(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

}  // namespace

std::string hello_text(const ViewFacts& facts) {
  constexpr int bit_rate = 1'000'000;
  const Json hello = {{"scenario", facts.scenario},  {"teams", facts.teams},
                      {"faults", facts.faults},      {"has_time", facts.has_time},
                      {"messages", messages_json()}, {"actions", actions_json()},
                      {"bit_rate", bit_rate}};
  return text_of(Json{{"hello", hello}});  // a team's name is a file's, of any bytes
}

// A seed is text: a page's numbers have 53 of its 64 bits.
std::string state_text(const LiveState& state) {
  Json robots = Json::array();
  for (std::size_t robot = 0; robot < state.robot_count; ++robot) {
    robots.push_back(robot_json(state.robots[robot]));
  }
  const Json json = {{"run", state.run},
                     {"seed", std::to_string(state.seed)},
                     {"tick", state.tick},
                     {"episode", state.episode},
                     {"deciding", state.deciding},
                     {"ball", place(state.ball.position_m)},
                     {"target", state.target ? place(*state.target) : Json(nullptr)},
                     {"contact", state.contact_m ? place(*state.contact_m) : Json(nullptr)},
                     {"match", state.match ? match_json(*state.match) : Json(nullptr)},
                     {"paused", state.paused},
                     {"speed", state.speed},
                     {"lateness_us", state.lateness_max_us},
                     {"note", {state.note.number, state.note.text.data()}},
                     {"robots", robots}};
  return Json{{"state", json}}.dump();
}

std::string ended_text(const std::string& why) {
  return text_of(Json{{"ended", why}});
}

}  // namespace striker::sil
