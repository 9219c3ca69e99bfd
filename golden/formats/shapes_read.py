"""Prints as JSON what another program reads in a Universal File of shapes: python3 shapes_read.py FILE pyuff|sdynpy

Nodes with their places, the nodes of the trace line, every frequency, and the shapes by node, six components or three.
"""
import json
import os
import sys

file, reader = sys.argv[1:]
if reader == "pyuff":
    import pyuff

    sets = pyuff.UFF(file).read_sets()
    of = {kind: [one for one in sets if one["type"] == kind] for kind in (2420, 2411, 82, 55)}
    nodes, lines, modes = of[2411][0], of[82], of[55]
    assert of[2420][0]["CS_types"] == [0]
    answer = {
        "nodes": {str(int(node)): place for node, *place in zip(nodes["node_nums"], nodes["x"], nodes["y"], nodes["z"])},
        "line": [int(node) for node in lines[0]["nodes"]],
        "frequencies_hz": [mode["freq"] for mode in modes],
        "shapes": [
            {str(int(node)): list(values) for node, *values in zip(mode["node_nums"], *(mode[f"r{part + 1}"] for part in range(mode["n_data_per_node"])))}
            for mode in modes
        ],
    }
else:
    os.environ["QT_QPA_PLATFORM"] = "offscreen"
    from sdynpy.core.sdynpy_geometry import Geometry
    from sdynpy.core.sdynpy_shape import ShapeArray
    from sdynpy.fileio.sdynpy_uff import readuff

    sets = readuff(file)
    frame, modes = Geometry.from_uff(sets), ShapeArray.from_uff(sets)
    assert list(frame.coordinate_system.id) == [1]

    def at_nodes(mode):
        """Components by node; a coordinate is a node and a direction from 1."""
        values = {}
        for coordinate, value in zip(mode.coordinate, mode.shape_matrix):
            assert coordinate["direction"] == len(values.setdefault(str(int(coordinate["node"])), [])) + 1
            values[str(int(coordinate["node"]))].append(float(value.real))
        return values

    answer = {
        "nodes": {str(int(node)): [float(number) for number in place] for node, place in zip(frame.node.id, frame.node.coordinate)},
        "line": [int(node) for node in frame.traceline.connectivity[0]],
        "frequencies_hz": [float(mode.frequency) for mode in modes],
        "shapes": [at_nodes(mode) for mode in modes],
    }
print(json.dumps(answer, default=float))
