"""The command quality on a million quads: elements per second, and how much memory it takes.

Each run is a process of its own, from its start to its end; CPU time and peak are its own and its worker's.
"""

import os
import subprocess
import sys
from time import perf_counter

import pytest

from hullquad.formats import write_mesh

QUADS = 1_000_000
MIB = 1024
"""In the unit that Linux counts memory by."""


@pytest.fixture(scope="module")
def million(shaken_grid, tmp_path_factory):
    """A file with a million quads; the kernels are compiled."""
    path = tmp_path_factory.mktemp("million") / "million.vtu"
    write_mesh(shaken_grid(400), path)
    run(path, "--csv", "-")
    write_mesh(shaken_grid(QUADS), path)
    return path


def run(path, *options):
    """Seconds, seconds of CPU and MiB that the command takes, and the lines that it prints."""
    command = [sys.executable, "-m", "hullquad", "quality", str(path), *options]
    start = perf_counter()
    with subprocess.Popen(command, stdout=subprocess.PIPE) as running:
        lines = sum(chunk.count(b"\n") for chunk in iter(lambda: running.stdout.read(1 << 20), b""))
        _, status, usage = os.wait4(running.pid, 0)
        running.returncode = os.waitstatus_to_exitcode(status)
    assert running.returncode == 0
    return perf_counter() - start, usage.ru_utime + usage.ru_stime, usage.ru_maxrss / MIB, lines


@pytest.mark.parametrize(
    "options",
    [(), ("--json",), ("--rules", "csr_fine"), ("--csv", "-"), ("--csv", "-", "--rules", "csr_fine")],
    ids=lambda options: " ".join(options) or "summary",
)
def test_a_million_quads(million, options, capsys):
    seconds, cpu, peak, lines = run(million, *options)
    with capsys.disabled():
        rate = QUADS / seconds / 1000
        figures = f"{seconds:.1f} s (CPU {cpu:.1f} s), {rate:.0f} thousand elements/s, peak {peak:.0f} MiB"
        print(f"\nquality {' '.join(options)}: {figures}")
    assert lines == QUADS + 1 or "--csv" not in options
