"""The rows of the table of metrics, in the order in which they are listed."""

from math import inf

from hullquad.metrics.row import DEGREES, MILLIMETRES, Metric, Scale, Sense

HIGHER, LOWER, NEARER = Sense

_Ends = tuple[float, float, float, tuple[float, float]]
_Row = tuple[str, str, str, Sense, str, _Ends, _Ends | None, str]

TABLE_1 = "Kniat, Table 1"
ANSYS = "ANSYS"
SOLVERS = "Solvers and class rules"
_CUBIT = "; triangles: Cubit"
_ANSYS_THEORY = "Ansys Theory Reference 12.1, Element Shape Testing"
_SHPP = _ANSYS_THEORY + "; limit: SHPP"
_ALTAIR = "Altair, Element Quality Calculations: "


# key, title, formula, sense, unit, (low, high, ideal, acceptable) of quads, the same of triangles, source
_TABLE_1: tuple[_Row, ...] = (
    ("stretch", "Stretch", "√2 · shortest edge / longest diagonal",
     HIGHER, "", (0, 1, 1, (0.25, 1)), None, TABLE_1),
    ("aspect_ratio", "Aspect ratio", "longest edge / shortest edge",
     LOWER, "", (1, inf, 1, (1, 4)), (1, inf, 1, (1, 4)), TABLE_1),
    ("scaled_jacobian", "Scaled Jacobian", "least corner Jacobian / lengths of the two edges meeting there",
     HIGHER, "", (-1, 1, 1, (0.5, 1)), (-1, 1, 1, (0.2, 1)), TABLE_1 + ", Eq. (1)" + _CUBIT),
    ("shape", "Shape", "least of 2 · corner Jacobian / sum of the squares of the two edges there (1 / condition no.)",
     HIGHER, "", (0, 1, 1, (0.3, 1)), (0, 1, 1, (0.25, 1)), TABLE_1 + _CUBIT),
    ("skew", "Skew", "4 / sum over the corners of 1 / sin angle",
     HIGHER, "", (0, 1, 1, (0.5, 1)), None, TABLE_1 + "; Knupp, FEAD 39:217 (2003)"),
    ("min_angle", "Min. angle", "smallest interior angle",
     HIGHER, DEGREES, (0, 90, 90, (45, 90)), (0, 60, 60, (30, 60)), TABLE_1 + _CUBIT),
    ("max_angle", "Max. angle", "largest interior angle",
     LOWER, DEGREES, (90, 360, 90, (90, 135)), (60, 360, 60, (60, 90)), TABLE_1 + _CUBIT),
    ("taper", "Taper", "difference between opposite edges / shorter of the two principal axes",
     LOWER, "", (0, inf, 0, (0, 0.7)), None, TABLE_1 + "; Verdict"),
    ("warpage", "Warpage", "cosine of the largest fold along a diagonal",
     HIGHER, "", (-1, 1, 1, (0.9, 1)), None, TABLE_1),
    ("condition", "Condition no.",
     "largest of the sum of the squares of two edges / 2 · corner Jacobian there (1 / shape)",
     LOWER, "", (1, inf, 1, (1, 4)), (1, inf, 1, (1, 1.3)), TABLE_1 + _CUBIT),
    ("shear", "Shear", "scaled Jacobian, 0 where that is negative",
     HIGHER, "", (0, 1, 1, (0.3, 1)), None, TABLE_1),
    ("relative_size", "Relative size", "area / mean area, or its inverse: the lesser",
     HIGHER, "", (0, 1, 1, (0.3, 1)), (0, 1, 1, (0.25, 1)), TABLE_1 + _CUBIT),
    ("shear_and_size", "Shear & size", "shear · relative size",
     HIGHER, "", (0, 1, 1, (0.2, 1)), None, TABLE_1),
    ("shape_and_size", "Shape & size", "shape · relative size",
     HIGHER, "", (0, 1, 1, (0.2, 1)), (0, 1, 1, (0.25, 1)), TABLE_1 + _CUBIT),
    ("distortion", "Distortion", "least corner Jacobian / area",
     HIGHER, "", (-inf, 1, 1, (0.6, 1)), None, TABLE_1),
)  # fmt: skip

_ANSYS: tuple[_Row, ...] = (
    ("ansys_aspect_ratio", "Aspect ratio (ANSYS)",
     "longer side / shorter of the most stretched rectangle through the mid-points of the edges",
     LOWER, "", (1, inf, 1, (1, 20)), (1, inf, 1, (1, 20)), _SHPP),
    ("ansys_jacobian_ratio", "Jacobian ratio (ANSYS)", "largest corner Jacobian / least",
     LOWER, "", (1, inf, 1, (1, 30)), None, _SHPP),
    ("ansys_warping_factor", "Warping factor (ANSYS)", "height of an edge's ends off each other / √ projected area",
     LOWER, "", (0, inf, 0, (0, 1)), None, _SHPP),
    ("ansys_parallel_deviation", "Parallel deviation (ANSYS)", "largest angle between two opposite edges",
     LOWER, DEGREES, (0, 180, 0, (0, 70)), None, _SHPP),
    ("ansys_max_corner_angle", "Max. corner angle (ANSYS)", "largest interior angle",
     LOWER, DEGREES, (90, 360, 90, (90, 155)), (60, 360, 60, (60, 165)), _SHPP),
    ("ansys_skewness", "Skewness (ANSYS)", "largest deviation of an interior angle from 90° (60°) / greatest possible",
     LOWER, "", (0, 1, 0, (0, 0.75)), (0, 1, 0, (0, 0.75)), "Ansys Meshing: Skewness, fair up to 0.75"),
)  # fmt: skip

