"""Gridshell's own file, and the schedules."""

import numpy
from conftest import column, gridshell


def test_schedules_agree_with_the_grid(made, ends, lengths):
    assert len(made.nodes) == len(made.xyz) == made.run["quality"]["nodes"]
    assert len(made.members) == made.run["quality"]["members"]
    assert len(made.plates) == len(made.panels) == made.run["quality"]["panels"]
    xyz = numpy.stack([column(made.nodes, f"{x} [m]") for x in "xyz"], axis=1)
    assert (xyz == made.xyz).all()
    apart = numpy.linalg.norm(xyz[ends[:, 1]] - xyz[ends[:, 0]], axis=1)
    assert numpy.allclose(apart, lengths, rtol=0, atol=1e-9)
    supports = {k for k, node in enumerate(made.nodes) if node["support"] == "1"}
    assert supports == set(made.truth["supports"])
    assert supports == {k for k, node in enumerate(made.nodes) if node["boundary"] == "1"}


def test_schedules_name_seed_version_and_units(made):
    assert made.summary["seed"] == "7"
    assert made.summary["gridshell version"] == made.run["version"]
    assert abs(float(made.summary["length total"]) - made.run["figures"]["length"]["total"]) < 1e-9


def test_a_run_can_be_repeated_and_converted(made):
    gridshell(made.folder, "generate", "a.gridshell", "-o", "b.gridshell")
    again = (made.folder / "b.gridshell").read_bytes()
    assert again == (made.folder / "a.gridshell").read_bytes()
    gridshell(made.folder, "convert", "a.gridshell", "-o", "c.gridshell", "-o", "c.ifc", "-o", "c.obj")
    for end in ["gridshell", "ifc", "obj"]:
        assert (made.folder / f"c.{end}").read_bytes() == (made.folder / f"a.{end}").read_bytes(), end
