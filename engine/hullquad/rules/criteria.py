"""Limits that a user has set, metric by metric, as a file: ``hullquad criteria`` version 1, in JSON.

::

    {"format": "hullquad criteria", "version": 1, "bands": {"stretch": [0.25, null], "corner_angle": [45, 135]}}
"""

import json
from functools import partial
from pathlib import Path

from hullquad.documents.entry import Entry, Field, anything, whole
from hullquad.metrics import METRICS, Band
from hullquad.rules.document import VERSION, band, choice, content, opened, written

FORMAT = "hullquad criteria"

Criteria = dict[str, Band]
"""What is acceptable, by the key of the metric."""


def read_criteria(path: Path) -> Criteria:
    """The limits in a file.

    Raises
    ------
    FileError, RuleError
        The file cannot be read, or something in it is wrong: the first fault, `others` telling how many more.
    """
    return opened(content(path), str(path), FORMAT, _criteria)


def write_criteria(criteria: Criteria, path: Path) -> None:
    """Put the limits into a file, in the order of the table of metrics.

    Raises
    ------
    FileError
        The file cannot be written; an existing one is as it was.
    """
    from hullquad.formats import atomic  # noqa: PLC0415  brings SciPy and Shapely

    bands = {row.key: written(criteria[row.key]) for row in METRICS if row.key in criteria}
    document = {"format": FORMAT, "version": VERSION, "bands": bands}
    atomic.write(path, (json.dumps(document, indent=1) + "\n").encode())


def _criteria(entry: Entry) -> Criteria:
    table = {"format": Field(anything), "version": Field(anything), "bands": Field(_bands, "E_RULE")}
    bands: Criteria = whole(entry, table)["bands"]
    return bands


def _bands(entry: Entry) -> Criteria:
    if not isinstance(entry.value, dict):
        raise entry.refused("E_TYPE", "object", shown=entry.shown)
    return whole(entry, {key: Field(partial(_band, key)) for key in entry.value})


def _band(key: str, entry: Entry) -> Band:
    choice(Entry(key, entry.place, entry.faults), [row.key for row in METRICS], "E_MEASURE")
    return band(entry)
