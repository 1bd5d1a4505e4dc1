#include "kick/decision_csv.hpp"

#include <fmt/format.h>

namespace striker::sil {

DecisionCsv::DecisionCsv(const std::filesystem::path& file) : file_(file) {
  file_.write(
      "episode,decision,before_contact,action,ball_x_um,ball_y_um,robot_speed_mm_s,ball_vx_mm_s,ball_vy_mm_s,"
      "ball_angle\n");
}

void DecisionCsv::observe(const core::Controller& controller, std::uint64_t episode, bool before_contact) {
  const core::DecisionRecord& decision = controller.last_decision();
  if (decision.number == last_number_) {
    return;
  }
  last_number_ = decision.number;
  if (decision.number == 0) {
    return;
  }
  const core::RelativeState& state = decision.state;
  file_.write(fmt::format("{},{},{:d},{},{},{},{},{},{},{}\n", episode, decision.number - 1, before_contact,
                          decision.action, state.ball_um.x, state.ball_um.y, state.robot_speed_mm_s,
                          state.ball_velocity_mm_s.x, state.ball_velocity_mm_s.y, state.ball_angle));
}

void DecisionCsv::finish() {
  file_.finish();
}

}  // namespace striker::sil
