#include "training/experiment/experiment_summary.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "firmware/host/files.hpp"
#include "training/run/training_run.hpp"

namespace striker::training {

namespace {

constexpr std::uint64_t bootstrap_seed = 1;
constexpr int final_span = 1000;
constexpr int curve_period = 25;  // episodes between two points of a curve

using Runs = std::vector<RunFigures>;
using Values = std::vector<double>;

// One a run, for each episode from the first full window on.
Values moving_averages(const Values& rewards) {
  Values averages;
  double sum = 0.0;
  for (std::size_t i = 0; i < rewards.size(); ++i) {
    sum += rewards[i];
    if (i >= moving_average_span) {
      sum -= rewards[i - moving_average_span];
    }
    if (i + 1 >= moving_average_span) {
      averages.push_back(sum / moving_average_span);
    }
  }
  return averages.empty() ? Values{mean(rewards)} : averages;
}

Estimate interquartile(const Values& values) {
  return {.value = interquartile_mean(values), .interval = interquartile_interval(values, bootstrap_seed)};
}

Estimate median(const Values& values) {
  return {.value = quantile(values, 0.5),
          .interval = bootstrap_interval(
              {values}, [](const auto& drawn) { return quantile(drawn[0], 0.5); }, bootstrap_seed)};
}

template <class Figure>
Values of_each(const Runs& runs, Figure figure) {
  Values values;
  std::transform(runs.begin(), runs.end(), std::back_inserter(values), figure);
  return values;
}

double final_mean(const RunFigures& run) {
  const std::size_t span = std::min<std::size_t>(final_span, run.rewards.size());
  return mean(std::span(run.rewards).last(span));
}

Crossing crossing(const std::vector<Values>& averages, double level) {
  Crossing result;
  Values episodes;
  for (const Values& run : averages) {
    const auto above = std::find_if(run.begin(), run.end(), [level](double value) { return value > level; });
    result.reached += above != run.end() ? 1 : 0;
    episodes.push_back(static_cast<double>(above - run.begin() + moving_average_span));
  }
  result.episode = median(episodes);
  return result;
}

std::vector<CurvePoint> curve_of(const std::vector<Values>& averages) {
  std::vector<CurvePoint> curve;
  for (std::size_t at = 0; at < averages.front().size(); at += curve_period) {
    Values values;
    for (const Values& run : averages) {
      values.push_back(run[at]);
    }
    curve.push_back(
        {.episode = static_cast<int>(at) + moving_average_span, .moving_average = interquartile(values)});
  }
  return curve;
}

VariantSummary summarise_variant(const Variant& variant, const Runs& runs, const Runs& first,
                                 double ceiling) {
  const double way = ceiling - floor_reward;
  const std::array<double, crossing_levels> levels = {floor_reward, 0.0, floor_reward + 0.5 * way,
                                                      floor_reward + 0.9 * way};
  std::vector<Values> averages;
  for (const RunFigures& run : runs) {
    averages.push_back(moving_averages(run.rewards));
  }
  VariantSummary summary;
  summary.variant = &variant;
  summary.runs = static_cast<int>(runs.size());
  for (std::size_t i = 0; i < levels.size(); ++i) {
    summary.crossings[i] = crossing(averages, levels[i]);
  }
  const auto of_averages = [&averages](auto figure) {
    Values values;
    std::transform(averages.begin(), averages.end(), std::back_inserter(values), figure);
    return interquartile(values);
  };
  summary.start = of_averages([](const Values& run) { return run.front(); });
  summary.best = of_averages([](const Values& run) { return *std::max_element(run.begin(), run.end()); });
  const Values finals = of_each(runs, final_mean);
  summary.final_mean = interquartile(finals);
  summary.origin_mean = interquartile(of_each(runs, [](const RunFigures& run) { return run.origin_mean; }));
  summary.anywhere_mean =
      interquartile(of_each(runs, [](const RunFigures& run) { return run.anywhere_mean; }));
  summary.loss =
      interquartile(of_each(runs, [](const RunFigures& run) { return run.origin_mean - run.anywhere_mean; }));
  const Values first_finals = of_each(first, final_mean);
  summary.behind_first = {.value = probability_of_improvement(first_finals, finals),
                          .interval = improvement_interval(first_finals, finals, bootstrap_seed)};
  summary.curve = curve_of(averages);
  return summary;
}

// Without the sign of what rounds to 0.
double hundredths(double value) {
  return std::abs(value) < 0.005 ? 0.0 : value;
}

std::string figure(const Estimate& estimate) {
  return fmt::format("{:.2f} [{:.2f}, {:.2f}]", hundredths(estimate.value), hundredths(estimate.interval.low),
                     hundredths(estimate.interval.high));
}

std::string figure(const Crossing& crossing, int runs) {
  const std::string reached =
      crossing.reached == runs ? std::string() : fmt::format(", {} of {} runs", crossing.reached, runs);
  return fmt::format("{:.0f} [{:.0f}, {:.0f}]{}", crossing.episode.value, crossing.episode.interval.low,
                     crossing.episode.interval.high, reached);
}

std::string columns(const Estimate& estimate) {
  return fmt::format(",{:.4f},{:.4f},{:.4f}", estimate.value, estimate.interval.low, estimate.interval.high);
}

std::string summary_csv(const std::vector<VariantSummary>& summaries) {
  std::string csv = "variant,runs";
  for (const char* level : {"-4", "0", "50%", "90%"}) {
    csv += fmt::format(",episodes_to_{0},episodes_to_{0}_low,episodes_to_{0}_high,reached_{0}", level);
  }
  for (const char* name :
       {"start", "best", "final_1000", "origin", "anywhere", "loss_anywhere", "p_first_better"}) {
    csv += fmt::format(",{0},{0}_low,{0}_high", name);
  }
  csv += '\n';
  for (const VariantSummary& summary : summaries) {
    csv += fmt::format("{},{}", summary.variant->name, summary.runs);
    for (const Crossing& crossing : summary.crossings) {
      csv += columns(crossing.episode) + fmt::format(",{}", crossing.reached);
    }
    for (const Estimate& estimate : {summary.start, summary.best, summary.final_mean, summary.origin_mean,
                                     summary.anywhere_mean, summary.loss, summary.behind_first}) {
      csv += columns(estimate);
    }
    csv += '\n';
  }
  return csv;
}

std::string curves_csv(const std::vector<VariantSummary>& summaries) {
  std::string csv = "variant,episode,moving_average,low,high\n";
  for (const VariantSummary& summary : summaries) {
    for (const CurvePoint& point : summary.curve) {
      csv += fmt::format("{},{}{}\n", summary.variant->name, point.episode, columns(point.moving_average));
    }
  }
  return csv;
}

std::string summary_table(const std::vector<VariantSummary>& summaries, double ceiling) {
  std::string text = fmt::format(
      "Interquartile means over {} seeds with 95 % bootstrap intervals; episodes until the moving average of "
      "250 "
      "exceeds a level are medians. 50 % and 90 %: of the way from -4 to the ceiling of {:.3f}. Origin and "
      "anywhere: greedy play on {} held-out episodes. P: the probability that a run of the first variant "
      "ends "
      "with the better mean over its last 1,000 episodes.\n\n"
      "| variant | to -4 | to 0 | to 50 % | to 90 % | best average | last 1,000 | origin | anywhere | lost "
      "anywhere "
      "| P |\n|---|---|---|---|---|---|---|---|---|---|---|\n",
      summaries.front().runs, ceiling, evaluation_episodes);
  for (const VariantSummary& s : summaries) {
    text += fmt::format("| {} |", s.variant->says);
    for (const Crossing& crossing : s.crossings) {
      text += fmt::format(" {} |", figure(crossing, s.runs));
    }
    for (const Estimate& estimate :
         {s.best, s.final_mean, s.origin_mean, s.anywhere_mean, s.loss, s.behind_first}) {
      text += fmt::format(" {} |", figure(estimate));
    }
    text += '\n';
  }
  return text;
}

const VariantSummary* find(const std::vector<VariantSummary>& summaries, const std::string& name) {
  const auto found = std::find_if(summaries.begin(), summaries.end(),
                                  [&name](const VariantSummary& s) { return s.variant->name == name; });
  return found == summaries.end() ? nullptr : &*found;
}

}  // namespace

std::vector<VariantSummary> summarise(const std::vector<Variant>& variants,
                                      const std::vector<std::vector<RunFigures>>& runs, double ceiling) {
  std::vector<VariantSummary> summaries;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    summaries.push_back(summarise_variant(variants[i], runs[i], runs.front(), ceiling));
  }
  return summaries;
}

