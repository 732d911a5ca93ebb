"""The rows of the table of metrics, in the order in which they are listed."""

from math import inf

from hullquad.metrics.row import DEGREES, Metric, Scale, Sense

HIGHER, LOWER, NEARER = Sense
TABLE_1 = "Kniat, Table 1"

_Ends = tuple[float, float, float, tuple[float, float]]
_Row = tuple[str, str, str, Sense, str, _Ends, _Ends | None, str]

# key, title, formula, sense, unit, (low, high, ideal, acceptable) of quads, the same of triangles, source
_TABLE_1: tuple[_Row, ...] = (
    ("stretch", "Stretch", "√2 · shortest edge / longest diagonal",
     HIGHER, "", (0, 1, 1, (0.25, 1)), None, TABLE_1),
    ("aspect_ratio", "Aspect ratio", "longest edge / shortest edge",
     LOWER, "", (1, inf, 1, (1, 4)), (1, inf, 1, (1, 4)), TABLE_1),
    ("scaled_jacobian", "Scaled Jacobian", "least corner Jacobian / lengths of the two edges meeting there",
     HIGHER, "", (-1, 1, 1, (0.5, 1)), (-1, 1, 1, (0.2, 1)), TABLE_1 + ", Eq. (1)"),
    ("shape", "Shape", "least of 2 · corner Jacobian / sum of the squares of the two edges there",
     HIGHER, "", (0, 1, 1, (0.3, 1)), (0, 1, 1, (0.25, 1)), TABLE_1),
    ("skew", "Skew", "4 / sum over the corners of 1 / sin angle",
     HIGHER, "", (0, 1, 1, (0.5, 1)), None, TABLE_1 + "; Knupp, FEAD 39:217 (2003)"),
    ("min_angle", "Min. angle", "smallest interior angle",
     HIGHER, DEGREES, (0, 90, 90, (45, 90)), (0, 60, 60, (30, 60)), TABLE_1),
    ("max_angle", "Max. angle", "largest interior angle",
     LOWER, DEGREES, (90, 360, 90, (90, 135)), (60, 360, 60, (60, 90)), TABLE_1),
)  # fmt: skip


def _rows(group: str, table: tuple[_Row, ...]) -> tuple[Metric, ...]:
    return tuple(
        Metric(
            key,
            title,
            formula,
            sense,
            unit,
            Scale(*quads),
            None if triangles is None else Scale(*triangles),
            source,
            group,
        )
        for key, title, formula, sense, unit, quads, triangles, source in table
    )


METRICS: tuple[Metric, ...] = _rows(TABLE_1, _TABLE_1)

SHAPE = next(row for row in METRICS if row.key == "shape")
"""By what triangles are judged where a metric has no form for them."""
