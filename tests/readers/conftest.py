"""A grid in every format, and what it truly is: its `.gridshell` file and its schedules.

The command and the folder of the validator come in the variables GRIDSHELL and GRIDSHELL_NODE.
"""

import csv
import json
import os
import subprocess
from types import SimpleNamespace

import numpy
import pytest

FORMATS = "gridshell obj ply stl off glb dxf csv compas.json vtu saf.xlsx ifc tcl".split()


def gridshell(folder, *args):
    """Run the command; gives its result."""
    return subprocess.run(
        [os.environ["GRIDSHELL"], *args], cwd=folder, check=True, capture_output=True, text=True
    )


def table(path):
    """The rows of a schedule as dictionaries."""
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def column(rows, name):
    return numpy.array([float(row[name]) for row in rows])


@pytest.fixture(scope="session", params=["saddle", "dome"])
def made(request, tmp_path_factory):
    """All files of one grid, and the truth about it."""
    folder = tmp_path_factory.mktemp(request.param)
    length = {"saddle": "3", "dome": "2"}[request.param]
    outputs = [part for end in FORMATS for part in ("-o", f"a.{end}")]
    args = ["--effort", "draft", "--seed", "7", "-l", length, "--json", *outputs]
    run = gridshell(folder, "generate", request.param, *args)
    truth = json.loads((folder / "a.gridshell").read_text())
    return SimpleNamespace(
        folder=folder,
        run=json.loads(run.stdout),
        truth=truth,
        xyz=numpy.array(truth["nodes"]),
        panels=numpy.array(truth["panels"]),
        nodes=table(folder / "a.nodes.csv"),
        members=table(folder / "a.members.csv"),
        plates=table(folder / "a.panels.csv"),
        summary={row["figure"]: row["value"] for row in table(folder / "a.summary.csv")},
    )


@pytest.fixture
def ends(made):
    return numpy.array([[int(m["node 1"]), int(m["node 2"])] for m in made.members])


@pytest.fixture
def lengths(made):
    return column(made.members, "length [m]")
