// SPDX-License-Identifier: Apache-2.0
#include "training/experiment/summary_csv.hpp"

#include <fmt/format.h>

namespace striker::training {

namespace {

std::string columns(const Estimate& estimate) {
  return fmt::format(",{:.4f},{:.4f},{:.4f}", estimate.value, estimate.interval.low, estimate.interval.high);
}

}  // namespace

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

}  // namespace striker::training