_SOLVERS: tuple[_Row, ...] = (
    ("nastran_skew", "Skew (Nastran)",
     "angle between the lines of mid-points of opposite edges; triangles: smallest angle",
     HIGHER, DEGREES, (0, 90, 90, (30, 90)), (0, 60, 60, (10, 60)), "MSC/NX Nastran GEOMCHECK Q4_SKEW, T3_SKEW"),
    ("nastran_taper", "Taper (Nastran)", "largest |triangle at a corner / half of the area − 1| (1 − distortion)",
     LOWER, "", (0, 1, 0, (0, 0.5)), None, "MSC/NX Nastran GEOMCHECK Q4_TAPER"),
    ("nastran_warp", "Warp (Nastran)", "distance of a node from the mean plane / mean length of the diagonals",
     LOWER, "", (0, inf, 0, (0, 0.05)), None, "MSC/NX Nastran GEOMCHECK Q4_WARP"),
    ("warp_angle", "Warp angle (OptiStruct)", "larger angle between the two triangles of either split",
     LOWER, DEGREES, (0, 180, 0, (0, 30)), None, "OptiStruct CQUAD4 element check; Autodesk Nastran, HyperMesh"),
    ("optistruct_skew", "Skew (OptiStruct)",
     "90° − angle between the lines of mid-points of opposite edges; triangles: of a median and the mid-line across it",
     LOWER, DEGREES, (0, 90, 0, (0, 60)), (0, 90, 0, (0, 75)), "OptiStruct CQUAD4, CTRIA3 element check"),
    ("patran_aspect_ratio", "Aspect ratio (Patran)", "as ANSYS; triangles: largest of √3/2 · side / height on it",
     LOWER, "", (1, inf, 1, (1, 5)), (1, inf, 1, (1, 5)), _ALTAIR + "Patran"),
    ("verdict_aspect_ratio", "Aspect ratio (Verdict)", "longest edge · sum of edges / 4 · area; triangles: 4√3 · area",
     LOWER, "", (1, inf, 1, (1, 4)), (1, inf, 1, (1, 1.3)), "Verdict manual; VTK AspectRatio; limits: Cubit"),
    ("cubit_aspect_ratio", "Aspect ratio (Cubit)", "longer principal axis / shorter",
     LOWER, "", (1, inf, 1, (1, 4)), None, "Cubit, aspect ratio (Robinson); VTK MaxEdgeRatio"),
    ("longest_edge", "Longest edge", "length of the longest edge",
     LOWER, MILLIMETRES, (0, inf, 0, (0, 50)), (0, inf, 0, (0, 50)), "CSR BC&OT Pt 1 Ch 7 Sec 3: 50 × 50 mm"),
    ("corner_angle", "Corner angle", "interior angle farthest from 90°; triangles: from 60°",
     NEARER, DEGREES, (0, 360, 90, (45, 135)), (0, 360, 60, (30, 120)), "CSR BC&OT Pt 1 Ch 7 Sec 3 [4.3]"),
    ("abaqus_shape_factor", "Shape factor (Abaqus)",
     "area of a triangle / area of the equilateral one with its circumscribed circle; quads: 1",
     HIGHER, "", (0, 1, 1, (0.01, 1)), (0, 1, 1, (0.01, 1)), "Abaqus/CAE, Verify mesh"),
)  # fmt: skip

_OF_CORNERS = {
    "scaled_jacobian", "shape", "min_angle", "max_angle", "condition", "shear", "distortion", "ansys_max_corner_angle",
    "ansys_skewness", "nastran_taper", "corner_angle",
}  # fmt: skip
_SIGNED = {"scaled_jacobian", "distortion"}
_REFLEX = {"max_angle", "ansys_max_corner_angle", "corner_angle"}


def _rows(group: str, table: tuple[_Row, ...]) -> tuple[Metric, ...]:
    return tuple(
        Metric(
            key=key,
            title=title,
            formula=formula,
            sense=sense,
            unit=unit,
            quads=Scale(*quads),
            triangles=None if triangles is None else Scale(*triangles),
            source=source,
            group=group,
            is_of_corners=key in _OF_CORNERS,
            invalid=_invalid(key, sense),
        )
        for key, title, formula, sense, unit, quads, triangles, source in table
    )


def _invalid(key: str, sense: Sense) -> tuple[float, float]:
    """Between what the raw value of an invalid element is kept: never better than the worst valid one."""
    if key in _SIGNED:
        return -inf, 0.0
    if key in _REFLEX:
        return 180.0, inf
    if key == "warpage":  # that of valid quads is below 0 as well, where they are folded by more than 90°
        return -1.0, -1.0
    return (0.0, 0.0) if sense is HIGHER else (inf, inf)


METRICS: tuple[Metric, ...] = _rows(TABLE_1, _TABLE_1) + _rows(ANSYS, _ANSYS) + _rows(SOLVERS, _SOLVERS)

SHAPE = next(row for row in METRICS if row.key == "shape")
"""By what triangles are judged where a metric has no form for them."""
