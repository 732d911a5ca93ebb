"""The table of quality metrics; their compiled kernels are loaded on first use (`hullquad.metrics.values`)."""

from math import degrees

import attrs

from hullquad.errors import HullquadError

DEGREES = "°"


@attrs.frozen
class Metric:
    """One row of the table: what a metric is called, how it is read and when it is acceptable."""

    key: str
    title: str
    formula: str
    """In words and signs, for people."""
    low: float
    """Least value on convex elements."""
    high: float
    """Greatest value on convex elements."""
    ideal: float
    band: tuple[float, float]
    """Acceptable values of quads."""
    higher_is_better: bool
    unit: str
    triangle_band: tuple[float, float] | None
    """Acceptable values of triangles; None where a triangle has no such metric and is judged by its shape."""
    source: str

    @property
    def limit(self) -> float:
        """The end of the band at which quads begin to fail."""
        return self.band[0] if self.higher_is_better else self.band[1]

    @property
    def triangle_metric(self) -> "Metric":
        """What triangles are judged by: this metric, or shape where it has no form for triangles."""
        return self if self.triangle_band is not None else metric("shape")

    @property
    def triangle_limit(self) -> float:
        """The end of the band at which triangles begin to fail."""
        judge = self.triangle_metric
        assert judge.triangle_band is not None  # shape has one
        return judge.triangle_band[0] if judge.higher_is_better else judge.triangle_band[1]

    @property
    def triangle_ideal(self) -> float:
        """Value of the equilateral triangle."""
        return 60.0 if self.unit == DEGREES else self.triangle_metric.ideal

    @property
    def darkest(self) -> float:
        """Value that is drawn as the worst there is: that of an element which is only just valid."""
        if self.higher_is_better:
            return max(self.low, 0.0)
        return 180.0 if self.unit == DEGREES else self.high

    @property
    def scale(self) -> float:
        """Factor from the kernels' value to the shown one: angles are radians inside."""
        return degrees(1) if self.unit == DEGREES else 1.0


UNBOUNDED = float("inf")
_KNIAT = "Kniat, Table 1"

# key, title, formula, low, high, ideal, acceptable, higher is better, unit, acceptable of triangles, source
_TABLE_1 = (
    ("stretch", "Stretch", "√2 · shortest edge / longest diagonal",
     0, 1, 1, (0.25, 1), True, "", None, _KNIAT),
    ("aspect_ratio", "Aspect ratio", "longest edge / shortest edge",
     1, UNBOUNDED, 1, (1, 4), False, "", (1, 4), _KNIAT),
    ("scaled_jacobian", "Scaled Jacobian", "least corner Jacobian / lengths of the two edges meeting there",
     -1, 1, 1, (0.5, 1), True, "", (0.2, 1), _KNIAT + ", Eq. (1)"),
    ("shape", "Shape", "least of 2 · corner Jacobian / sum of the squares of the two edges there",
     0, 1, 1, (0.3, 1), True, "", (0.25, 1), _KNIAT),
    ("skew", "Skew", "4 / sum over the corners of 1 / sin angle",
     0, 1, 1, (0.5, 1), True, "", None, _KNIAT + "; Knupp, FEAD 39:217 (2003)"),
    ("min_angle", "Min. angle", "smallest interior angle",
     0, 90, 90, (45, 90), True, DEGREES, (30, 60), _KNIAT),
    ("max_angle", "Max. angle", "largest interior angle",
     90, 360, 90, (90, 135), False, DEGREES, (60, 90), _KNIAT),
)  # fmt: skip

METRICS: tuple[Metric, ...] = tuple(Metric(*row) for row in _TABLE_1)

_BY_KEY = {row.key: row for row in METRICS}


def metric(key: str) -> Metric:
    """The table's row with that key; an error that names the nearest ones where there is none."""
    try:
        return _BY_KEY[key]
    except KeyError:
        raise HullquadError("E_METRIC", key, known=", ".join(_BY_KEY)) from None
