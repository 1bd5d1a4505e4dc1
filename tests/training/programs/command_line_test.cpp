// SPDX-License-Identifier: Apache-2.0
// The programs as a user meets them: help, results, and one line and code 2 for bad input.
#include "tests/training/programs/command_line.hpp"

#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>

namespace striker::training {
namespace {

TEST_F(CommandLine, HelpNamesEveryOption) {
  const auto help = [this](const char* program) { return run(fmt::format("{} --help", program)).out; };
  for (const char* option : {"--config", "--robot", "--set", "--seed", "--out", "--resume", "--force",
                             "--init", "--network", "status 3"}) {
    EXPECT_NE(help(STRIKER_TRAIN).find(option), std::string::npos) << option;
  }
  for (const char* option : {"--model", "--robot", "--episodes", "--seed", "--pose", "--velocities",
                             "--world", "--decisions", "--json"}) {
    EXPECT_NE(help(STRIKER_EVALUATE).find(option), std::string::npos) << option;
  }
  for (const char* option : {"--robot", "--episodes", "--seed", "--pose", "--replay", "--rivals", "--jobs",
                             "--position-cell", "--speed-cell", "--json", "--csv"}) {
    EXPECT_NE(help(STRIKER_CEILING).find(option), std::string::npos) << option;
  }
  for (const char* option : {"MODEL", "--output", "--network", "--weights", "--report"}) {
    EXPECT_NE(help(STRIKER_EXPORT).find(option), std::string::npos) << option;
  }
  EXPECT_EQ(run(fmt::format("{} --help", STRIKER_TRAIN)).code, 0);
}

TEST_F(CommandLine, TrainEvaluateExportTwiceGivesTheSameBytes) {
  const std::string config = quick_config();
  for (const char* out : {"a", "b"}) {
    const Result trained =
        run(fmt::format("{} --config {} --seed 3 --out {}", STRIKER_TRAIN, config, path(out)));
    ASSERT_EQ(trained.code, 0) << trained.err;
    const std::string model = path(out) + "/model.safetensors";
    ASSERT_EQ(run(fmt::format("{} {} --name kick -o {}.hpp --report {}.json", STRIKER_EXPORT, model,
                              path(out), path(out)))
                  .code,
              0);
  }
  EXPECT_EQ(content_of(path("a") + "/model.safetensors"), content_of(path("b") + "/model.safetensors"));
  EXPECT_EQ(content_of(path("a.hpp")), content_of(path("b.hpp")));
  EXPECT_EQ(content_of(path("a.json")), content_of(path("b.json")));
  const std::string curve = content_of(path("a") + "/learning_curve.csv");
  EXPECT_EQ(curve, content_of(path("b") + "/learning_curve.csv"));
  EXPECT_EQ(
      curve.find("episode,steps,reward,moving_average_250,contact,epsilon,learning_rate,loss,td_error,q\n"),
      0U);
  EXPECT_EQ(std::count(curve.begin(), curve.end(), '\n'), 31);
}

TEST_F(CommandLine, ExportWritesWeightsOfEightBits) {
  const std::string command =
      fmt::format("{} {} -o {} --report {}", STRIKER_EXPORT, a_model(), path("p.hpp"), path("p.json"));
  const Result exported = run(command + " --weights int8");
  EXPECT_EQ(exported.code, 0) << exported.err;
  EXPECT_NE(exported.out.find("int8 weights"), std::string::npos) << exported.out;
  EXPECT_NE(content_of(path("p.hpp")).find("std::int8_t> p ="), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(content_of(path("p.json"))).at("weights"), "int8");
  expect_refusal(command + " --weights int4", "--weights");
}

TEST_F(CommandLine, EvaluateWritesTheCommonReport) {
  const std::string model = a_model();
  const std::string command = fmt::format("{} --model {} --episodes 20 --seed 4", STRIKER_EVALUATE, model);
  ASSERT_EQ(run(command + " --pose anywhere --velocities estimated --json " + path("r.json")).code, 0);
  const auto report = nlohmann::json::parse(content_of(path("r.json")));
  EXPECT_EQ(report.at("episodes"), 20);
  EXPECT_EQ(report.at("seed"), 4);
  EXPECT_EQ(report.at("pose"), "anywhere");
  EXPECT_EQ(report.at("plant"), "servo");
  EXPECT_EQ(report.at("policy"), model_identity(some_parameters(1)));
}

TEST_F(CommandLine, EvaluateComparesDecisions) {
  const std::string model = a_model();
  write_to(path("d.csv"),
           "episode,decision,before_contact,action,ball_x_um,ball_y_um,robot_speed_mm_s,ball_vx_mm_s,"
           "ball_vy_mm_s,ball_angle\n0,0,1,0,2000000,0,0,-1000,0,-32768\n0,1,0,1,0,0,0,0,0,0\n");
  const std::string command =
      fmt::format("{} --model {} --decisions {}", STRIKER_EVALUATE, model, path("d.csv"));
  ASSERT_EQ(run(command + " --json " + path("a.json")).code, 0);
  const auto report = nlohmann::json::parse(content_of(path("a.json")));
  EXPECT_EQ(report.at("states"), 1);
  EXPECT_TRUE(report.contains("clear_agreement"));
  EXPECT_TRUE(report.contains("mean_regret"));
}

TEST_F(CommandLine, AnInterruptedTrainingKeepsWhatItHas) {
  const std::string config = path("long.toml");
  write_to(config, replaced(paper_text(), "\nepisodes = 5000", "\nepisodes = 1000000"));
  // Interrupts it as soon as it shows progress.
  write_to(path("interrupt.sh"), fmt::format("{} --config {} --seed 1 --out {} &\n"
                                             "while ! grep -q episode {}; do sleep 0.05; done\n"
                                             "kill -INT $!\nwait $!\n",
                                             STRIKER_TRAIN, config, path("cut"), path("err.txt")));
  const Result result = run("sh " + path("interrupt.sh"));
  EXPECT_EQ(result.code, 130);
  EXPECT_NE(result.err.find("interrupted after"), std::string::npos) << result.err;
  EXPECT_NO_THROW((void)load_model(path("cut") + "/model.safetensors"));
  const std::string curve = content_of(path("cut") + "/learning_curve.csv");
  EXPECT_GT(std::count(curve.begin(), curve.end(), '\n'), 1);
}

TEST_F(CommandLine, ADivergedTrainingHasAnExitStatusOfItsOwn) {
  const Result result = run(fmt::format(
      "{} --config {} --seed 1 --out {} --set optimiser.learning_rate=0.3 --set learner.gradient_steps=5 "
      "--set learner.target_period=1 --set learner.gamma=1.0 --set run.episodes=200",
      STRIKER_TRAIN, quick_config(), path("out")));
  EXPECT_EQ(result.code, 3) << result.err;
  EXPECT_NE(result.err.find("striker-train: " + path("out") + ": the training diverged"), std::string::npos)
      << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_FALSE(std::filesystem::exists(path("out") + "/model.safetensors"));
}

TEST_F(CommandLine, AUsedDirectoryIsRefusedUnlessForced) {
  const std::string train =
      fmt::format("{} --config {} --seed 1 --out {}", STRIKER_TRAIN, quick_config(), path("out"));
  ASSERT_EQ(run(train).code, 0);
  const std::string model = content_of(path("out") + "/model.safetensors");
  expect_refusal(train, "--force");
  expect_refusal(train + " --resume", "complete");
  expect_refusal(train + " --resume --force", "--resume");
  EXPECT_EQ(content_of(path("out") + "/model.safetensors"), model);
  EXPECT_EQ(run(train + " --force").code, 0);
  EXPECT_EQ(content_of(path("out") + "/model.safetensors"), model);
}

TEST_F(CommandLine, ATrainingGoesOnAndBeginsFromAModel) {
  const std::string train =
      fmt::format("{} --config {} --seed 1 --out {}", STRIKER_TRAIN, quick_config(), path("out"));
  ASSERT_EQ(run(train).code, 0);
  const Result more = run(train + " --resume --set run.episodes=40 --set optimiser.learning_rate=1e-4");
  EXPECT_EQ(more.code, 0) << more.err;
  const std::string curve = content_of(path("out") + "/learning_curve.csv");
  EXPECT_EQ(std::count(curve.begin(), curve.end(), '\n'), 41);
  expect_refusal(train + " --resume --set run.episodes=50 --set learner.gamma=0.9", "learner.gamma was 0.95");

  const std::string model = path("out") + "/model.safetensors";
  const std::string begin = replaced(train, path("out"), path("begun")) + " --init " + model;
  expect_refusal(begin + " --set network.hidden=[8,8]", model);
  expect_refusal(begin + " --resume", "--init");
  expect_refusal(train + " --network model", "--init");
  EXPECT_FALSE(std::filesystem::exists(path("begun")));
  const Result begun = run(begin);
  EXPECT_EQ(begun.code, 0) << begun.err;
  EXPECT_NE(load_model(path("begun") + "/model.safetensors").metadata.at("history").find("begun from"),
            std::string::npos);
}

// On stderr, after a second, and not at all for less.
TEST_F(CommandLine, LongWorkShowsItsProgress) {
  const std::string evaluate = fmt::format("{} --model {} --seed 1", STRIKER_EVALUATE, a_model());
  EXPECT_EQ(run(evaluate + " --episodes 1").err, "");
  const Result long_one = run(evaluate + " --episodes 3000");
  EXPECT_NE(long_one.err.find("/3000  "), std::string::npos) << long_one.err;
  EXPECT_NE(long_one.err.find(" s left  mean reward "), std::string::npos) << long_one.err;
  EXPECT_EQ(long_one.out.find("/3000  "), std::string::npos);
  const Result exported = run(fmt::format("{} {} -o {}", STRIKER_EXPORT, a_model(), path("p.hpp")));
  EXPECT_NE(exported.err.find("/800  "), std::string::npos) << exported.err;
}

TEST_F(CommandLine, TrainRefusesBadInput) {
  const std::string config = quick_config();
  const auto train_with = [&](const std::string& file, const std::string& out) {
    return fmt::format("{} --config {} --seed 1 --out {}", STRIKER_TRAIN, file, out);
  };
  expect_refusal(train_with("/no/such.toml", path("out")), "/no/such.toml");
  write_to(path("bad.toml"), replaced(paper_text(), "gamma = 0.95", "gamma = 7"));
  expect_refusal(train_with(path("bad.toml"), path("out")), "learner.gamma = 7");
  expect_refusal(train_with(config, "/proc/striker"), "/proc/striker");
  expect_refusal(train_with(config, config), config);
  expect_refusal(fmt::format("{} --config {} --out {}", STRIKER_TRAIN, config, path("out")), "--seed");
  expect_refusal(fmt::format("{} --seed -1 --config {} --out {}", STRIKER_TRAIN, config, path("out")),
                 "--seed: '-1' is no whole number from 0 to 18446744073709551615");
  EXPECT_FALSE(std::filesystem::exists(path("out")));
}

TEST_F(CommandLine, EvaluateRefusesBadInput) {
  const std::string model = a_model();
  const std::string whole = content_of(model);
  write_to(path("cut.safetensors"), whole.substr(0, whole.size() - 100));
  Parameters broken = some_parameters(1);
  broken.values(100) = std::numeric_limits<float>::quiet_NaN();
  write_to(path("nan.safetensors"), write_safetensors({.tensors = tensors_of(broken), .metadata = {}}));
  const auto evaluate_with = [&](const std::string& file, const std::string& more) {
    return fmt::format("{} --model {} {}", STRIKER_EVALUATE, file, more);
  };
  expect_refusal(evaluate_with(path("cut.safetensors"), "--episodes 2 --seed 1"), "truncated");
  expect_refusal(evaluate_with(path("nan.safetensors"), "--episodes 2 --seed 1"), "0.weight holds NaN");
  expect_refusal(evaluate_with(path("none"), "--episodes 2 --seed 1"), "none");
  expect_refusal(evaluate_with(model, "--episodes 0 --seed 1"), "--episodes");
  expect_refusal(evaluate_with(model, "--episodes 2"), "--seed");
  expect_refusal(evaluate_with(model, "--episodes 2 --seed -1"), "'-1' is no whole number from 0");
  expect_refusal(evaluate_with(model, ""), "--decisions");
  expect_refusal(evaluate_with(model, "--episodes 2 --seed 1 --pose here"), "--pose");
  expect_refusal(evaluate_with(model, "--decisions " + path("none.csv")), "none.csv");
}

TEST_F(CommandLine, CeilingWritesWhatItFound) {
  const std::string command =
      fmt::format("{} --episodes 20 --seed 4 --pose anywhere --rivals --replay full", STRIKER_CEILING);
  for (const int jobs : {1, 2}) {
    const Result result = run(
        fmt::format("{0} --jobs {1} --json {2}{1}.json --csv {2}{1}.csv", command, jobs, path("ceiling")));
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_NE(result.out.find("planner"), std::string::npos);
  }
  EXPECT_EQ(content_of(path("ceiling1.json")), content_of(path("ceiling2.json")));
  const std::string csv = content_of(path("ceiling1.csv"));
  EXPECT_EQ(csv, content_of(path("ceiling2.csv")));
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 21);
  const auto report = nlohmann::json::parse(content_of(path("ceiling1.json")));
  EXPECT_EQ(report.at("world"), "full");
  EXPECT_EQ(report.at("pose"), "anywhere");
  const double mean = report.at("mean_reward");
  EXPECT_NEAR(mean, report.at("replay").at("better").at("mean_reward"), 0.05);
  EXPECT_GT(mean, report.at("rivals").at("planner").at("mean_reward"));
}

TEST_F(CommandLine, CeilingRefusesBadInput) {
  const auto with = [](const std::string& more) { return fmt::format("{} {}", STRIKER_CEILING, more); };
  expect_refusal(with("--episodes 2"), "--seed");
  expect_refusal(with("--seed 1"), "--episodes");
  expect_refusal(with("--seed 1 --episodes 0"), "--episodes");
  expect_refusal(with("--seed -1 --episodes 2"), "'-1' is no whole number from 0");
  expect_refusal(with("--seed 1 --episodes 2 --pose here"), "--pose");
  expect_refusal(with("--seed 1 --episodes 2 --replay bus"), "--replay");
  expect_refusal(with("--seed 1 --episodes 2 --jobs 0"), "--jobs");
  expect_refusal(with("--seed 1 --episodes 2 --position-cell 0"), "--position-cell");
  expect_refusal(with("--seed 1 --episodes 2 --speed-cell 0"), "--speed-cell");
}

TEST_F(CommandLine, AnUnwritableResultIsRefusedAndNothingIsLeft) {
  const std::string model = a_model();
  // No standard output is expected: these two fail after their work.
  const Result report =
      run(fmt::format("{} --model {} --episodes 2 --seed 1 --json /no/such/r.json", STRIKER_EVALUATE, model));
  EXPECT_EQ(report.code, 2);
  EXPECT_NE(report.err.find("/no/such/r.json"), std::string::npos) << report.err;
  const Result ceiling = run(fmt::format("{} --episodes 2 --seed 1 --csv /no/such/c.csv", STRIKER_CEILING));
  EXPECT_EQ(ceiling.code, 2);
  EXPECT_NE(ceiling.err.find("/no/such/c.csv"), std::string::npos) << ceiling.err;
  const Result header = run(fmt::format("{} {} -o {}", STRIKER_EXPORT, model, path("no/such.hpp")));
  EXPECT_EQ(header.code, 2);
  EXPECT_NE(header.err.find("no/such.hpp"), std::string::npos) << header.err;
  EXPECT_FALSE(std::filesystem::exists(path("no")));
}

TEST_F(CommandLine, ExportRefusesBadInput) {
  const std::string model = a_model();
  const std::string whole = content_of(model);
  write_to(path("cut.safetensors"), whole.substr(0, 4000));
  expect_refusal(fmt::format("{} {} -o {}", STRIKER_EXPORT, path("cut.safetensors"), path("h.hpp")),
                 "truncated");
  const std::string printed = parse_config("[task]\nequations = \"printed\"\n", "f").text;
  save_model({.parameters = some_parameters(1), .metadata = {{"configuration", printed}}}, path("printed"));
  expect_refusal(fmt::format("{} {} -o {}", STRIKER_EXPORT, path("printed"), path("h.hpp")), "equations");
  expect_refusal(fmt::format("{} {}", STRIKER_EXPORT, model), "--output");
  EXPECT_FALSE(std::filesystem::exists(path("h.hpp")));
}

}  // namespace
}  // namespace striker::training
