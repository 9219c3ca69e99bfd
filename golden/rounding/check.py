"""Runs the cases and jobs with arithmetic that rounds toward zero and downward, and demands the same integers, names and words.

    python3 golden/rounding/check.py target/debug/corfem      (Linux with a C compiler, cc)

Numbers with a decimal point may differ: they are results of arithmetic, and the library that reads and writes them rounds to nearest.
Everything else is a decision, and one that another rounding turns hangs on round-off. Two things are left out:

- tests/jobs/garteur, whose passes hang on it: from pass 4 on they creep along a place where pairs of modes change, and the digits of an
  analysis decide after 8, 13 or 16 passes that steps end, by `wall` or by `short`. Its answer is the same.
- the JSON of tests/jobs/garteur_joints, which counts one analysis more toward zero: a last step whose fall is round-off.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

HERE = pathlib.Path(__file__).parent
JOBS = HERE.parent.parent / "tests" / "jobs"
NUMBER = re.compile(r"[-+−]?\d*\.\d+(?:[eE][-+]?\d+)?|[-+]?\d+[eE][-+]?\d+")
# A difference of equals is -0 where arithmetic rounds downward.
ZERO = re.compile(r"(?<![\w.])[-−]0(?![\w.])")


def commands():
    yield from (["cases", "--all"], ["cases", "--format", "json"], ["fewer-modes"])
    for name in ("box", "building", "wing"):
        job = str(JOBS / name / "job.toml")
        yield from (["check", job], ["correlate", job], ["correlate", job, "--format", "json"])
    yield ["correlate", str(JOBS / "garteur_joints" / "job.toml")]


def decisions(text):
    """Words and integers, whatever the width of columns and lines."""
    return ZERO.sub("0", NUMBER.sub("#", text)).replace("─", "").split()


def main(program):
    with tempfile.TemporaryDirectory() as folder:
        library = str(pathlib.Path(folder) / "rounding.so")
        subprocess.run(["cc", "-shared", "-fPIC", "-o", library, str(HERE / "rounding.c"), "-lm"], check=True)
        failures, counted, moved = [], 0, {"zero": 0, "down": 0}
        for command in commands():
            found = {}
            for way in ("nearest", "zero", "down"):
                run = subprocess.run([program, *command, "--quiet"], capture_output=True, text=True,
                                     env=os.environ | {"LD_PRELOAD": library, "CORFEM_ROUNDING": way})
                found[way] = f"exit status {run.returncode}\n{run.stdout}{run.stderr}"
            nearest = decisions(found["nearest"])
            for way in ("zero", "down"):
                moved[way] += found[way] != found["nearest"]
                other = decisions(found[way])
                counted += len(other)
                if other != nearest:
                    at = next((i for i, (a, b) in enumerate(zip(nearest, other)) if a != b), min(len(nearest), len(other)))
                    failures.append(f"{' '.join(command)}, rounding {way}: {' '.join(other[at - 6:at + 6])}\n  to nearest: {' '.join(nearest[at - 6:at + 6])}")
    # The JSON of four commands has all digits of what it says.
    assert min(moved.values()) >= 4, f"digits of {moved} commands differ: the library was not loaded"
    print(f"{counted} words and integers compared")
    sys.exit("\n".join(failures) or None)


if __name__ == "__main__":
    main(sys.argv[1])