void write_summary(const std::vector<VariantSummary>& summaries, double ceiling,
                   const std::filesystem::path& directory) {
  host::write_file(directory / "summary.csv", summary_csv(summaries));
  host::write_file(directory / "curves.csv", curves_csv(summaries));
  host::write_file(directory / "summary.md", summary_table(summaries, ceiling));
}

std::string claims_table(const std::vector<VariantSummary>& summaries) {
  const VariantSummary& rcs = summaries.front();
  const VariantSummary* wide = find(summaries, "rcs+4");
  std::string text = "| the paper, one run each | found | holds |\n|---|---|---|\n";
  const double to_floor = rcs.crossings[0].episode.value;
  text += fmt::format("| RCS exceeds -4 from about episode 1,500 | from episode {} | {} |\n",
                      figure(rcs.crossings[0], rcs.runs),
                      std::abs(to_floor - 1500.0) < 250.0 ? "yes" : "no: random play is already above -4");
  if (wide != nullptr) {
    const auto delay = [&](std::size_t level) {
      return wide->crossings[level].episode.value - rcs.crossings[level].episode.value;
    };
    text += fmt::format(
        "| about 500 episodes before the ACS-sized state | {:.0f} episodes earlier to -4, {:.0f} to 0, "
        "{:.0f} to "
        "50 % | {} |\n",
        delay(0), delay(1), delay(2),
        delay(1) > 250.0 && delay(2) > 250.0 ? "yes"
        : delay(1) > 0.0 && delay(2) > 0.0   ? "earlier, by less"
                                             : "no");
  }
  const auto best = std::max_element(summaries.begin(), summaries.end(), [](const auto& a, const auto& b) {
    return a.best.value < b.best.value;
  });
  text += fmt::format("| RCS has the best value, 6.8 | {} for RCS; the best is {} with {} | {} |\n",
                      figure(rcs.best), best->variant->says, figure(best->best),
                      best->variant == rcs.variant                        ? "yes"
                      : best->best.interval.low <= rcs.best.interval.high ? "not to be told apart"
                                                                          : "no");
  return text;
}

