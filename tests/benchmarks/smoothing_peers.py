"""What other programs make of a mesh by moving its free nodes: Gmsh, MFEM and SciPy, behind one door.

They come from the dependency group ``peers``; the product never imports them.
"""

from collections.abc import Callable
from time import perf_counter

import attrs
import numpy as np

from hullquad.mesh import Mesh
from hullquad.metrics import metric
from hullquad.metrics.values import raw_values, value_gradients
from hullquad.topology import half_edges

Moved = tuple[Mesh, float]
"""The mesh afterwards, and the seconds that moving took: what was made ready before is not counted."""


def rim(mesh: Mesh) -> np.ndarray:
    """(H, 2) nodes of the sides that have an element on one side only, in its direction."""
    sides, _ = half_edges(mesh.topology.elements)
    known = {tuple(side) for side in sides.tolist()}
    return np.array([side for side in sides.tolist() if (side[1], side[0]) not in known])


def loops(sides: np.ndarray) -> list[list[int]]:
    """Rows of the sides that follow each other, loop by loop."""
    after = {int(start): row for row, (start, _) in enumerate(sides)}
    left, found = set(range(len(sides))), []
    while left:
        row, loop = min(left), []
        while row in left:
            left.remove(row)
            loop.append(row)
            row = after[int(sides[row, 1])]
        found.append(loop)
    return found


def gmsh_optimized(mesh: Mesh, method: str, times: int) -> Moved:
    """Gmsh's `optimize` on a plane surface bounded by the rim."""
    import gmsh

    gmsh.initialize(readConfigFiles=False)
    try:
        gmsh.option.setNumber("General.Verbosity", 0)
        gmsh.option.setNumber("General.NumThreads", 1)
        points = _fill_gmsh(gmsh, mesh)
        start = perf_counter()
        gmsh.model.mesh.optimize(method, True, times)
        seconds = perf_counter() - start
        tags, places, _ = gmsh.model.mesh.getNodes()
        points[tags.astype(int) - 1] = places.reshape(-1, 3)
    finally:
        gmsh.finalize()
    return mesh.with_parameters(points[:, :2]), seconds


def _fill_gmsh(gmsh, mesh: Mesh) -> np.ndarray:
    """Give a mesh to Gmsh, every rim side a line of its own; (N, 3) points."""
    points = np.concatenate([mesh.parameters, np.zeros((len(mesh.points), 1))], axis=1)
    sides = rim(mesh)
    on_rim = np.unique(sides)
    for node in on_rim.tolist():
        gmsh.model.geo.addPoint(*points[node], 0.0, node + 1)
    for row, (start, end) in enumerate(sides.tolist()):
        gmsh.model.geo.addLine(start + 1, end + 1, row + 1)
    curves = [gmsh.model.geo.addCurveLoop([row + 1 for row in loop]) for loop in loops(sides)]
    gmsh.model.geo.addPlaneSurface(curves, 1)
    gmsh.model.geo.synchronize()
    inner = np.setdiff1d(np.arange(len(points)), on_rim)
    for node in on_rim.tolist():
        gmsh.model.mesh.addNodes(0, node + 1, [node + 1], points[node])
    flat = gmsh.model.getParametrization(2, 1, points[inner].ravel())
    gmsh.model.mesh.addNodes(2, 1, inner + 1, points[inner].ravel(), flat)
    tag = 1
    for row, side in enumerate(sides.tolist()):
        gmsh.model.mesh.addElementsByType(row + 1, 1, [tag], [node + 1 for node in side])
        tag += 1
    for kind, elements in ((3, mesh.topology.quads), (2, mesh.topology.triangles)):
        if len(elements):
            gmsh.model.mesh.addElementsByType(1, kind, np.arange(tag, tag + len(elements)), (elements + 1).ravel())
            tag += len(elements)
    return points


