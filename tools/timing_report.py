# SPDX-License-Identifier: Apache-2.0
"""What tools/timing-test makes of its runs: figures, the table side by side, and the plots."""

import io
import os
import statistics
import sys

sys.path.append(os.path.join(os.path.dirname(os.path.dirname(os.path.realpath(__file__))), "firmware", "host"))

from striker_files import write_whole  # noqa: E402

PERIOD_US = 1000
LIMIT = 1.2
NAMES = ("cyclictest", "controller")


def percentile(bins, share):
    """The lower end of the bin that holds the smallest time with at least this share at or below it."""
    below = 0
    for lower in sorted(bins):
        below += bins[lower]
        if below >= share * sum(bins.values()):
            return lower
    return 0


def figures(bins, runs):
    count = sum(bins.values())
    return {"count": count,
            "min_us": min(one["min"] for one in runs),
            "mean_us": sum(one["mean"] * sum(one["bins"].values()) for one in runs) / count,
            "p99_us": percentile(bins, 0.99),
            "p99_9_us": percentile(bins, 0.999),
            "p99_99_us": percentile(bins, 0.9999),
            "max_us": max(one["max"] for one in runs),
            "overruns": sum(number for lower, number in bins.items() if lower >= PERIOD_US)}


def add_up(runs):
    total = {}
    for one in runs:
        for lower, count in one["bins"].items():
            total[lower] = total.get(lower, 0) + count
    return total


def print_table(sides, ratios, reports):
    print(f"{'lateness in us':<16}{NAMES[0]:>14}{NAMES[1]:>14}")
    for key, name in (("count", "wake-ups"), ("min_us", "min"), ("mean_us", "average"), ("p99_us", "p99"),
                      ("p99_9_us", "p99.9"), ("p99_99_us", "p99.99"), ("max_us", "max"), ("overruns", "over 1 ms")):
        print(f"{name:<16}" + "".join(f"{round(side[key], 1):>14}" for side in sides))
    print(f"p99.9 of controller / cyclictest, by pair: {' '.join(f'{ratio:.2f}' for ratio in ratios)}")
    median = statistics.median(ratios)
    print(f"median {median:.2f}: {'at most' if median <= LIMIT else 'NOT at most'} {LIMIT}")
    execution = add_up([{"bins": {lower: count for lower, _, count in report["execution"]["bins_us"]}}
                        for report in reports])
    print(f"controller: execution of a tick p99.9 {percentile(execution, 0.999)} us, max "
          f"{max(report['execution']['max_us'] for report in reports):.1f} us; periods missed "
          f"{sum(report['missed_periods'] for report in reports)}; page faults "
          f"{sum(report['minor_faults'] + report['major_faults'] for report in reports)}; involuntary switches "
          f"{sum(report['involuntary_switches'] for report in reports)}")


def draw(path, title, label, series):
    import matplotlib
    matplotlib.use("Agg")
    matplotlib.rcParams.update({"svg.hashsalt": "striker", "svg.fonttype": "none"})
    from matplotlib import pyplot
    figure, (counts, shares) = pyplot.subplots(1, 2, figsize=(10, 4), layout="constrained")
    for name, bins in series.items():
        total = sum(bins.values())
        lower = sorted(bins)
        # Bins of 1 us alone, the empty ones too: wider ones would look higher.
        narrow = range(max(0, lower[0] - 1), min(1000, lower[-1] + 2))
        counts.step(narrow, [bins.get(us, 0) or float("nan") for us in narrow], where="mid", label=name, linewidth=1)
        left = total
        later = []
        for us in lower:
            later.append(left / total)
            left -= bins[us]
        shares.step([max(us, 0.5) for us in lower], later, where="pre", label=name, linewidth=1)
    counts.set(yscale="log", xlabel=label + " (up to 1 ms)", ylabel="ticks in 1 us")
    shares.set(xscale="log", yscale="log", xlabel=label, ylabel="share of ticks at or beyond")
    for axes in (counts, shares):
        axes.grid(True, alpha=0.3)
        axes.legend()
    figure.suptitle(title)
    for kind in ("svg", "png"):
        picture = io.BytesIO()
        figure.savefig(picture, format=kind, dpi=120, metadata={"Date": None} if kind == "svg" else None)
        write_whole(f"{path}.{kind}", picture.getvalue(), b"<svg" if kind == "svg" else b"PNG")
    pyplot.close(figure)
