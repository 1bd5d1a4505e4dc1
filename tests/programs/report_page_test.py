#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What a report says of runs that are no result and of episodes that do not begin at 0, seen by a browser; and that -o of
striker-report and striker-plot-kick replaces nothing but their own earlier results: no input, no link, no FIFO.

Usage: report_page_test.py BIN   (the folder of the programs)
"""

import json
import os
import shutil
import stat
import subprocess
import sys
import tempfile
import threading
import unittest

BIN = sys.argv.pop(1)
CLICK = "<script>for (const row of document.querySelectorAll('tr[data-replay=\"{}\"]')) row.click();</script></body>"


def run(program, *words):
    return subprocess.run([os.path.join(BIN, program), *words], capture_output=True, text=True, check=False)


def read(*path):
    with open(os.path.join(*path), "rb") as file:
        return file.read()


class ReportPage(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()  # pylint: disable=consider-using-with
        cls.folder = cls.temporary.name
        cls.later = cls.play("later", "--first", "7")
        cls.undriven = cls.play("a<!--<script>b", "--vary", "camera_rate_Hz=40", status=3)
        cls.page = os.path.join(cls.folder, "report.html")
        made = run("striker-report", cls.later, cls.undriven, "-o", cls.page)
        assert made.returncode == 0, made.stderr

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    @classmethod
    def play(cls, name, *words, status=0):
        folder = os.path.join(cls.folder, name)
        os.mkdir(folder)
        played = run("striker-sil", "kick", "--episodes", "3", "--seed", "5", *words, "--log", f"{folder}/bus.log", "--json",
                     f"{folder}/kick.json")
        assert played.returncode == status, played.stderr
        return folder

    def path(self, name):
        return os.path.join(self.folder, name)

    def clicked(self, page, episode):
        """The page as a browser has it after a click on an episode's row."""
        text = read(page).decode().replace("</body>", CLICK.format(episode))
        changed = self.path("clicked.html")
        with open(changed, "w", encoding="utf-8") as file:
            file.write(text)
        words = ["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                 f"--user-data-dir={self.path('profile')}", "--virtual-time-budget=2000", "--dump-dom", f"file://{changed}"]
        return subprocess.run(words, capture_output=True, text=True, check=True, timeout=300).stdout

    def test_a_row_shows_its_own_episode_and_what_is_no_result_is_said(self):
        page = self.clicked(self.page, 8)
        self.assertIn("episode 8, reward ", page.split('id="state0">')[1].split("</div>")[0])
        notices = [part.split("</p>")[0] for part in page.split('<p class="notice">')[1:]]
        self.assertEqual(len(notices), 1, notices)
        self.assertIn("3 of 3 episodes were not driven all along, and are no result of a policy", notices[0])
        self.assertIn("episode 0, reward ", page.split('id="state1">')[1].split("</div>")[0])  # its folder's name hides nothing

    def test_rows_in_another_order_are_the_same_report(self):
        other = self.path("rows_reversed")
        os.mkdir(other)
        shutil.copy(f"{self.later}/bus.log", other)
        kicks = json.loads(read(self.later, "kick.json"))
        kicks["rows"].reverse()
        with open(f"{other}/kick.json", "w", encoding="utf-8") as file:
            json.dump(kicks, file)
        for folder in (self.later, other):
            self.assertEqual(run("striker-report", folder, "-o", f"{folder}.html").returncode, 0)
        self.assertEqual(read(f"{self.later}.html"), read(f"{other}.html").replace(b"rows_reversed", b"later"))
        kicks["rows"][0]["episode"] = 7
        with open(f"{other}/kick.json", "w", encoding="utf-8") as file:
            json.dump(kicks, file)
        self.assertIn("not those of one run", run("striker-report", other, "-o", f"{other}.html").stderr)

    def test_an_input_is_never_replaced(self):
        before = {name: read(self.later, name) for name in ("bus.log", "kick.json")}
        os.link(f"{self.later}/kick.json", self.path("linked"))
        os.symlink(f"{self.later}/bus.log", self.path("pointed"))
        for out in (f"{self.later}/bus.log", f"{self.later}/kick.json", self.path("linked"), self.path("pointed")):
            done = run("striker-report", self.later, "-o", out)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
            self.assertIn("is no earlier result", done.stderr)
        self.assertEqual(before, {name: read(self.later, name) for name in before})
        self.assertFalse([name for name in os.listdir(self.later) if name.endswith(".part")])

    def into_fifo(self, name, words):
        """What a program writes into a symbolic link to a FIFO; both are there afterwards."""
        fifo, link, got = self.path(f"{name}.fifo"), self.path(name), []
        os.mkfifo(fifo)
        os.makedirs(os.path.dirname(link), exist_ok=True)
        os.symlink(fifo, link)
        reader = threading.Thread(target=lambda: got.append(read(fifo)), daemon=True)
        reader.start()
        done = run(*words)
        self.assertTrue(stat.S_ISFIFO(os.stat(fifo).st_mode) and os.path.islink(link))
        reader.join(30)
        self.assertEqual(done.returncode, 0, done.stderr)
        return got[0]

    def test_a_fifo_is_written_into_and_stays(self):
        self.assertEqual(self.into_fifo("page", ["striker-report", self.later, self.undriven, "-o", self.path("page")]),
                         read(self.page))
        os.mkdir(self.path("drawn"))
        picture = self.into_fifo("drawn/kick.svg", ["striker-plot-kick", f"{self.later}/bus.log", "-o", self.path("drawn")])
        self.assertIn(b"kick 0 of the log", picture)

    def test_an_earlier_report_is_replaced_through_its_link_and_keeps_its_mode(self):
        page, link = self.path("mode.html"), self.path("mode.link")
        with open(page, "w", encoding="utf-8"):
            pass
        os.chmod(page, 0o600)
        os.symlink(page, link)
        for runs in ([self.later], [self.later, self.undriven]):
            self.assertEqual(run("striker-report", *runs, "-o", link).returncode, 0)
        self.assertEqual(read(page), read(self.page))
        self.assertTrue(os.path.islink(link))
        self.assertEqual(stat.S_IMODE(os.stat(page).st_mode), 0o600)

    def test_pictures_name_episodes_and_say_what_is_no_result(self):
        for folder, drawn, said in ((self.later, "9", b"episode 9, reward "), (self.undriven, "0", b"not driven all along")):
            out = self.path(f"plot{drawn}")
            done = run("striker-plot-kick", f"{folder}/bus.log", "--json", f"{folder}/kick.json", "--episode", drawn, "-o", out)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn(said, read(out, "kick.svg"))
        done = run("striker-plot-kick", f"{self.later}/bus.log", "--json", f"{self.later}/kick.json", "--episode", "0", "-o", out)
        self.assertIn("the episodes 7 to 9", done.stderr)
        shutil.copy(f"{self.later}/bus.log", f"{out}/kick.svg")
        done = run("striker-plot-kick", f"{self.later}/bus.log", "-o", out)
        self.assertEqual(done.returncode, 2)
        self.assertEqual(read(out, "kick.svg"), read(self.later, "bus.log"))


if __name__ == "__main__":
    unittest.main()
