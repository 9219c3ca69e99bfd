"""What a command costs: processor seconds and most memory of the installed program on wings of growing size.

    cargo build --release
    python3 benches/commands.py FOLDER [--corfem target/release/corfem] [SIZE ...]

Every wing (1k, 10k, 100k: 1,458, 10,098, 100,116 degrees of freedom) is that of paper/studies/known/wing.rs as a deck, with the job of
correcting 25 groups of elements from ten modes at 108 sensors; its test is computed from a deck of other gages by the program. A size
each50, each100 or each1000 is the smallest wing with as many single elements as parameters. It prints a line for every command.
"""

import json
import math
import os
import pathlib
import subprocess
import sys

BAYS = {"1k": (27, 8, 1), "10k": (99, 16, 1), "100k": (309, 53, 1)}
SORTS = ["covers", "spar webs", "rib webs", "spanwise caps", "posts"]
ZONES = 5
FACTORS = [1, 1.2, 0.8, 1.1, 0.75, 1, 1.3, 0.9]
ALONG, AFT, UP, NONE = (1, 0, 0), (0, 1, 0), (0, 0, 1), (0, 0, 0)


class Wing:
    """Grids and elements in bays along the span, lines of grids aft and levels up."""

    def __init__(self, bays):
        self.bays, (self.ribs, self.lines, self.levels) = bays, (bays[0], bays[1] + 1, bays[2] + 1)
        self.elements = list(self.members())
        near = lambda k, parts, of: (2 * k * of + parts) // (2 * parts)
        self.points = [(near(k, 27, bays[0]), near(j, 3, bays[1]), 1) for k in range(1, 28) for j in range(4)]

    def grid(self, place):
        return 1 + place[2] + self.levels * (place[1] + self.lines * place[0])

    def position(self, place):
        out, aft, up = (place[axis] / self.bays[axis] for axis in range(3))
        y, chord = 300 * out, 80 + (32 - 80) * out
        aft, up = chord * (aft - 0.5), chord * 0.12 * (up - 0.5)
        sine, cosine = math.sin(math.radians(-3) * out), math.cos(math.radians(-3) * out)
        return y * math.tan(math.radians(25)) + cosine * aft + sine * up, y, cosine * up - sine * aft

    def members(self):
        """Sort, bay, card, grids and size of every element."""
        posts = self.lines * self.levels
        kinds = [
            (0, "CQDMEM", ALONG, AFT, 0.08),
            (1, "CSHEAR", ALONG, UP, 0.54 / self.lines),
            (2, "CSHEAR", AFT, UP, 1.08 / self.ribs),
            (3, "CROD", ALONG, NONE, 5.4 / posts),
            (4, "CROD", AFT, NONE, 5.4 / (self.ribs * self.levels)),
            (4, "CROD", UP, NONE, 24.3 / (self.ribs * self.lines)),
        ]
        for sort, card, one, other, size in kinds:
            step = self.bays[2] if card == "CQDMEM" else 1
            for bay in range(self.ribs):
                for line in range(self.lines - one[1] - other[1]):
                    for level in range(0, self.levels - one[2] - other[2], step):
                        first = (bay + 1 - one[0], line, level)
                        at = lambda m, n: self.grid([first[a] + m * one[a] + n * other[a] for a in range(3)])
                        ring = [(0, 0), (1, 0)] if card == "CROD" else [(0, 0), (1, 0), (1, 1), (0, 1)]
                        yield sort, bay, card, [at(*corner) for corner in ring], size

    def deck(self, factors):
        """The deck with groups of elements of these factors, and the properties of every group."""
        lines, properties = ["BEGIN BULK", "MAT1,1,1.04+7,4.0+6,.3,2.6-4"], {}
        for rib in range(self.ribs + 1):
            held = "123456" if rib == 0 else "456"
            for line in range(self.lines):
                for level in range(self.levels):
                    x, y, z = self.position((rib, line, level))
                    grid = self.grid((rib, line, level))
                    lines.append(f"GRID*   {grid:<16d}{'':16s}{x:<16.9f}{y:<16.9f}*\n*       {z:<16.9f}{'':16s}{held:<16s}")
        cards = {"CROD": "PROD*   ", "CSHEAR": "PSHEAR* ", "CQDMEM": "PQDMEM* "}
        for label, (sort, bay, card, grids, size) in enumerate(self.elements, 1):
            group = sort * ZONES + bay * ZONES // self.ribs
            if (group, card, size) not in properties:
                properties[group, card, size] = len(properties) + 1
                lines.append(f"{cards[card]}{len(properties):<16d}{1:<16d}{size * factors[group]:<16.10f}")
            own = ",".join(map(str, grids)) + (",0." if card == "CQDMEM" else "")
            lines.append(f"{card},{label},{properties[group, card, size]},{own}")
        mass = 6 / len(self.points)
        lines += [f"CONM2,{10_000_000 + j},{self.grid(point)},,{mass:.6f}" for j, point in enumerate(self.points)]
        return "\n".join([*lines, "ENDDATA", ""]), properties


