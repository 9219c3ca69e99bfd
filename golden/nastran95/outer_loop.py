#!/usr/bin/env python3
"""Makes outer_loop.toml: the paper's cases with NASTRAN-95 as the finite element analysis of the outer loop.

    python3 golden/nastran95/outer_loop.py [PROGRAM]

It runs `corfem cases --solver nastran95 --format json` (PROGRAM, or what cargo builds of this project) and keeps what the
tests compare with. NASTRAN-95 is looked for as README.md says. A run takes a few seconds.
"""

import json
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ARGUMENTS = ["cases", "--solver", "nastran95", "--format", "json", "--quiet"]


def numbers(values):
    return "[" + ", ".join(repr(value) for value in values) + "]"


def main():
    program = sys.argv[1:] or ["cargo", "run", "--quiet", "--release", "--"]
    done = subprocess.run(program + ARGUMENTS, cwd=HERE.parents[1], check=True, capture_output=True, text=True)
    lines = [
        "# The paper's four cases by `corfem cases --solver nastran95`: inner loop in the crate, every finite element analysis,",
        "# that of the test modes too, in NASTRAN-95 (PyPI wheel nastran95 0.3). Written by outer_loop.py; see README.md.",
        "# Hz, in; errors as fractions.",
    ]
    for case in json.loads(done.stdout)["cases"]:
        lines += ["", "[[case]]", f"number = {case['case']}", f"test_frequencies_hz = {numbers(case['test_frequencies_hz'])}"]
        start = case["initial"]
        lines += ["", "[case.initial]"]
        for kept, found in [("initial", start)] + [("passes", found) for found in case["passes"]]:
            if kept == "passes":
                lines += ["", "[[case.passes]]", f"iterations = {found['iterations']}"]
            lines += [
                f"gages_in = {numbers(found['gages_in'])}",
                f"frequencies_hz = {numbers(found['frequencies_hz'])}",
                f"frequency_rms = {found['frequency_rms']!r}",
                f"shape_rms = {found['shape_rms']!r}",
            ]
    (HERE / "outer_loop.toml").write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
