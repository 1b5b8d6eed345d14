#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Breaks small good proofs in many ways; all checkers have to say the same of each of them.

    run_mutants.py --noli NOLI --harness HARNESS --checker NOLI_CHECK [--verified CHECKER] --count N [--seed S] [--first K] -o FOLDER

Mutant k of a seed is the same whenever it is made by the same corpus, which `noli` writes anew each time. The C++ checker runs inside
of HARNESS (audit/fuzz/check_host/check_host.cpp), each thousandth mutant as a process too; the verified checker is a process always, and left out where there is
none. slow_check.py is asked
whenever another accepts or refutes, and for some of the others. A finding is kept in FOLDER/findings with the commands that show it.
Exits 1 when there is one.

What this does not do: a mistake that all checkers share is not found.
"""
import argparse
import collections
import json
import os
import random
import shutil
import struct
import subprocess
import sys
import time

import corpus
import mutate
import slow_check
import slow_files

BATCH = 500


def own_claim(proof):
    """The words that ask for just what a proof claims: it is judged by that. None where it has no claim."""
    try:
        claim = slow_check.Claim(next(slow_files.groups(proof, b"PROF"))[0][0][1])
    except Exception:  # whatever it is, the checkers say so
        return []
    fields = [f"strict={int(claim.strict)}", f"points={int(claim.points)}", f"distance={claim.eta:.17g}", f"ring={claim.ring}",
              f"merged={len(claim.merged)}", "empty"]
    if claim.source < 2:
        fields += ["motion=" + ("linear", "rest")[claim.source], f"dimension={claim.dimension}"]
        excluded = ",".join(f"{a}-{b}" for a, b in claim.excluded)
        if excluded and len(excluded) < 200:
            fields.append("excluded=" + excluded)
    if claim.merged or any(field.startswith("excluded=") for field in fields):
        fields.append("cells=" + claim.cells_hash.hex())
    return [word for field in fields for word in ("--require", field)]


def name_bytes(name):
    name = name.encode()
    return bytes([len(name)]) + name


class Checkers:
    """Records for the harness, and its answers; it is started again after a crash."""

    def __init__(self, arguments, folder):
        self.arguments, self.folder, self.process = arguments, folder, None

    def write(self, name, data):
        return b"F" + name_bytes(name) + struct.pack("<I", len(data)) + data

    def run(self, names):
        return b"R" + bytes([len(names)]) + b"".join(map(name_bytes, names))

    def execute(self, program, names):
        """The exit code of a program in a process of its own; 128 and the signal, if one ended it."""
        code = subprocess.run([os.path.abspath(program), *names], cwd=self.folder, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL).returncode
        return code if code >= 0 else 128 - code

    def answers(self, records, count):
        """The answers to a batch; fewer, if the checker crashed in the harness."""
        if self.process is None:
            self.process = subprocess.Popen([os.path.abspath(self.arguments.harness), self.folder], stdin=subprocess.PIPE, stdout=subprocess.PIPE)
        try:
            self.process.stdin.write(b"".join(records))
            self.process.stdin.flush()
        except BrokenPipeError:
            pass
        found = self.process.stdout.read(count)
        if len(found) < count:
            self.process.wait()
            self.process = None
        return found


class Campaign:
    def __init__(self, arguments):
        self.arguments = arguments
        self.folder = os.path.join(arguments.output, "work")
        self.findings = os.path.join(arguments.output, "findings")
        os.makedirs(self.folder, exist_ok=True)
        self.cases = corpus.corpus(os.path.abspath(arguments.noli), self.folder)
        self.taken = [mutate.Taken(case) for case in self.cases]
        self.choices = [c for c, case in enumerate(self.cases) for _ in range(2 if case.extension == "blocks" else 1)]
        self.checkers = Checkers(arguments, self.folder)
        self.counts = collections.Counter()
        self.kinds = collections.defaultdict(collections.Counter)
        self.found = 0
        for c, case in enumerate(self.cases):
            for i, data in enumerate(case.files):
                with open(os.path.join(self.folder, f"c{c}-{i}.{case.extension}"), "wb") as file:
                    file.write(data)

    def make(self, k):
        """Mutant k of the seed; those below 0 are the good proofs as they are."""
        if k < 0:
            return -k - 1, "as it is", self.cases[-k - 1].proof, None
        rng = random.Random(f"{self.arguments.seed}/{k}")
        c = rng.choice(self.choices)
        kinds, proof, files = mutate.mutant(rng, self.taken[c], self.taken)
        return c, kinds, proof, files

    def batch(self, begin, end):
        records, programs, made = [], [], []
        for k in range(begin, end):
            c, kinds, proof, files = self.make(k)
            case, slot = self.cases[c], k - begin
            names = [f"p{slot}.noli"] + [f"{f'c{c}' if files is None else f'm{slot}'}-{i}.{case.extension}"
                                         for i in range(len(case.files if files is None else files))]
            records.append(self.checkers.write(names[0], proof))
            words = own_claim(proof) + names
            if files is not None:
                records += [self.checkers.write(name, data) for name, data in zip(names[1:], files)]
            records.append(self.checkers.run(words))
            if k % 1000 == 0:
                programs.append((slot, "process", self.arguments.checker, words))
            if self.arguments.verified and (k < 0 or k % self.arguments.verified_every == 0):
                programs.append((slot, "verified", self.arguments.verified, words))
            made.append((c, kinds, proof, files, names))
        answers = self.checkers.answers(records, len(made))
        codes = [{"checker": code} for code in answers]
        crashed = len(answers)
        if crashed < len(made):
            codes.append({"checker": 255})
        for slot, who, program, words in programs:
            if slot < crashed:
                codes[slot][who] = self.checkers.execute(program, words)
        for slot in range(min(crashed + 1, len(made))):
            self.judge(begin + slot, made[slot], codes[slot])
        return begin + min(crashed + 1, len(made))

    def judge(self, k, made, codes):
        c, kinds, proof, files, _ = made
        slow = None
        if k < 0:
            slow, words = self.cases[c].code, "a good proof"
            codes["slow"] = slow
        elif any(code in (0, 1) for code in codes.values()) or k % self.arguments.slow_every == 0:
            slow, words = self.slow(proof, self.cases[c].files if files is None else files)
            codes["slow"] = slow
        self.counts["mutants" if k >= 0 else "good proofs"] += 1
        for who in codes:
            self.counts[who] += 1
        self.counts[f"all say {codes['checker']}" if len(set(codes.values())) == 1 else "differ"] += 1
        for kind in kinds.split("+"):
            self.kinds[kind][codes["checker"]] += 1
        if len(set(codes.values())) > 1 or codes["checker"] not in (0, 1, 3):
            self.keep(k, made, codes, words if slow is not None else "")

    @staticmethod
    def slow(proof, files):
        try:
            return slow_check.check(proof, files)
        except Exception as error:  # as its main() does
            return 3, f"rejected: {error!r}"

    def keep(self, k, made, codes, words):
        c, kinds, proof, files, names = made
        self.found += 1
        print(f"mutant {k} of {self.cases[c].name}: {kinds}: {codes} {words}", flush=True)
        if self.found > self.arguments.keep:
            return
        folder = os.path.join(self.findings, f"{self.arguments.seed}-{k}")
        os.makedirs(folder, exist_ok=True)
        for name, data in zip(names, [proof, *(self.cases[c].files if files is None else files)]):
            with open(os.path.join(folder, name), "wb") as file:
                file.write(data)
        with open(os.path.join(folder, "README"), "w", encoding="utf-8") as file:
            file.write(f"{self.cases[c].name}: {kinds}\n{codes}\n{words}\n\n")
            file.write(f"In this folder:\n  noli_check {' '.join(own_claim(proof) + names)}\n  slow_check.py {' '.join(names)}\n")
            if self.arguments.verified:
                file.write(f"  noli_check_verified {' '.join(own_claim(proof) + names)}\n")
            file.write(f"The same mutant again:\n  scripts/mutate-proofs 1 {self.arguments.seed} {k}\n")

    def save(self, spent, k):
        self.counts["seconds"] = round(spent, 1)
        with open(os.path.join(self.arguments.output, f"summary-{self.arguments.seed}.json"), "w", encoding="utf-8") as file:
            json.dump({"counts": self.counts, "next": k, "kinds": self.kinds}, file, indent=1)

    def run(self):
        shown = started = time.monotonic()
        first = k = self.arguments.first
        end = first + self.arguments.count
        self.batch(-len(self.cases), 0)
        while k < end and (self.arguments.seconds is None or time.monotonic() - started < self.arguments.seconds):
            k = self.batch(k, min(k + BATCH, end))
            if time.monotonic() - shown > 30:
                shown = time.monotonic()
                print(f"{k - first} mutants, {(k - first) / (shown - started):.0f} a second, {self.found} findings", flush=True)
                self.save(shown - started, k)
        spent = time.monotonic() - started
        self.save(spent, k)
        for kind, codes in sorted(self.kinds.items()):
            print(f"  {kind:24} accepted {codes[0]:7}  refuted {codes[1]:7}  rejected {codes[3]:7}")
        print(", ".join(f"{what} {number}" for what, number in self.counts.items()))
        print(f"{self.counts['mutants']} mutants of {len(self.cases)} proofs, {self.counts['mutants'] / max(spent, 1e-9):.0f} a second, "
              f"{self.found} findings")
        shutil.rmtree(self.folder)
        return 1 if self.found else 0


def main():
    parser = argparse.ArgumentParser(description="All checkers have to say the same of broken proofs")
    parser.add_argument("--noli", required=True)
    parser.add_argument("--harness", required=True)
    parser.add_argument("--checker", required=True)
    parser.add_argument("--verified")
    parser.add_argument("--verified-every", type=int, default=1)
    parser.add_argument("--slow-every", type=int, default=20)
    parser.add_argument("--count", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--first", type=int, default=0)
    parser.add_argument("--seconds", type=float)
    parser.add_argument("--keep", type=int, default=100)
    parser.add_argument("-o", "--output", required=True)
    arguments = parser.parse_args()
    if arguments.verified and not os.path.exists(arguments.verified):
        print(f"without the verified checker: there is no {arguments.verified}")
        arguments.verified = None
    return Campaign(arguments).run()


if __name__ == "__main__":
    sys.exit(main())
