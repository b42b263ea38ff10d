# SPDX-License-Identifier: MIT
"""audit --html: the page is written, and works in a browser."""
import contextlib
import json
import unittest

import browser
import program

# What the page shows of the chosen record, each as text that changes with it.
SHOWN = """(() => {
    const text = (selector) => document.querySelector(selector).textContent;
    return {
        chosen: text('#chosen'),
        record: Number(/record (\\d+)/.exec(text('#chosen'))[1]),
        numbers: text('#numbers'),
        matrix: [...document.querySelectorAll('#matrix .cell')].map((c) => c.style.fill + c.getAttribute('class')).join(),
        cursors: [...document.querySelectorAll('.cursor')].map((c) => c.getAttribute('d').split(' ')[0]),
        values: [...document.querySelectorAll('.plots .value')].map((v) => v.textContent),
        address: location.hash,
    };
})()"""
KEPT = "JSON.parse(document.getElementById('data').textContent).kept.map((r) => r.n)"


class AuditPage(program.InAFolder):
    def test_is_written_beside_the_text(self):
        self.run_here("simulate", "--loops", 1, "-o", "run.jsonl")
        status, text, errors = self.run_here("audit", "run.jsonl", "--html", "page.html")
        self.assertEqual(status, 0, errors)
        self.assertIn("no law is broken", text)
        page = (self.folder / "page.html").read_text()
        self.assertTrue(page.startswith("<!doctype html>"))
        self.assertIn("run.jsonl", page)

    def test_of_the_papers_run_stays_small(self):
        self.run_here("simulate", "--record", "all", "--loops", 7, "-o", "run.jsonl.zst")
        self.run_here("audit", "run.jsonl.zst", "--html", "page.html")
        self.assertLess((self.folder / "page.html").stat().st_size, 1_000_000)

    def test_a_place_that_cannot_be_written_is_said(self):
        self.run_here("simulate", "--loops", 1, "-o", "run.jsonl")
        self.refused("audit", "run.jsonl", "--html", "none/page.html", saying=["none/page.html", "written"])


