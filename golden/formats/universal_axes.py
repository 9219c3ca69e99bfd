"""Writes universal_axes.unv with pyuff 2.5.8: nodes in coordinate systems of datasets 18 and 2420, and a mode there."""

from pathlib import Path

import numpy as np
import pyuff

HERE = Path(__file__).parent
path = HERE / "universal_axes.unv"
path.unlink(missing_ok=True)
out = pyuff.UFF(str(path))
nodes = [1, 2, 3]
turned = np.array([[0.6, 0.8, 0.0], [-0.8, 0.6, 0.0], [0.0, 0.0, 1.0], [10.0, 20.0, 30.0]])
out.write_sets(
    [
        pyuff.prepare_2420(
            Part_UID=1, Part_Name="wing", CS_sys_labels=[7], CS_types=[0], CS_colors=[8], CS_names=["CS7"],
            CS_matrices=[turned],
        ),
        pyuff.prepare_15(
            node_nums=nodes, def_cs=[0, 7, 7], disp_cs=[7, 0, 7], color=[1, 1, 1],
            x=[1.0, 1.0, 0.0], y=[2.0, 2.0, 5.0], z=[3.0, 3.0, 0.0],
        ),
        pyuff.prepare_55(
            model_type=1, id1="NONE", id2="NONE", id3="NONE", id4="NONE", id5="NONE", analysis_type=2, data_ch=2,
            spec_data_type=8, data_type=2, load_case=0, mode_n=1, freq=12.5, modal_m=0, modal_damp_vis=0.0,
            modal_damp_his=0.0, node_nums=nodes, r1=[1.0, 2.0, 3.0], r2=[0.5, 0.25, 0.0], r3=[0.0, -1.0, 0.125],
        ),
    ],
    "add",
)
