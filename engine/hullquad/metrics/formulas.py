"""Which formula each row of the table has."""

from collections.abc import Callable

from hullquad.metrics import ansys, solvers, table_1
from hullquad.metrics.element import Element
from hullquad.metrics.expression import Number
from hullquad.metrics.row import Metric

Formula = Callable[[Element], Number]
CornerFormula = Callable[[Element], list[Number]]

_FORMULAS: dict[str, Formula] = {
    "stretch": table_1.stretch,
    "aspect_ratio": table_1.aspect_ratio,
    "scaled_jacobian": table_1.scaled_jacobian,
    "shape": table_1.shape,
    "skew": table_1.skew,
    "min_angle": table_1.min_angle,
    "max_angle": table_1.max_angle,
    "taper": table_1.taper,
    "warpage": table_1.warpage,
    "condition": table_1.condition,
    "shear": table_1.shear,
    "relative_size": table_1.relative_size,
    "shear_and_size": table_1.shear_and_size,
    "shape_and_size": table_1.shape_and_size,
    "distortion": table_1.distortion,
    "ansys_aspect_ratio": ansys.aspect_ratio,
    "ansys_jacobian_ratio": ansys.jacobian_ratio,
    "ansys_warping_factor": ansys.warping_factor,
    "ansys_parallel_deviation": ansys.parallel_deviation,
    "ansys_max_corner_angle": table_1.max_angle,
    "ansys_skewness": ansys.skewness,
    "nastran_skew": solvers.nastran_skew,
    "nastran_taper": solvers.nastran_taper,
    "nastran_warp": solvers.nastran_warp,
    "warp_angle": solvers.warp_angle,
    "optistruct_skew": solvers.optistruct_skew,
    "patran_aspect_ratio": ansys.aspect_ratio,
    "verdict_aspect_ratio": solvers.verdict_aspect_ratio,
    "cubit_aspect_ratio": solvers.cubit_aspect_ratio,
    "longest_edge": solvers.longest_edge,
    "corner_angle": solvers.corner_angle,
    "abaqus_shape_factor": solvers.abaqus_shape_factor,
}
_OTHER_FOR_TRIANGLES: dict[str, Formula] = {"patran_aspect_ratio": solvers.patran_triangle_aspect_ratio}

# what each corner has, of metrics that the table says are of corners
OF_CORNERS: dict[str, CornerFormula] = {
    "scaled_jacobian": table_1.scaled_jacobians,
    "shape": table_1.shapes,
    "min_angle": lambda element: element.interior_angles,
    "max_angle": lambda element: element.interior_angles,
    "condition": table_1.conditions,
    "shear": table_1.shears,
    "distortion": table_1.distortions,
    "ansys_max_corner_angle": lambda element: element.interior_angles,
    "ansys_skewness": table_1.deviations,
    "nastran_taper": solvers.nastran_tapers,
    "corner_angle": lambda element: element.interior_angles,
}
_OF_QUAD_CORNERS = {"shape", "condition"}


def value(metric: Metric, element: Element) -> Number:
    """The metric of an element; the shape of a triangle where the metric has no form for it."""
    if element.count == 4:
        return _FORMULAS[metric.key](element)
    judge = metric.triangle_metric
    return _OTHER_FOR_TRIANGLES.get(judge.key, _FORMULAS[judge.key])(element)


def corner_values(metric: Metric, element: Element) -> list[Number]:
    """What each corner has by itself; nothing for triangles whose form is not of corners."""
    if element.count == 3 and (metric.triangles is None or metric.key in _OF_QUAD_CORNERS):
        return []
    return OF_CORNERS[metric.key](element)
