"""Corrects a model given by arrays with the program corfem, which must be on the path or named. Needs numpy alone."""
import json
import pathlib
import subprocess
import tempfile

import numpy as np


def market(matrix):
    """A matrix in Matrix Market's array format, every number to its last digit."""
    matrix = np.asarray(matrix)
    numbers = "\n".join(f"{value:.17g}" for value in matrix.T.ravel())
    return f"%%MatrixMarket matrix array real general\n{matrix.shape[0]} {matrix.shape[1]}\n{numbers}\n"


def correct(stiffness, mass, parts, frequencies_hz, shapes, sensors, entries="", program="corfem"):
    """The result of a correlation as `paper/json.md` describes it, with the exit status and with the arrays `factors`, `standard_deviations`
    (where an interval tells them) and `test_hz`.

    `parts` are the matrices of the parameters by name, `shapes` (sensors x modes) the test's at the rows `sensors` of the matrices,
    and `entries` more lines of the job, such as '[compare]\\nshape_deviation = 0.01'.
    """
    files = {"stiffness.mtx": market(stiffness), "mass.mtx": market(mass)}
    files["rows.csv"] = "grid,direction\n" + "".join(f"{row + 1},x\n" for row in range(len(stiffness)))
    modes = ",".join(f"mode {mode + 1}" for mode in range(len(frequencies_hz)))
    rows = [(f"{row + 1},x", shape) for row, shape in zip(sensors, shapes)]
    table = "".join(head + "".join(f",{value:.17g}" for value in values) + "\n" for head, values in [("frequency_hz,", frequencies_hz), *rows])
    files["test.csv"] = f"grid,direction,{modes}\n{table}"
    job = '[model]\nstiffness = "stiffness.mtx"\nmass = "mass.mtx"\nrows = "rows.csv"\n[test]\nfile = "test.csv"\n'
    for at, (name, part) in enumerate(parts.items()):
        files[f"part_{at}.mtx"] = market(part)
        job += f"[[parameter]]\nname = {json.dumps(name)}\nmatrix = \"part_{at}.mtx\"\n"
    with tempfile.TemporaryDirectory() as folder:
        for name, text in {**files, "job.toml": job + entries}.items():
            pathlib.Path(folder, name).write_text(text)
        run = subprocess.run([program, "correlate", "-q", "job.toml", "--folder", "out"], cwd=folder, capture_output=True, text=True)
        found = pathlib.Path(folder, "out/correlation.json")
        if not found.exists():
            raise ValueError(run.stderr + run.stdout)
        result = json.loads(found.read_text())
    def column(kind, name):
        return np.array([row[name] for row in result[kind]], float)
    factors = column("parameters", "factor")
    told = np.where(np.isnan(column("parameters", "low")), np.nan, column("parameters", "deviation_percent"))
    return result | {"status": run.returncode, "factors": factors, "standard_deviations": 0.01 * factors * told, "test_hz": column("modes", "test_hz")}


def scatter(tests, frequencies_hz, shapes, seed=0, frequency=0.005, shape=0.02, **job):
    """The factors (tests x parameters) of as many noisy tests, drawn from a seed with these standard deviations of a frequency and of a
    shape's largest component; `job` has the other arguments of `correct`."""
    draw, found = np.random.default_rng(seed), []
    for _ in range(tests):
        hertz = frequencies_hz * (1 + frequency * draw.standard_normal(len(frequencies_hz)))
        noisy = shapes + shape * np.abs(shapes).max(axis=0) * draw.standard_normal(shapes.shape)
        found.append(correct(frequencies_hz=hertz, shapes=noisy, **job)["factors"])
    return np.array(found)


if __name__ == "__main__":
    # Two masses on two springs, of which the second was built half as stiff again.
    springs = [np.array([[1.0, 0], [0, 0]]), np.array([[1.0, -1], [-1, 1]])]
    values, shapes = np.linalg.eigh(300 * springs[0] + 450 * springs[1])
    parts = {"wall": 300 * springs[0], "link": 300 * springs[1]}
    job = dict(stiffness=sum(parts.values()), mass=np.eye(2), parts=parts, sensors=[0, 1], program=__import__("sys").argv[1])
    test = dict(frequencies_hz=np.sqrt(values) / (2 * np.pi), shapes=shapes)
    found = correct(**job, **test)
    print(*np.round(found["factors"], 6), found["status"])
    spread = scatter(20, **job, **test).std(axis=0)
    print(*(np.round(spread / found["standard_deviations"], 1)))
