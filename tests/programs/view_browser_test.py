#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""A person before the live page, with Debian's Chromium: sees ball and robots move in a kick run and in a match, presses each
kind of button, and what was pressed is on the bus, in the run's log.

Usage: view_browser_test.py BIN   (the folder of the programs)
"""

import glob
import gzip
import os
import sys
import tempfile
import unittest

from view_client import Browser, Run

BIN = sys.argv.pop(1)
SIL = os.path.join(BIN, "striker-sil")
STOP, FAULT_REPORT, COMMAND = "010", "020", "050"


def frames(lines, identifier):
    """The ticks, in ms, in which it was on the bus."""
    for line in lines:
        stamp, _, frame = line.split()
        if frame.startswith(identifier + "#"):
            yield round(float(stamp[1:-1]) * 1000)


def gaps(ticks):
    """Longer ones than from a tick to the next."""
    known = list(ticks)
    return [after - before for before, after in zip(known, known[1:]) if after - before > 1]


class Page(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()  # pylint: disable=consider-using-with
        self.addCleanup(temporary.cleanup)
        self.folder = temporary.name

    def begin(self, *words):
        run = Run(SIL, self.folder, *words)
        self.addCleanup(run.close)
        browser = Browser(os.path.join(self.folder, "profile"))
        self.addCleanup(browser.close)
        browser.open(run.url)
        browser.until("typeof state !== 'undefined' && state !== undefined")
        return run, browser

    def sees_motion(self, browser, what):
        before = browser.value(f"JSON.stringify({what})")
        browser.until(f"JSON.stringify({what}) !== {before!r}")

    def sees_field_change(self, browser):
        picture = "byId('field').toDataURL()"
        before = browser.value(picture)
        browser.until(f"{picture} !== {before!r}")

    def pauses_and_steps(self, browser):
        browser.click("#pause")
        paused_at = browser.until("state.paused && state.tick")
        self.assertEqual(browser.value("byId('pause').textContent"), "Run")
        browser.click("#step")
        self.assertEqual(browser.until(f"state.tick !== {paused_at} && state.tick"), paused_at + 1)
        browser.click("#stepDecision")
        browser.until(f"state.tick === {paused_at + 51}")
        return paused_at + 51

    def choose_speed(self, browser, speed):
        browser.value(f"""byId('speed').value = '{speed}'; byId('speed').dispatchEvent(new Event('change'))""")

    def test_a_kick_run(self):
        run, browser = self.begin("kick", "--view", "--episodes", "200", "--seed", "5", "--log", "bus.log")
        browser.until("state.deciding")
        self.sees_motion(browser, "state.ball")
        self.sees_motion(browser, "state.robots[0].pose")
        self.sees_field_change(browser)
        browser.until("document.querySelectorAll('#q tr').length === hello.actions.length")
        browser.until("byId('load').textContent.includes('%') && byId('bus').rows.length > 8")
        stepped_to = self.pauses_and_steps(browser)
        browser.click("#pause")
        browser.until(f"state.tick > {stepped_to}")
        self.choose_speed(browser, 5)
        browser.until("state.speed === 5")
        self.choose_speed(browser, 0.5)
        browser.until("state.speed === 0.5")
        browser.until("state.deciding && state.contact === null && state.robots[0].state === 'active'")
        browser.click("[data-fault=interface_down]")
        browser.until("state.note[1].startsWith('interface_down')")
        faulty = browser.until("state.robots[0].fault !== 'none' && state.robots[0].fault !== undefined && state.tick")
        self.choose_speed(browser, 1)
        browser.until("state.robots[0].fault === 'none'")  # cleared by the next episode's operator
        pressed_at = browser.value("state.tick")
        browser.click("#stop")
        ended = browser.until("byId('ended').textContent")
        self.assertIn("emergency stop", ended)
        self.assertTrue(browser.value("byId('pause').disabled"))
        status, _, said = run.ended()
        self.assertEqual(status, 4, said)
        self.assertEqual(browser.problems(), [])
        with open(os.path.join(self.folder, "bus.log"), encoding="ascii") as log:
            lines = log.readlines()
        stops = list(frames(lines, STOP))
        self.assertEqual(len(stops), 1)
        self.assertGreaterEqual(stops[0], pressed_at)
        reports = list(frames(lines, FAULT_REPORT))
        self.assertTrue(any(faulty - 1200 < tick <= faulty for tick in reports), (faulty, reports[:5]))
        # No frame came out of the controller while its interface was down.
        self.assertEqual(gaps(frames(lines, COMMAND)), [501])

    def test_a_match(self):
        run, browser = self.begin("match", "--view", "--half-s", "900", "--seed", "2", "-o", "out")
        self.assertEqual(browser.value("state.robots.length"), 10)
        browser.until("byId('game').textContent.includes('half 1')")
        browser.until("state.match.state !== 'pause'")
        self.sees_motion(browser, "state.ball")
        for robot in (0, 4, 9):
            self.sees_motion(browser, f"state.robots[{robot}].pose")
        self.sees_field_change(browser)
        stepped_to = self.pauses_and_steps(browser)
        self.choose_speed(browser, "max")
        browser.click("#pause")
        browser.until(f"state.speed === 0 && state.tick > {stepped_to}")
        self.choose_speed(browser, 1)
        browser.until("state.speed === 1")
        browser.value("byId('robot').value = 4; byId('robot').dispatchEvent(new Event('change'))")
        browser.click("[data-fault=bus_off]")
        browser.until("state.note[1].startsWith('bus_off on robot 4')")
        browser.value("byId('robot').value = 2; byId('robot').dispatchEvent(new Event('change'))")
        browser.click("#stopOne")
        browser.until("state.robots[2].fault === 'emergency_stop'")
        self.assertEqual(browser.value("state.robots.filter((one) => one.fault === 'emergency_stop').length"), 1)
        browser.click("#stop")
        browser.until("state.robots.every((one) => one.faults.includes('emergency_stop'))")
        run.process.terminate()
        status, _, said = run.ended()
        self.assertEqual(status, 130, said)
        browser.until("byId('ended').textContent.includes('interrupted')")
        self.assertEqual(browser.problems(), [])
        for robot in range(10):
            with gzip.open(os.path.join(self.folder, f"out/bus/vcan{robot}.log.gz"), "rt") as log:
                lines = log.readlines()
            stops = len(list(frames(lines, STOP)))
            if robot == 4:  # which may be off its bus when it is pressed, and then hears a later one
                self.assertGreaterEqual(stops, 1)
            else:
                self.assertEqual(stops, 2 if robot == 2 else 1, robot)
            self.assertEqual(gaps(frames(lines, COMMAND)), [501] if robot == 4 else [], robot)
            self.assertEqual(any(frames(lines, FAULT_REPORT)), True)

    def test_a_restart_plays_the_run_of_that_seed(self):
        run, browser = self.begin("kick", "--view", "--view-speed", "0.5", "--episodes", "2", "--seed", "5",
                                  "--log", "bus.log")
        browser.value("byId('seed').value = 8")
        browser.click("#restart")
        browser.until("state.run === 2 && state.seed === 8")
        self.choose_speed(browser, "max")
        self.assertEqual(run.ended()[0], 0)
        browser.until("byId('ended').textContent.includes('all episodes were played')")
        plain = os.path.join(self.folder, "plain")
        os.mkdir(plain)
        again = Run(SIL, plain, "kick", "--view", "--view-speed", "max", "--episodes", "2", "--seed", "8", "--log",
                    "bus.log")
        self.assertEqual(again.ended()[0], 0)
        with open(os.path.join(self.folder, "bus.log"), "rb") as one, open(os.path.join(plain, "bus.log"), "rb") as other:
            self.assertEqual(one.read(), other.read())
        self.assertEqual(glob.glob(os.path.join(self.folder, "*.part")), [])


if __name__ == "__main__":
    unittest.main()
