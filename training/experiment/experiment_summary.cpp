// SPDX-License-Identifier: Apache-2.0
#include "training/experiment/experiment_summary.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

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
  result.never = static_cast<double>(averages.front().size() + moving_average_span);
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

}  // namespace

std::vector<VariantSummary> summarise_variants(const std::vector<Variant>& variants,
                                               const std::vector<std::vector<RunFigures>>& runs,
                                               double ceiling) {
  std::vector<VariantSummary> summaries;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    summaries.push_back(summarise_variant(variants[i], runs[i], runs.front(), ceiling));
  }
  return summaries;
}

}  // namespace striker::training