std::string readings_table(const std::vector<VariantSummary>& summaries) {
  constexpr double paper_crossing = 1500.0;
  constexpr double paper_best = 6.8;
  // In units of what one would still call similar: a reward of 1, 500 episodes.
  const auto distance = [](const VariantSummary& s) {
    const double start = std::max(0.0, s.start.value - floor_reward);
    return start + std::abs(s.crossings[0].episode.value - paper_crossing) / 500.0 +
           std::abs(s.best.value - paper_best);
  };
  std::string text =
      "The paper: below -4 at first, above it from about episode 1,500, best 6.8. Distance: how far the "
      "first "
      "average is above -4, plus the crossing's distance in 500 episodes, plus the best value's distance.\n\n"
      "| reading | first average | above -4 from | best average | distance |\n|---|---|---|---|---|\n";
  double least = std::numeric_limits<double>::infinity();
  std::string closest;
  for (const VariantSummary& s : summaries) {
    text += fmt::format("| {} | {} | {} | {} | {:.2f} |\n", s.variant->says, figure(s.start),
                        figure(s.crossings[0], s.runs), figure(s.best), distance(s));
    if (distance(s) < least) {
      least = distance(s);
      closest = s.variant->says;
    }
  }
  return text + fmt::format("\nClosest: {} (distance {:.2f}).\n", closest, least);
}

}  // namespace striker::training
