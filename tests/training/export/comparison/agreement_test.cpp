// SPDX-License-Identifier: Apache-2.0
// Agreement and regret against the float network, and the file of decisions.
#include "training/export/comparison/agreement.hpp"

#include "tests/training/fixtures.hpp"

namespace striker::training {
namespace {

const StateInputs inputs = rcs_inputs();
const std::string header =
    "episode,decision,before_contact,action,ball_x_um,ball_y_um,robot_speed_mm_s,ball_vx_mm_s,ball_vy_mm_s,"
    "ball_angle\n";

TEST(Agreement, TheNetworksOwnChoicesAgree) {
  const Parameters parameters = some_parameters(1);
  Actor actor(parameters.shape());
  std::mt19937 random(1);
  std::vector<TakenDecision> decisions;
  for (int i = 0; i < 1000; ++i) {
    const RawState state = some_state(random);
    decisions.push_back({state, actor.choose(parameters, features_of(inputs, state))});
  }
  const Agreement result = agreement(parameters, inputs, decisions);
  EXPECT_EQ(result.states, 1000U);
  EXPECT_EQ(result.agreement, 1.0);
  EXPECT_EQ(result.clear_agreement, 1.0);
  EXPECT_EQ(result.mean_regret, 0.0);
}

// A network whose values are its last biases, whatever the state.
TEST(Agreement, CountsGapAndRegret) {
  Parameters parameters({});
  parameters.biases(2) << 1.0F, 0.99F, 0.5F;
  const auto of = [&](const std::vector<int>& taken) {
    std::vector<TakenDecision> decisions;
    decisions.reserve(taken.size());
    for (const int action : taken) {
      decisions.push_back({RawState(inputs.size()), action});
    }
    return agreement(parameters, inputs, decisions);
  };
  EXPECT_NEAR(of({0, 1, 2, 0}).agreement.value(), 0.5, 1e-12);
  EXPECT_NEAR(of({0, 1, 2, 0}).mean_regret.value(), (0.01 + 0.5) / 4, 1e-6);
  EXPECT_EQ(of({0, 1}).clear_states, 0U);
  EXPECT_FALSE(of({0, 1}).clear_agreement.has_value());
  EXPECT_FALSE(of({}).agreement.has_value());
  EXPECT_FALSE(of({}).mean_regret.has_value());
  EXPECT_EQ(share_text(of({}).agreement, 4), "none");
  EXPECT_EQ(share_text(of({0, 1}).agreement, 4), "0.5000");
  parameters.biases(2)(1) = 0.97F;
  EXPECT_EQ(of({0, 1, 2, 2}).clear_states, 4U);
  EXPECT_NEAR(of({0, 1, 2, 2}).clear_agreement.value(), 0.25, 1e-12);
}

TEST(Agreement, OnlyDecisionsBeforeContactCount) {
  const TemporaryDirectory directory;
  write_to(directory / "d.csv",
           header + "0,0,1,2,2000000,-5,0,-1000,0,-32768\n0,1,0,0,0,0,0,0,0,0\n1,0,1,0,1,2,3,4,5,6\n");
  const auto decisions = load_decisions(directory / "d.csv", inputs, 3);
  ASSERT_EQ(decisions.size(), 2U);
  EXPECT_EQ(decisions[0].action, 2);
  EXPECT_EQ(decisions[0].state, (RawState{2000000, -5, 0, -1000, 0, -32768}));
  EXPECT_EQ(decisions[1].state, (RawState{1, 2, 3, 4, 5, 6}));
}

// As an editor or a spreadsheet on Windows saves it.
TEST(Agreement, LinesMayEndAsOnWindows) {
  const TemporaryDirectory directory;
  write_to(directory / "d.csv", replaced(header, "\n", "\r\n") + "0,0,1,2,3,4,5,6,7,8\r\n");
  const auto decisions = load_decisions(directory / "d.csv", inputs, 3);
  ASSERT_EQ(decisions.size(), 1U);
  EXPECT_EQ(decisions[0].state, (RawState{3, 4, 5, 6, 7, 8}));
}

TEST(Agreement, TheHeaderNamesThePastAndRefusesWhatNoControllerHas) {
  EXPECT_EQ(decisions_header(inputs) + "\n", header);
  EXPECT_EQ(decisions_header({{.element = Element::decisions_left},
                              {.element = Element::robot_speed, .decisions_ago = 1}}),
            "episode,decision,before_contact,action,decisions_left,robot_speed_mm_s@1");
  EXPECT_THROW((void)decisions_header({{.element = Element::dummy}}), std::runtime_error);
}

TEST(Agreement, AWrongDecisionsFileIsRefusedByLine) {
  const TemporaryDirectory directory;
  const auto complaint = [&](const std::string& content) {
    write_to(directory / "d.csv", content);
    try {
      (void)load_decisions(directory / "d.csv", inputs, 3);
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string("was read");
  };
  const std::string good = "0,0,1,2,3,4,5,6,7,8\n";
  EXPECT_EQ(complaint(header + good), "was read");
  EXPECT_NE(complaint("").find("line 1"), std::string::npos);
  EXPECT_NE(complaint("a,b\n" + good).find("line 1"), std::string::npos);
  EXPECT_NE(complaint("episode,decision,before_contact,action,ball_x_um\n0,0,1,0,5\n")
                .find("column 6 is missing, not \"ball_y_um\""),
            std::string::npos);
  EXPECT_NE(complaint(replaced(header, "ball_angle", "ball_angle,extra") + good).find("\"extra\", not none"),
            std::string::npos);
  const std::string swapped =
      replaced(header, "robot_speed_mm_s,ball_vx_mm_s", "ball_vx_mm_s,robot_speed_mm_s");
  EXPECT_NE(complaint(swapped + good).find("column 7 is \"ball_vx_mm_s\", not \"robot_speed_mm_s\""),
            std::string::npos);
  EXPECT_NE(complaint(header).find("no decision before contact"), std::string::npos);
  EXPECT_NE(complaint(header + "0,0,0,2,3,4,5,6,7,8\n").find("no decision before contact"),
            std::string::npos);
  EXPECT_NE(complaint(header + good + "0,0,1,2,3,4,5,6,7,8").find("line 3: it has no end"),
            std::string::npos);
  for (const char* bad : {"0,0,1,2,3,4,5", "0,0,1,2,3,4,5,6,7,8,9", "0,0,1,2,3,x,5,6,7,8",
                          "0,0,2,2,3,4,5,6,7,8", "0,0,1,3,3,4,5,6,7,8", "0,0,1,-1,3,4,5,6,7,8",
                          "0,0,1,2,3,4,5,6,7,99999999999", "0,0,1,2,3,4,5,6,7,8\r,", ""}) {
    const std::string message = complaint(header + good + bad + "\n");
    EXPECT_NE(message.find("line 3"), std::string::npos) << bad << ": " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

}  // namespace
}  // namespace striker::training