class AuditPageInBrowser(program.InAFolder):
    @classmethod
    def setUpClass(cls):
        if browser.PATH is None:
            raise unittest.SkipTest("Chromium is not installed")
        cls.browser = browser.Browser()
        cls.addClassCleanup(cls.browser.close)

    def simulate(self, *words, name="run.jsonl"):
        self.assertEqual(self.run_here("simulate", *words, "-o", name)[0], 0)
        return name

    @contextlib.contextmanager
    def page(self, run, at="", **how):
        """The page of a run; whatever it does, nothing is fetched and nothing goes wrong."""
        self.assertIn(self.run_here("audit", run, "--quiet", "--html", "page.html")[0], (0, 1, 3))
        url = (self.folder / "page.html").as_uri()
        self.browser.open(url + at, **how)
        yield self.browser
        self.assertEqual(self.browser.errors, [])
        self.assertEqual(self.browser.requests, [url])

    def faulty(self):
        return self.simulate("--record", "all", "--fault", "paper", "--fault-features", 2, 8, 14)

    def assertAllChanged(self, before, after):
        for what in ("chosen", "record", "numbers", "matrix", "cursors", "values", "address"):
            self.assertNotEqual(before[what], after[what], what)

    def assertOnePlace(self, shown):
        self.assertEqual(len(shown["cursors"]), 4)
        self.assertEqual(len(set(shown["cursors"])), 1, shown["cursors"])

    def test_opens_at_the_first_break(self):
        run = self.faulty()
        with self.page(run) as page:
            self.run_here("audit", run, "--json", "report.json")
            first = min(law["first_record"] for law in self.load("report.json")["laws"]
                        if law["first_record"] is not None)
            self.assertEqual(page.value(SHOWN)["record"], first)

    def test_clicking_the_time_line_chooses_the_record(self):
        with self.page(self.faulty()) as page:
            before = page.value(SHOWN)
            kept = page.value(KEPT)
            x, y = page.middle("#timeline svg .whole")
            page.click(x, y)
            after = page.value(SHOWN)
            self.assertAllChanged(before, after)
            self.assertOnePlace(after)
            self.assertAlmostEqual(after["record"], kept[-1] / 2, delta=0.01 * kept[-1])
            self.assertEqual(after["address"], f"#record={after['record']}")
            self.assertIn(f"{after['record']},", after["numbers"])

    def test_arrow_keys_go_to_the_records_beside(self):
        with self.page(self.faulty()) as page:
            kept = page.value(KEPT)
            page.click(*page.middle("#timeline svg .whole"))
            middle = page.value(SHOWN)
            place = kept.index(middle["record"])
            page.press("ArrowRight")
            right = page.value(SHOWN)
            self.assertAllChanged(middle, right)
            self.assertOnePlace(right)
            self.assertEqual(right["record"], kept[place + 1])
            page.press("ArrowLeft")
            self.assertEqual(page.value(SHOWN), middle)
            page.press("ArrowLeft", shift=True)
            self.assertEqual(page.value(SHOWN)["record"], kept[place - 10])

    def test_dragging_in_a_plot_chooses_too(self):
        with self.page(self.faulty()) as page:
            x, y = page.middle("#nis svg")
            page.mouse("mousePressed", x, y)
            page.frame()
            before = page.value(SHOWN)
            page.mouse("mouseMoved", x + 150, y)
            page.mouse("mouseReleased", x + 150, y)
            page.frame()
            after = page.value(SHOWN)
            self.assertAllChanged(before, after)
            self.assertGreater(after["record"], before["record"])
            page.hover(x, y)  # let go: no more than a look
            self.assertEqual(page.value(SHOWN)["record"], after["record"])
            self.assertIn("degrees of freedom", page.value("document.getElementById('tip').textContent"))

    def test_an_address_names_the_record(self):
        with self.page(self.faulty(), at="#record=900") as page:
            shown = page.value(SHOWN)
            self.assertEqual(shown["record"], max(n for n in page.value(KEPT) if n <= 900))
            page.click(*page.middle(".finding a"))
            link = page.value("document.querySelector('.finding a').getAttribute('href')")
            self.assertEqual(f"#record={page.value(SHOWN)['record']}", link)

    def test_cells_of_blamed_features_are_marked(self):
        with self.page(self.faulty(), at="#record=1300") as page:
            self.assertEqual(page.value("document.querySelectorAll('#matrix .cell').length"), 15 * 16 // 2)
            self.assertEqual(page.value("document.querySelectorAll('#matrix .plot .mark').length"),
                             15 + 14 + 13)
            self.assertEqual(page.value("[...new Set([...document.querySelectorAll('#matrix text.blamed')]"
                                        ".map((t) => t.textContent))].sort().join()"), "14,2,8")
            self.assertGreater(page.value("document.querySelectorAll('#pairs .pair.blamed').length"), 10)

    def test_a_healthy_run_has_no_mark(self):
        with self.page(self.simulate("--record", "all")) as page:
            self.assertEqual(page.value("document.querySelectorAll('.mark, .blamed, .finding, .broken').length"), 0)
            self.assertIn("No law is broken", page.value("document.querySelector('h1').textContent"))

    def test_a_cell_tells_its_size_and_shows_its_pair(self):
        with self.page(self.faulty(), at="#record=900") as page:
            x, y = page.middle('#matrix [data-pair="1 3"]')
            page.hover(x, y)
            said = page.value("document.getElementById('tip').textContent")
            self.assertIn("features 1 and 3", said)
            self.assertIn("m²", said)
            page.click(x, y)
            self.assertEqual(page.value("document.querySelectorAll('#pairs svg .pair.picked').length"), 2)  # line, key

    def test_a_run_that_ends_in_nan_is_shown(self):
        lines = (self.folder / self.simulate("--loops", 1)).read_text().splitlines()
        for k in range(60, len(lines)):
            record = json.loads(lines[k])
            record["pose"][0] = float("nan")
            record["covariance"] = [float("nan")] * len(record["covariance"])
            lines[k] = json.dumps(record)
        self.write("nan.jsonl", "\n".join(lines) + "\n")
        with self.page("nan.jsonl") as page:
            self.assertIn("not finite", page.value(SHOWN)["numbers"])
            self.assertGreater(page.value("document.querySelectorAll('#matrix .cell.odd').length"), 0)
            page.press("ArrowLeft")
            self.assertEqual(page.value("document.querySelectorAll('#matrix .cell.odd').length"), 0)

    def test_odd_runs_are_pages_too(self):
        header = '{"format": "slamscope", "version": 1, "sensor": "range-bearing"}\n'
        alone = '{"time_s": 1, "pose": [0, 0, 0], "ids": [], "features": [], "covariance": [0,0,0,0,0,0]}\n'
        one = ('{"time_s": %d, "pose": [0, 0, 0], "ids": [4], "features": [[1.0, 0.2]], '
               '"covariance": [1,0,1,0,0,1,0,0,0,1,0,0,0,0,1]}\n')
        for text in (alone, one % 1, one % 1 + one % 2):
            self.write("odd.jsonl", header + text)
            with self.subTest(text=text), self.page("odd.jsonl") as page:
                self.assertEqual(page.value("document.querySelectorAll('#numbers dt').length > 3"), True)

    def test_a_name_with_quotes_stays_a_name(self):
        name = "a\"b'<i>&amp;.jsonl"
        self.simulate("--loops", 1, name=name)
        with self.page(name) as page:
            self.assertEqual(page.value("document.querySelector('.top code').textContent"), name)

    def test_follows_the_colour_scheme_and_the_width(self):
        run = self.faulty()
        ground = "getComputedStyle(document.body).backgroundColor"
        with self.page(run) as page:
            light = page.value(ground)
        with self.page(run, dark=True, width=420, height=800) as page:
            self.assertNotEqual(page.value(ground), light)
            self.assertLessEqual(page.value("document.documentElement.scrollWidth"), 420)

    def test_what_goes_wrong_would_be_seen(self):
        bad = self.write("bad.html", "<script>console.error('x'); nonesuch();</script><img src='none.png'>")
        self.browser.open(bad.as_uri())
        self.assertGreaterEqual(len(self.browser.errors), 2)
        self.assertEqual(len(self.browser.requests), 2)


if __name__ == "__main__":
    program.main()
