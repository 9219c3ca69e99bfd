#!/usr/bin/env python3
"""Makes outer_loop.toml: correlations with NASTRAN-95 as the finite element analysis of the outer loop.

    python3 golden/nastran95/outer_loop.py [PROGRAM]

It runs `corfem cases` with `--solver nastran95 --format json` (PROGRAM, or what cargo builds of
this project) and keeps what the tests compare with. NASTRAN-95 is looked for as README.md says. A run takes a few seconds.
"""

import json
import pathlib
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ARGUMENTS = ["--solver", "nastran95", "--format", "json"]


def numbers(values):
    return "[" + ", ".join(repr(value) for value in values) + "]"


def answer(*command):
    program = sys.argv[1:] or ["cargo", "run", "--quiet", "--release", "--"]
    done = subprocess.run([*program, *command, *ARGUMENTS], cwd=HERE.parents[1], check=True, capture_output=True, text=True)
    return json.loads(done.stdout)


def check(found):
    """Frequencies and errors of an exact solution."""
    return [
        f"frequencies_hz = {numbers(found['frequencies_hz'])}",
        f"frequency_rms = {found['frequency_rms']!r}",
        f"shape_rms = {found['shape_rms']!r}",
    ]


def cases():
    lines = [
        "# The paper's four cases by `corfem cases --solver nastran95`: inner loop in the crate, every finite element analysis,",
        "# that of the test modes too, in NASTRAN-95 (PyPI wheel nastran95 0.3). Written by outer_loop.py; see README.md.",
        "# Hz, in; errors as fractions.",
    ]
    for case in answer("cases", "--quiet")["cases"]:
        run = case["correlation"]
        lines += ["", "[[case]]", f"number = {case['case']}", f"test_frequencies_hz = {numbers(run['test_frequencies_hz'])}"]
        lines += ["", "[case.initial]", f"gages_in = {numbers(case['first_gages_in'])}", *check(run["initial"])]
        for done, gages in zip(run["passes"], case["pass_gages_in"]):
            lines += ["", "[[case.passes]]", f"iterations = {done['iterations']}"]
            lines += [f"gages_in = {numbers(gages)}", *check(done["exact"])]
    return lines


def main():
    (HERE / "outer_loop.toml").write_text("\n".join(cases()) + "\n")


if __name__ == "__main__":
    main()
