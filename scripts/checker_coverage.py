# SPDX-License-Identifier: Apache-2.0
"""Reads what `llvm-cov export` writes, and counts the answers of the conditions in proofs/checker that were never given.

A condition in a template or in a header is there once for each instance: an answer counts if one of them gave it.
"""
import json
import os
import sys


def main():
    answers = {}  # (file, line, column, which answer): how often
    for function in json.load(sys.stdin)["data"][0]["functions"]:
        for line, column, _, _, yes, no, which, *_ in function.get("branches", []):
            name = function["filenames"][which]
            if "proofs/checker/" not in name:
                continue
            for answer, count in (("true", yes), ("false", no)):
                place = (os.path.basename(name), line, column, answer)
                answers[place] = answers.get(place, 0) + count
    missed = sorted(place for place, count in answers.items() if count == 0)
    for name, line, column, answer in missed:
        print(f"{name}:{line}:{column}: never {answer}")
    print(f"{len(answers) - len(missed)} of {len(answers)} branches")
    return 0 if answers else 1


if __name__ == "__main__":
    sys.exit(main())