def mfem_optimized(mesh: Mesh) -> Moved:
    """MFEM's TMOP: shape metric 2 towards ideal shapes, by Newton's method with MINRES."""
    from mfem import ser as mfem
    from mfem._ser import tmop, tmop_tools

    grid = _mfem_mesh(mfem, mesh)
    space = mfem.FiniteElementSpace(grid, mfem.H1_FECollection(1, 2), 2)
    grid.SetNodalFESpace(space)
    nodes, count = mfem.GridFunction(space), space.GetNDofs()
    grid.SetNodalGridFunction(nodes)
    ideal, shape = tmop.TargetConstructor(tmop.TargetConstructor.IDEAL_SHAPE_UNIT_SIZE), tmop.TMOP_Metric_002()
    ideal.SetNodes(nodes)
    rules = mfem.IntegrationRules(0, mfem.Quadrature1D.GaussLobatto)
    integrator = tmop.TMOP_Integrator(shape, ideal)
    integrator.SetIntegrationRules(rules, 8)
    form = mfem.NonlinearForm(space)
    form.AddDomainIntegrator(integrator)
    held = np.flatnonzero(~mesh.topology.is_free)
    form.SetEssentialVDofs(mfem.intArray([*held.tolist(), *(held + count).tolist()]))
    linear = mfem.MINRESSolver()
    linear.SetMaxIter(100)
    linear.SetRelTol(1e-12)
    newton = tmop_tools.TMOPNewtonSolver(rules.Get(space.GetFE(0).GetGeomType(), 8), 0)
    newton.SetIntegrationRules(rules, 8)
    newton.SetPreconditioner(linear)
    newton.SetMaxIter(50)
    newton.SetRelTol(1e-8)
    newton.SetPrintLevel(-1)
    newton.SetOperator(form)
    start = perf_counter()
    newton.Mult(mfem.Vector(), nodes)
    seconds = perf_counter() - start
    values = nodes.GetDataArray()
    return mesh.with_parameters(mesh.target_size * np.stack([values[:count], values[count:]], axis=1)), seconds


def _mfem_mesh(mfem, mesh: Mesh):
    elements = mesh.topology.elements
    grid = mfem.Mesh(2, len(mesh.points), len(elements), 0, 2)
    for x, y in (mesh.parameters / mesh.target_size).tolist():
        grid.AddVertex(x, y)
    for element in elements.tolist():
        if element[3] < 0:
            grid.AddTri(element[:3], 1)
        else:
            grid.AddQuad(element, 1)
    grid.FinalizeMesh(0, False)
    grid.SetCurvature(1, False, -1, mfem.Ordering.byNODES)
    return grid


def scipy_optimized(mesh: Mesh, key: str) -> Moved:
    """SciPy's L-BFGS-B on the exact sum of a metric, with our gradients."""
    from scipy.optimize import minimize

    row, quads = metric(key), mesh.topology.quads
    free = np.flatnonzero(mesh.topology.is_free)
    points = np.concatenate([mesh.parameters, np.zeros((len(mesh.points), 1))], axis=1)
    up = np.array([[0.0, 0.0, 1.0]])

    def loss(unknowns: np.ndarray) -> tuple[float, np.ndarray]:
        points[free, :2] = unknowns.reshape(-1, 2)
        values, gradients = value_gradients(row, points, quads, up)
        total = np.zeros_like(points)
        np.add.at(total, quads, gradients)
        return -float(values.sum()), -total[free, :2].ravel()

    raw_values(row, points, quads, up)
    loss(points[free, :2].ravel())
    start = perf_counter()
    found = minimize(loss, points[free, :2].ravel(), jac=True, method="L-BFGS-B", options={"maxiter": 500})
    seconds = perf_counter() - start
    places = np.array(mesh.parameters)
    places[free] = found.x.reshape(-1, 2)
    return mesh.with_parameters(places), seconds


@attrs.frozen
class Peer:
    """A program, or one way of it."""

    name: str
    package: str
    move: Callable[[Mesh], Moved]


PEERS = (
    Peer("Gmsh Laplace2D", "gmsh", lambda mesh: gmsh_optimized(mesh, "Laplace2D", 10)),
    Peer("Gmsh Relocate2D", "gmsh", lambda mesh: gmsh_optimized(mesh, "Relocate2D", 10)),
    Peer("Gmsh UntangleMeshGeometry", "gmsh", lambda mesh: gmsh_optimized(mesh, "UntangleMeshGeometry", 1)),
    Peer("MFEM TMOP", "mfem", mfem_optimized),
    Peer("SciPy L-BFGS-B, stretch", "scipy", lambda mesh: scipy_optimized(mesh, "stretch")),
)
