#!/usr/bin/env python3
"""Universal Files written by pyuff, and what pyuff reads in one that the crate wrote.

    pip install pyuff            # 2.5.8 was used; neither the crate nor its tests need it
    python3 golden/formats/universal_generate.py

Writes universal_*.unv with pyuff, reads them again with pyuff and stores what it finds in universal_expected.toml, with
universal_written.unv, which the tests of the crate wrote, among them.
"""

import pathlib
import warnings

import numpy as np
import pyuff

HERE = pathlib.Path(__file__).resolve().parent
HEADER = dict(type=151, model_name="wing", description="ground vibration test", db_app="none", program="none",
              date_db_created="03-May-26", time_db_created="10:00:00", version_db1=0, version_db2=0, file_type=0,
              date_db_saved="03-May-26", time_db_saved="10:00:00", date_file_written="03-May-26", time_file_written="10:00:00")
UNITS = dict(type=164, units_code=7, units_description="Inch (pound f)", temp_mode=1,
             length=39.37007874015748, force=0.224808943099710, temp=1.8, temp_offset=459.67)
NODES = [1, 4, 12, 7]
DRAW = np.random.default_rng(1987)


def nodes(kind):
    """Four nodes, the first at coordinates that begin with -1."""
    places = np.array([[-1.0, -1.0, -1.0], [0.0, 52.5, 3.125], [8.0, -1.5e-4, 1.0e5], [-100.25, 0.1, -2.0]])
    zeros = [0] * len(NODES)
    return dict(type=kind, node_nums=NODES, def_cs=zeros, disp_cs=zeros, color=zeros, x=places[:, 0], y=places[:, 1], z=places[:, 2])


def line():
    return dict(type=82, trace_num=1, color=0, id="outline", nodes=np.array([1, 4, 12, 0, 7, 1, 12, 4, 7, 1]))


def mode(number, count=3, **more):
    """A mode with nothing in y, and nothing in rx if there are rotations."""
    values = {f"r{d}": np.zeros(4) if d in (2, 4) else DRAW.normal(size=4) for d in range(1, count + 1)}
    entry = dict(type=55, analysis_type=2, data_ch=count // 3 + 1, spec_data_type=8, load_case=0, mode_n=number,
                 freq=[12.5, 17.875, 33.25][number - 1], node_nums=NODES)
    return {**entry, **values, **more}


def complex_mode(number, conjugate=False):
    turn = np.exp(0.7j * number)
    values = {f"r{d}": turn * (DRAW.normal(size=4) + 0.2j * DRAW.normal(size=4)) for d in (1, 3)}
    values["r2"] = np.zeros(4, complex)
    root = [-1.5 + 75.0j, -3.25 + 130.0j][number - 1]
    more = dict(values, analysis_type=3, eig=root)
    entry = mode(number, **more)
    del entry["freq"]
    if conjugate:
        entry.update({name: entry[name].conj() for name in ("r1", "r2", "r3")}, eig=root.conjugate())
    return entry


FILES = {
    "real": [HEADER, UNITS, nodes(15), line(), mode(1), mode(2), mode(3)],
    "six": [UNITS, nodes(2411), mode(1, 6), mode(2, 6)],
    "complex": [HEADER, nodes(15), complex_mode(1), complex_mode(2), complex_mode(2, conjugate=True)],
    "moving": [nodes(15), mode(1, spec_data_type=11), mode(2, spec_data_type=12),
               mode(3, analysis_type=5, freq_step_n=1)],
    "written": None,
}


def listed(name, values):
    return f"{name} = [{', '.join(repr(v) for v in np.asarray(values).tolist())}]\n"


def answer(name, datasets):
    """What pyuff reads, as TOML."""
    text = f"[{name}]\n"
    for entry in datasets:
        kind = entry["type"]
        if kind == 164:
            text += f"units = {entry['units_description'].strip()!r}\n"
    for entry in datasets:
        kind = entry["type"]
        if kind in (15, 2411):
            text += f"\n[[{name}.nodes]]\n" + listed("numbers", [int(n) for n in entry["node_nums"]])
            text += "".join(listed(axis, entry[axis]) for axis in "xyz")
        elif kind == 82:
            text += f"\n[[{name}.traces]]\n" + listed("nodes", [int(n) for n in entry["nodes"]])
        elif kind == 55:
            text += f"\n[[{name}.modes]]\nanalysis = {entry['analysis_type']}\nkind = {entry['spec_data_type']}\n"
            root = entry["eig"] if "eig" in entry else complex(entry["freq"])
            text += f"root = [{root.real!r}, {root.imag!r}]\n" + listed("nodes", entry["node_nums"])
            count = entry["n_data_per_node"]
            values = np.array([entry[f"r{d}"] for d in range(1, count + 1)])
            text += f"real = {values.real.tolist()!r}\nimaginary = {values.imag.tolist()!r}\n"
    return text


def main():
    text = "# Written by universal_generate.py: what pyuff reads in the files universal_*.unv.\n\n"
    for name, datasets in FILES.items():
        path = HERE / f"universal_{name}.unv"
        if datasets is not None:
            pyuff.UFF(str(path)).write_sets(datasets, "overwrite")
        found = pyuff.UFF(str(path)).read_sets()
        text += answer(name, found) + "\n"
    (HERE / "universal_expected.toml").write_text(text)


if __name__ == "__main__":
    warnings.simplefilter("error", RuntimeWarning)
    main()
