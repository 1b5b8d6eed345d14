# SPDX-License-Identifier: Apache-2.0
import json

import noli
import numpy as np
from support import TestCase, run_noli


def exact(pair, x_t0, x_t1):
    return noli.contacts(pair, x_t0, x_t1).time


def hits(pair, x_t0, x_t1):
    return noli.contacts(pair, x_t0, x_t1, times=False).touches


class Audit(TestCase):
    def test_an_exact_function_has_no_finding(self):
        for function in (exact, hits):
            found = noli.fuzz_queries(function, count=5000, exact=True)
            self.assertEqual(found.verdict, "no_finding")
            self.assertEqual(found.asked, 5000)
            self.assertTrue(0 < found.contacts < found.asked)

    def test_each_fault_is_found(self):
        def late(pair, a, b):
            return np.minimum(exact(pair, a, b) + 1e-6, 1)

        def outside(pair, a, b):
            return exact(pair, a, b) + 2

        faults = {
            "false_negative": lambda pair, a, b: np.zeros(len(a), bool),
            "late": late,
            "bad_time": outside,
            "false_positive": lambda pair, a, b: np.ones(len(a), bool),
            "early": lambda pair, a, b: exact(pair, a, b) / 2,
        }
        for fault, function in faults.items():
            with self.subTest(fault):
                found = noli.fuzz_queries(function, count=3000, exact=True, shrink=False)
                self.assertGreater(found.faults[fault], 0)
                self.assertEqual(found.verdict, "finding")
                self.assertIn(fault, {finding.fault for finding in found.findings})
        for fault in ("false_positive", "early"):
            self.assertEqual(noli.fuzz_queries(faults[fault], count=3000).verdict, "no_finding")

    def test_shows_itself(self):
        found = noli.fuzz_queries(lambda pair, a, b: np.where(hits(pair, a, b), np.nan, np.inf), count=2000)
        first = found.findings[0]
        text = str(found)
        self.assertTrue(text.splitlines()[-1].startswith("FINDING  2000 queries"))
        self.assertIn(f"x_t0 = {first.x_t0.tolist()!r}", text)
        self.assertIn("the function answered nan (false_negative)", text)
        self.assertIn("<td>false_negative</td>", found._repr_html_())
        same = json.loads(json.dumps(found.to_json(), allow_nan=False))
        self.assertEqual(same["faults"], found.faults)
        self.assertIsNone(same["findings"][0]["answer"])
        self.assertTrue(np.array_equal(same["findings"][0]["x_t1"], first.x_t1))
        none = noli.fuzz_queries(exact, count=200)
        self.assertTrue(str(none).startswith("NO FINDING  200 queries"))
        self.assertNotIn("<table", none._repr_html_())
        self.assertEqual(none.to_json()["findings"], [])
        # What does not count for the verdict is not told beside it.
        self.assertNotIn("false_positive", str(noli.fuzz_queries(lambda pair, a, b: np.ones(len(a), bool), count=200)))

    def test_findings_are_made_simpler_and_saved(self):
        def blind(pair, a, b):  # to features that are parallel as they meet
            return hits(pair, a, b) & (noli.contacts(pair, a, b).kind != "persistent")

        found = noli.fuzz_queries(blind, count=3000, pairs=["edge_edge"])
        self.assertEqual(found.verdict, "finding")
        finding = found.findings[0]
        self.assertEqual((finding.fault, finding.kind), ("false_negative", "persistent"))
        self.assertLess(len(np.unique([finding.x_t0, finding.x_t1])), 6)
        file = self.folder / "one-edge-edge.csv"
        finding.save(file)
        run_noli("ccd", file, expected=0)
        with self.assertRaisesRegex(noli.UsageError, "exists already"):
            finding.save(file)
        with self.assertRaisesRegex(noli.UsageError, "edge-edge"):
            finding.save(self.folder / "one.csv")

    def test_findings_of_both_pairs_and_missed_crossings_first(self):
        for most in (1, 5, 20):
            found = noli.fuzz_queries(lambda pair, a, b: np.zeros(len(a), bool), count=3000, max_findings=most, shrink=False)
            self.assertEqual(len(found.findings), most)
            self.assertEqual(found.findings[0].kind, "crossing")
            self.assertIs(found.findings[0].answer, False)
            if most > 1:
                self.assertEqual({finding.pair for finding in found.findings}, {"vertex_face", "edge_edge"})

    def test_a_callers_own_queries(self):
        x = np.random.default_rng(5).random((2, 200, 4, 3))
        found = noli.audit_ccd(lambda pair, a, b: np.zeros(len(a), bool), {"edge_edge": (x[0], x[1])})
        self.assertEqual(found.faults["false_negative"], found.contacts)
        self.assertEqual(found.asked, 200)
        for finding in found.findings:
            self.assertTrue(np.array_equal(finding.x_t0, x[0, finding.index]))
        self.assertEqual(noli.audit_ccd(exact, {"edge_edge": (x[0], x[1])}, exact=True).verdict, "no_finding")

    def test_the_truth_is_out_of_reach(self):
        def vandal(pair, a, b):
            a[:] = 0
            b[:] = 0
            return np.ones(len(a), bool)

        self.assertGreater(noli.fuzz_queries(vandal, count=2000, exact=True, shrink=False).faults["false_positive"], 0)

    def test_same_seed_same_queries(self):
        asked = []

        def remember(pair, a, b):
            asked.append(a.copy())
            return hits(pair, a, b)

        for _ in range(2):
            noli.fuzz_queries(remember, count=1000, seed=9)
        half = len(asked) // 2
        self.assertTrue(all(np.array_equal(a, b) for a, b in zip(asked[:half], asked[half:])))

    def test_nothing_to_ask(self):
        with self.assertRaises(noli.UsageError):
            noli.fuzz_queries(lambda pair, x_t0, x_t1: np.zeros(len(x_t0), bool), count=0)
        with self.assertRaises(noli.UsageError):
            noli.audit_ccd(lambda pair, x_t0, x_t1: np.zeros(len(x_t0), bool), {})

    def test_bad_answers(self):
        for answers in (lambda pair, a, b: np.zeros(len(a), int), lambda *_: True, lambda pair, a, b: np.zeros(3), lambda pair, a, b: np.full(len(a), "no")):
            with self.assertRaises(noli.InputError):
                noli.fuzz_queries(answers, count=100)
        with self.assertRaises(ZeroDivisionError):
            noli.fuzz_queries(lambda *_: 1 / 0, count=100)
        for wrong in ({}, {"count": 5, "pairs": []}, {"seconds": -1}, {"count": 5, "max_findings": -1}):
            with self.assertRaises(noli.UsageError):
                noli.fuzz_queries(exact, **wrong)
        self.assertEqual(noli.fuzz_queries(exact, seconds=0).asked, 0)
        self.assertEqual(noli.fuzz_queries(exact, count=5, pairs="edge_edge").asked, 5)
        with self.assertRaises(noli.UsageError):
            noli.audit_ccd(exact, (np.zeros((1, 4, 3)), np.zeros((1, 4, 3))))
