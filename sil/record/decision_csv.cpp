#include "sil/record/decision_csv.hpp"

#include <fmt/format.h>

#include <array>
#include <span>
#include <string>

namespace striker::sil {

namespace {

// In the order of policy::StateElement.
constexpr std::array element_names = {"ball_x_um",    "ball_y_um",  "robot_speed_mm_s", "ball_vx_mm_s",
                                      "ball_vy_mm_s", "ball_angle", "decisions_left"};
static_assert(element_names.size() == static_cast<std::size_t>(policy::StateElement::decisions_left) + 1);

}  // namespace

DecisionCsv::DecisionCsv(const std::filesystem::path& file, const core::Controller& controller)
    : file_(file), controller_(&controller) {
  std::string header = "episode,decision,before_contact,action";
  for (const auto& [element, ago] : core::policy_inputs()) {
    header += fmt::format(",{}", element_names.at(static_cast<std::size_t>(element)));
    header += ago > 0 ? fmt::format("@{}", ago) : "";
  }
  file_.write(header + "\n");
}

void DecisionCsv::end_tick(const Snapshot& snapshot) {
  const core::DecisionRecord& decision = controller_->last_decision();
  if (!snapshot.deciding || decision.number == last_number_) {
    return;
  }
  last_number_ = decision.number;
  if (decision.number == 0) {
    return;
  }
  const auto inputs = std::span(decision.inputs).first(core::policy_inputs().size());
  file_.write(fmt::format("{},{},{:d},{},{}\n", snapshot.episode, decision.number - 1, !snapshot.contact,
                          decision.action, fmt::join(inputs, ",")));
}

}  // namespace striker::sil