def write(folder, program, size):
    """The job of a size: model.bdf, test.csv, job.toml."""
    folder.mkdir(parents=True, exist_ok=True)
    wing, single = Wing(BAYS.get(size, BAYS["1k"])), size.startswith("each")
    model, properties = wing.deck([1] * 5 * ZONES)
    (folder / "model.bdf").write_text(model)
    (folder / "truth.bdf").write_text(wing.deck([FACTORS[group % 8] for group in range(5 * ZONES)])[0])
    arguments = [program, "modes", "-q", "-c", "10", "-f", "json", str(folder / "truth.bdf")]
    truth = json.loads(subprocess.run(arguments, capture_output=True, text=True, check=True).stdout)
    row = {(dof["grid"], dof["direction"]): place for place, dof in enumerate(truth["dof"])}
    rows = [row[wing.grid(point), "z"] for point in wing.points]
    shapes = [[shape[row] for row in rows] for shape in truth["shapes"]]
    largest = [max(shape, key=abs) for shape in shapes]
    lines = ["frequency_hz,,,,,,," + ",".join(f"{hertz:.15g}" for hertz in truth["frequencies_hz"])]
    lines.append("grid,name,direction,sign,x,y,z," + ",".join(f"mode {mode}" for mode in range(1, 11)))
    for j, point in enumerate(wing.points):
        values = ",".join(f"{shape[j] / size:.12g}" for shape, size in zip(shapes, largest))
        place = ",".join(f"{value:.6f}" for value in wing.position(point))
        lines.append(f'{wing.grid(point)},"P{j + 1}",z,+,{place},{values}')
    (folder / "test.csv").write_text("\n".join([*lines, ""]))
    if single:
        rules = [f'[[parameter]]\nname = "e"\nelements = ["1-{size[4:]}"]\neach = true\n']
    else:
        groups = {}
        for (group, _, _), label in properties.items():
            groups.setdefault(group, []).append(label)
        name = lambda group: f"{SORTS[group // ZONES]} {group % ZONES + 1}"
        rules = [f'[[parameter]]\nname = "{name(group)}"\nproperties = {groups[group]}\n' for group in sorted(groups)]
    job = 'title = "wing"\n[model]\ndeck = "model.bdf"\n[test]\nfile = "test.csv"\n'
    (folder / "job.toml").write_text(job + "".join(rules))


def cost(arguments):
    """Processor seconds, and the most memory in MB, of a command."""
    child = os.fork()
    if child == 0:
        os.dup2(os.open(os.devnull, os.O_WRONLY), 1)
        os.dup2(os.open(os.devnull, os.O_WRONLY), 2)
        os.execvp(arguments[0], arguments)
    _, status, usage = os.wait4(child, 0)
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024, os.waitstatus_to_exitcode(status)


def main(arguments):
    program = str(pathlib.Path(__file__).resolve().parent.parent / "target" / "release" / "corfem")
    if "--corfem" in arguments:
        place = arguments.index("--corfem")
        program = arguments[place + 1]
        del arguments[place : place + 2]
    folder, sizes = pathlib.Path(arguments[0]), arguments[1:] or ["1k", "10k", "each50", "each100", "each1000"]
    for size in sizes:
        write(folder / size, program, size)
        job, model = str(folder / size / "job.toml"), str(folder / size / "model.bdf")
        commands = [["check", job], ["correlate", job]]
        if size in BAYS:
            commands.insert(0, ["modes", "-q", "-c", "20", model])
        for command in commands:
            seconds, memory, status = min(cost([program, *command]) for _ in range(1 if size == "100k" else 3))
            print(f"{size}: {command[0]}: {seconds:.2f} s, {memory:.0f} MB, status {status}", flush=True)


if __name__ == "__main__":
    main(sys.argv[1:])
