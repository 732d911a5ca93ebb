"""Every sentence that the engine says of an error, by code (and case): the table that gets translated."""


def counted(count: int, noun: str) -> str:
    """A number of things in words: 1 triangle, 2 triangles."""
    return f"{count} {noun}" if count == 1 else f"{count} {noun}s"


SENTENCES: dict[str, str] = {
    # metrics and optimisation
    "E_METRIC": "there is no metric of this name; the metrics are {known}",
    "E_OBJECTIVE": "the sum of this metric tells nothing about a mesh; choose another metric to optimise by",
    "E_OBJECTIVE:weight": "the weight {found} is no number above 0; write KEY=WEIGHT, for example stretch=2",
    "E_OPTIMIZER": "there is no optimiser of this name; there are {known}",
    "E_OPTIMIZER:rules": "fewest violations of which rules? Choose a rule set (--rules NAME or FILE)",
    "E_PLATE": "there is no plate {id} in the document; its plates are {known}",
    "E_CURVED": "curved surfaces: not yet; mesh the plane plates of the document",
    "E_CURVED:shared": "curved surfaces: not yet; mesh the plane plates of the document; the edges that it has in "
    "common with {neighbours} are divided by these alone",
    "E_CURVED:optimize": "the mesh is not flat, and the paper's method needs a plane; choose another optimiser",
    "E_PICTURE": "the plate has no mesh of which a picture could be made; mesh it first",
    # files
    "E_FILE:missing": "there is no such file; check the name and the folder",
    "E_FILE:folder": "this is a folder; give the name of a file",
    "E_FILE:special": "this is a device or a pipe, no ordinary file; give the name of a file",
    "E_FILE:large": "the file has {size:.1f} GiB, more than the 2 GiB that are read; divide the model",
    "E_FILE:other": "the file has {size:.1f} MiB, more than the {most:g} MiB of any file of this kind; check the name",
    "E_FILE:unreadable": "the file cannot be read: {reason}",
    "E_FILE:unwritable": "the file cannot be written: {reason}; nothing was changed",
    "E_FILE:no_folder": "there is no folder {folder}; make it first, or choose another",
    "E_FILE:output": "the result cannot be printed: {reason}; mesh files are written all the same",
    "E_FILE:protected_folder": "the folder {folder} is protected against writing; choose another",
    "E_FILE:protected": "the file is protected against writing; choose another name or remove the protection",
    "E_SUFFIX:read_mesh": "no mesh is read from files with the ending {suffix}, only from {known}",
    "E_SUFFIX:read_plates": "no plates are read from files with the ending {suffix}, only from {known}",
    "E_SUFFIX:picture": "no picture is written to files with the ending {suffix}, only to {known}",
    "E_SUFFIX:survey_plates": "no plates are read from files with the ending {suffix}, only from {known}",
    "E_SUFFIX:write_plates": "no plates are written to files with the ending {suffix}, only to {known}",
    "E_SUFFIX:write_mesh": "no mesh is written to files with the ending {suffix}, only to {known}",
    # meshes
    "E_EMPTY_MESH": "the mesh has no elements; there is nothing to judge or improve",
    "E_MESH:coordinate": "node {node} has a coordinate that is no number or beyond 1e15 mm ({count} in all); "
    "correct it, or the units, in the program that wrote the mesh",
    "E_MESH:no_node": "element {element} uses node {found}, but nodes count from 0 and there are {nodes}; correct the "
    "numbers of its nodes",
    "E_MESH:double_node": "element {element} uses a node twice ({count} in all); make it a triangle or remove it",
    "E_MESH:no_size": "all nodes of the elements are in one place; correct the coordinates",
    "E_VTU:empty": "the file is empty",
    "E_VTU:gzip": "the file is packed with gzip; unpack it first",
    "E_VTU:legacy": "this is a legacy VTK file; save it as VTU (unstructured grid), in ParaView by File, Save Data",
    "E_VTU:xml": "the file is damaged, cut off or no VTU file at line {line} column {column}: {reason}; write it again",
    "E_VTU:doctype": "the file has a document type, which no VTU file needs and which can hide harm; remove it",
    "E_VTU:deep": "XML elements lie more than {most} deep in each other, in a VTU file at most five; write it again",
    "E_VTU:not_vtk": "this is an XML file of another kind ({found}), no VTU file; save the mesh as VTU",
    "E_VTU:kind": "the data set is of type {found}, not UnstructuredGrid; save it as VTU (unstructured grid)",
    "E_VTU:unknown": "{attribute} is '{found}', which is not read; known are {known}",
    "E_VTU:truncated": "the file ends within the appended data; it was cut off, write or copy it again",
    "E_VTU:no_part": "the element {part} is missing; write the file again",
    "E_VTU:parts": "there are {count} elements {part} where one is read; merge the parts of the mesh before saving it",
    "E_VTU:count": "{attribute} is '{found}', which is no whole number from 0 to {most}",
    "E_VTU:no_array": "the data array '{name}' is missing; write the file again",
    "E_VTU:not_whole": "the data array '{name}' holds {found}, but whole numbers belong there",
    "E_VTU:columns": "the data array '{name}' has {found} numbers per row where {expected} belong",
    "E_VTU:length": "the data array '{name}' holds {found} numbers where {expected} belong; the file is damaged",
    "E_VTU:offset": "the data array '{name}' starts at '{found}', which is not within the appended data",
    "E_VTU:short": "the data array '{name}' ends too early; the file is cut off or damaged, write or copy it again",
    "E_VTU:damaged": "the data array '{name}' cannot be decoded; the file is damaged, write or copy it again",
    "E_VTU:cell": "element {element} is a {kind}; only meshes of vtkTriangle and vtkQuad are read, remove the others",
    "E_VTU:corners": "element {element} is a {kind} with {found} nodes; only triangles and quads are read",
    "E_VTU:no_node": "element {element} uses point {found}, but points count from 0 and there are {nodes}",
    "E_VTU:no_own_array": "the data array '{name}' of HullQuad is missing, others are there; write the mesh again, "
    "or remove 'hullquad version', 'node state' and 'node line' to have the mesh taken as it is",
    "E_VTU:range": "the data array '{name}' holds {found}; allowed is {least} to {most}",
    "E_VTU:label": "{name} {found} is there twice; labels must differ",
    "E_VTU:no_line": "node {node} slides on a line, but 'node line' does not tell on which",
    "E_VTU:not_finite": "the data array '{name}' holds something that is no number or beyond 1e15 mm",
    "E_VTU:length_value": "'{name}' is {found}; it must be a length above 0",
    "E_VTU:axes": "the axes in the data array 'plane' are not of unit length and square to each other",
    "E_VTU:moved": "a node is {away:.3g} mm from where 'plane' and 'parameters' put it: the mesh was moved by another "
    "program; remove 'hullquad version', 'node state' and 'node line' to have it taken as it is",
    # rules and criteria
    "E_RULES": "there is no rule set of this name, nor such a file; the rule sets are {known}",
    "E_FORMAT:other": 'the format is {shown}; here it must be "format": "{known}"',
    "E_MEASURE": "there is no measure {shown}; known are {known}",
    "E_MEASURE:alike": "there is no measure {shown}; did you mean {alike}?",
    "E_CHOICE": "{shown} is not known here; choose one of {known}",
    "E_CHOICE:alike": "{shown} is not known here; did you mean {alike}?",
    "E_BAND:count": "the least and the greatest acceptable value belong here, as in [null, 3], not {shown}",
    "E_BAND:open": "both ends are null, which limits nothing; give one of them, or remove the limit",
    "E_BAND:reversed": "the least acceptable value ({low:g}) is above the greatest ({high:g}); exchange the two",
    "E_BAND:beyond": "warn accepts what is an error; narrow warn, or widen error",
    "E_RULE:name": "the text is empty; say what is meant, or remove the key",
    "E_RULE:empty": "there are no rules; add at least one",
    "E_RULE:twice": "rule {earlier} (counted from 0) limits {measure} of these elements too; keep one of the two",
    "E_RULE:both": "what is not evaluated has no measure and no limits; remove these, or remove not_evaluated",
    "E_RULE:no_limit": "the rule has neither warn nor error; add a limit, or say why it is not_evaluated",
    "E_RULE:quads_only": 'triangles have no {measure}; add "elements": "quads"',
    "N_UNTOLD:thickness": "the mesh does not tell the thickness of its plate",
    "N_UNTOLD:target_size": "the mesh does not tell how large its elements should be",
    # worker
    "E_WORKER": "the computation broke down ({reason}) and was ended, nothing else is affected; check the input here, "
    "and report the fault together with it if it is sound",
    "E_CRASH": "the computation crashed ({ending}) and was ended, nothing else is affected; check the input here for "
    "damage, for crossing edges and for points that nearly coincide",
    "E_TIME": "the computation took longer than {seconds:g} s and was ended; choose a coarser size, simplify the input "
    "here, or allow more time",
    "E_MEMORY": "the computation needs more memory than the {memory:.1f} GiB it may take; choose a coarser size, "
    "or divide the input here",
    "E_CANCELLED": "the computation was cancelled; start it again when you need its result",
    # triangulation
    "E_CONTOUR:numbers": "the contour is not given as two numbers for each node; correct its coordinates",
    "E_CONTOUR:far": "the node ({u:.7g}, {v:.7g}) is no point within 1e12 mm of the origin; correct its coordinates",
    "E_CONTOUR:loops": "the contour is no row of loops with three nodes or more each; give every loop at least three",
    "E_CONTOUR:closing": "a loop repeats its first node at its end ({u:.7g}, {v:.7g}); leave the last one out",
    "E_CONTOUR:coincident": "{count} nodes nearly coincide with another one, as at ({u:.7g}, {v:.7g}); remove or "
    "move one",
    "E_CONTOUR:touching": "the node ({u:.7g}, {v:.7g}) touches an edge that is not its own; move it, or join the "
    "edges there",
    "E_CONTOUR:crossing": "the contour crosses itself at ({u:.7g}, {v:.7g}), or a hole there is not inside it; move "
    "the hole, or choose a smaller size if the divided edges cut what the true ones leave apart",
    "E_CONTOUR:turned": "the loop that begins at ({u:.7g}, {v:.7g}) runs the wrong way round; reverse it: "
    "counter-clockwise outside, clockwise around holes",
    "E_CONTOUR:outside": "the fixed point ({u:.7g}, {v:.7g}) lies outside of the plate or in a hole; move or remove it",
    "E_TRIANGLE:area": "the largest area of a triangle is {area}; it must be a number above 0",
    "E_TRIANGLE:angle": "the smallest angle of a triangle is {angle:g} degrees; it must be from 0 to {most:g}",
    "E_TRIANGLE:many": "about {triangles:.2g} triangles would be needed, {most:g} are allowed; choose a larger size",
    "E_TRIANGLE:given_up": "no triangles could be made: edges of very different lengths lie beside each other; divide "
    "the contour more evenly, or choose a larger size",
    "E_TRIANGLE:moved": "the triangles do not have the nodes of the contour; report the fault together with this plate",
    "E_TRIANGLE:unused": "{count} nodes belong to no triangle; look for points that nearly touch the contour here",
    "E_TRIANGLE:contour": "the triangles do not end at the contour; look for edges that nearly touch each other here",
    "E_TRIANGLE:lines": "the triangles do not follow the lines; look for lines that nearly touch each other here, or "
    "follow only their ends",
    "E_TRIANGLE:areas": "the triangles do not cover the plate exactly; look for edges that nearly touch each "
    "other here",
    # plates
    "OF_PLATE": "plate {plate}: ",
    "MORE": " (and {others} more errors)",
    "MORE:one": " (and 1 more error)",
    "E_FILE:encoding": "byte {byte} is not UTF-8; save the document as UTF-8 text",
    "E_JSON:empty": "the file is empty; a document in JSON is expected",
    "E_JSON:syntax": "this is no JSON ({reason}); look here for a missing comma, quote or bracket",
    "E_JSON:deep": "lists or objects lie too deep in each other for such a document; write it again",
    "E_JSON:repeated": "the key {key} is given twice; remove one of the two",
    "E_FORMAT": 'the format is {shown}; a plate document has "format": "hullplate"',
    "E_VERSION": "the version is {shown}; this program reads version {known}",
    "E_VERSION:newer": "version {shown} was made by a newer program; this one reads version {known}: update it, or "
    "save the document for version {known}",
    "E_TYPE:document": "the document is {shown}, but a plate document is an object with a format, units and plates",
    "E_TYPE:object": "an object in braces belongs here, not {shown}",
    "E_TYPE:list": "a list in square brackets belongs here, not {shown}",
    "E_TYPE:text": "a text in quotes belongs here, not {shown}",
    "E_TYPE:name": "the name is empty; give the document a name",
    "E_TYPE:surrogate": "the text {shown} contains half a character; type it again",
    "E_TYPE:flag": "true or false belongs here, not {shown}",
    **dict.fromkeys(
        [
            f"{code}:missing"
            for code in (
                *("E_TYPE", "E_RULE", "E_UNITS", "E_EMPTY", "E_ID", "E_MATERIAL", "E_THICKNESS"),
                *("E_FRAME", "E_OUTER", "E_SIZE", "E_POINT", "E_ELLIPSE", "E_SURFACE"),
            )
        ],
        "{key} is missing; add it",
    ),
    **dict.fromkeys(
        [f"{code}:positive" for code in ("E_MATERIAL", "E_THICKNESS", "E_SIZE", "E_ELLIPSE", "E_SURFACE")],
        "the value is {shown}; it must be above 0",
    ),
    "E_KEY": "there is no such key here; remove it, known are {known}",
    "E_KEY:alike": "there is no such key here; did you mean {alike}?",
    "E_UNITS": "the unit is {shown}; it must be {known}",
    "E_EMPTY": "the document has no plates; add at least one",
    "E_ID": "{shown} is no id; use 1 to 64 letters, digits, points, hyphens and underscores",
    "E_DUP_ID": "an earlier plate has the id {shown} too; give every plate its own",
    "E_NUMBER:kind": "a number belongs here, not {shown}; write it with digits and without quotes",
    "E_NUMBER:large": "{shown} is no number that can be meant here; correct it",
    "E_NUMBER:bulge": "with a bulge of {shown} the arc is a full circle, the most is {most:g}; divide it into two arcs",
    "E_POINT:count": "{count} coordinates in square brackets belong here, not {shown}",
    "E_POINT:far": "the point ({shown}) is more than 1000 km from the origin; correct its coordinates or the units",
    "E_POINT:range": "the point ({u:.7g}, {v:.7g}) is outside of the surface, whose parameters run over 0..1; move it "
    "inside",
    "E_VERTEX:missing": 'the vertex has no point; give it one: "p": [u, v]',
    "E_VERTEX:both": "the edge has a bulge and an ellipse; remove one of the two",
    "E_FRAME": "the axes u (length {u:.7g}) and v (length {v:.7g}) must be 1 long and square to each other (u.v is "
    "{dot:.3g}, not 0); correct them",
    "E_MATERIAL:unknown": "there is no material {shown}; choose one of {known}, or add it to the materials",
    "E_MATERIAL:none": "there is no material {shown}, for the document has none at all; add it to the materials",
    "E_MATERIAL:poisson": "Poisson's ratio is {shown}; it must be below 0.5",
    "E_DIVISIONS": "{shown} is no number of segments; use a whole number from 1 to {most}",
    "E_DIVISIONS:neighbour": "the edge cannot have {wished} segments: plate {other} asks for another number of the "
    "same edge, with which it has {bound}; give both the same",
    "E_DIVISIONS:edges": "there are {count} numbers for the {wanted} edges of the loop; give one for each edge",
    "E_DIVISIONS:holes": "there are {count} lists for {wanted} holes; give one for each hole",
    "E_OUTER": "the loop has too few vertices ({count}); it needs three, or two and a round edge between them",
    "E_SHORT_EDGE": "the edge that leaves ({u:.7g}, {v:.7g}) is {length:.3g}{unit} long, the least is {least:g}{unit}; "
    "remove the vertex, or move it (the first vertex is not repeated at the end)",
    "E_SELF_INTERSECT": "the loop crosses or touches itself at ({u:.7g}, {v:.7g}); correct the vertices or the arcs "
    "there",
    "E_SELF_INTERSECT:neck": "the loop touches itself at ({u:.7g}, {v:.7g}) within {least:g}{unit}; move the vertex "
    "away from the edge, or divide the plate there",
    "E_AREA": "the loop at ({u:.7g}, {v:.7g}) encloses no area; correct its vertices",
    "E_ELLIPSE:off": "the end ({u:.7g}, {v:.7g}) of the edge is {percent:.2g} % off its ellipse, 0.1 % are allowed; "
    "correct the ellipse or move the vertex",
    "E_ELLIPSE:thin": "the half axes {a:g} and {b:g} differ more than {most:g} times; draw the edge straight",
    "E_HOLE_OUTSIDE": "the hole at ({u:.7g}, {v:.7g}) is outside of the plate; move or remove it",
    "E_HOLE_OUTSIDE:crossing": "the hole at ({u:.7g}, {v:.7g}) crosses or touches the outer contour; move it inside, "
    "or cut the contour there",
    "E_HOLE_OVERLAP": "the hole at ({u:.7g}, {v:.7g}) overlaps or touches hole {hole}; move it, or join the two",
    "E_LIGAMENT:contour": "only {width:.2g}{unit} are left between the hole at ({u:.7g}, {v:.7g}) and the outer "
    "contour, the least is {least:g}{unit}; move the hole, or cut the contour there",
    "E_LIGAMENT:hole": "only {width:.2g}{unit} are left between the hole at ({u:.7g}, {v:.7g}) and hole {hole}, the "
    "least is {least:g}{unit}; move it, or join the two",
    "E_SHORT_LINE": "the line at ({u:.7g}, {v:.7g}) is {length:.3g}{unit} long, the least is {least:g}{unit}; remove "
    "it or move an end",
    "E_LINE_OUTSIDE": "the line leaves the plate, it reaches ({u:.7g}, {v:.7g}); end it on the contour",
    "E_POINT_OUTSIDE": "the point ({u:.7g}, {v:.7g}) is outside of the plate or in a hole; move or remove it",
    "E_SURFACE:type": "the surface is {shown}; known are {known}",
    "E_SURFACE:axis": 'the axis is {shown}; the axis of a cylinder is "u"',
    "E_SURFACE:param": 'only surfaces of type "bezier" have parameters over 0..1; remove param or change the surface',
    "E_SURFACE:degree": "the degree is {shown}; it is a list of two whole numbers from 1",
    "E_SURFACE:grid": "the control points must be rows of the same length, with at least one point",
    "E_SURFACE:control": "the degree asks for {rows} rows of {columns} control points; correct the one or the other",
    "E_SIZE:large": "elements of {size:g} mm are larger than any plate; choose a size below {most:g} mm",
    "E_TOO_BIG": "with elements of {size:g} mm the plate would have more than the {most:,} that are allowed; choose "
    "{least:g} mm or more",
    "E_TOO_BIG:divisions": "the numbers of divisions ask for {count:,} segments, too many for the {most:,} elements "
    "that are allowed; choose smaller ones",
    "E_COARSE": "with segments of {size:g} mm the straight sides cut something at ({u:.7g}, {v:.7g}) that the true "
    "edges leave apart; choose a smaller size: {helping:.4g} mm helps",
    "E_COARSE:always": "with segments of {size:g} mm the straight sides cut something at ({u:.7g}, {v:.7g}) that the "
    "true edges leave apart; choose a smaller size there, with larger numbers of divisions",
    "W_THICKNESS": "the plate is {thickness:g} mm thick; check the value and the units",
    "W_UNITS": "the plate's largest extent is {extent:g} mm; check the coordinates and the units",
    "W_LINE_HOLE": "the line crosses hole {hole}; it is cut there",
    "W_CORNER": "the corner at ({u:.7g}, {v:.7g}) has only {angle:.3g} degrees; no mesh is good there: cut the tip off",
    "W_CORNER:failing": "the corner at ({u:.7g}, {v:.7g}) has only {angle:.3g} degrees: the scaled Jacobian of a quad "
    "there is at most {best:.2f}, which fails, however the plate is meshed; cut the tip off",
    "W_SHORT_EDGE": "the edge is {length:.4g} mm long, less than a fifth of the element size ({size:g} mm), edges so "
    "short in this loop: {count}; the elements there will be small: choose {helping:.4g} mm or less, or move the "
    "vertex",
    "W_SMALL_HOLE": "the hole is {width:.4g} mm wide, less than the element size ({size:g} mm); the elements around it "
    "will be small: leave it out, or choose {helping:.4g} mm or less",
    "W_ODD": "odd number of contour edges: {count} with segments of {size:g} mm; one triangle is unavoidable, one node "
    "more or fewer on an edge makes it none",
    "W_ODD:edge": "odd number of contour edges: {count} with segments of {size:g} mm; one triangle is unavoidable, one "
    "node more or fewer on an edge makes it none, best {number} segments instead of {before} at {where}",
    "W_ODD:shared": "odd number of contour edges: {count} with segments of {size:g} mm; one triangle is unavoidable, "
    "one node more or fewer on an edge makes it none, best {number} segments instead of {before} at {where}, which "
    "other plates have too",
    "W_TRIANGLES": "{excess} triangles more than the plate asks for are left: elements {which}; no change takes them "
    "out with valid elements only, for too few nodes between them may be moved; choose a smaller size, or divide an "
    "edge there otherwise",
    "W_TRIANGLES:paper": "{excess} triangles more than the plate asks for are left: elements {which}; the paper's "
    "mesher leaves those that find no partner, the best mesher leaves {unavoidable}",
    "W_TRIANGLES:quality": "{excess} triangles more than the plate asks for are left: elements {which}; the "
    "worst element is better so, and quality is preferred: prefer quads for the fewest triangles",
    "W_ODD_PART": "the part of the plate around ({u:.7g}, {v:.7g}) has an odd number of edges ({count}), and no line "
    "of its own that may be divided otherwise; one triangle is unavoidable there, one node more or fewer on one of "
    "its edges on the contour makes it none",
    "W_LINE_BESIDE": "from ({u:.7g}, {v:.7g}) to ({to_u:.7g}, {to_v:.7g}) the line runs beside the contour or another "
    "line, nearer than {least:.3g} mm; elements do not follow it there (lines with such parts: {count}): move it upon "
    "the other one, or away",
    "W_LINE_NEAR:contour": "at ({u:.7g}, {v:.7g}) the line is only {width:.3g} mm from the contour, too narrow for "
    "elements of {size:g} mm that follow it (lines so near: {count}); choose {helping:.4g} mm or less, or follow only "
    "the ends of lines",
    "W_LINE_NEAR:line": "at ({u:.7g}, {v:.7g}) the line is only {width:.3g} mm from another one, too narrow for "
    "elements of {size:g} mm that follow both (lines so near: {count}); choose {helping:.4g} mm or less, or follow "
    "only the ends of lines",
    "W_LINE_SHORT": "around ({u:.7g}, {v:.7g}) a piece of the line is {length:.3g} mm long, less than a fifth of the "
    "element size ({least:.4g} mm); the elements that follow it will be small (lines with such pieces: {count}): let "
    "lines meet in one point",
    "W_LINE_ANGLE": "at ({u:.7g}, {v:.7g}) the line meets the contour or another line under only {angle:.3g} degrees: "
    "the scaled Jacobian of a quad that follows both is at most {best:.2f}, which fails (lines with such angles: "
    "{count}); follow only the ends of lines, or end the line elsewhere",
    "W_SIZE": "elements of {size:g} mm are larger than the plate, whose extent is {extent:.4g} mm: its edges will have "
    "one segment each; only sizes below that make a difference",
    "W_LIGAMENT:contour": "the strip of {width:.3g} mm between the hole and the outer contour at ({u:.7g}, {v:.7g}) is "
    "too narrow for elements of {size:g} mm; choose {helping:.4g} mm or less, or larger numbers of divisions there",
    "W_LIGAMENT:hole": "the strip of {width:.3g} mm to hole {hole} at ({u:.7g}, {v:.7g}) is too narrow for elements of "
    "{size:g} mm; choose {helping:.4g} mm or less, or larger numbers of divisions there",
    "W_LIGAMENT:neck": "at ({u:.7g}, {v:.7g}) the plate is only {width:.3g} mm wide, too narrow for elements of "
    "{size:g} mm; choose {helping:.4g} mm or less, or larger numbers of divisions there",
    "W_SNAP:neighbour": "the node was moved by {distance:.2g} mm to ({u:.7g}, {v:.7g}), where plate {neighbour} has "
    "it; correct the one or the other if that is not meant",
    "W_GAP": "the edge lies {distance:.3g} mm beside plate {neighbour} and is not joined to it, as only gaps up to "
    "{most:g} mm are; move it there, or farther away if the plates are to stay apart",
    "W_SNAP": "the point was moved by {distance:.2g} mm to the node at ({u:.7g}, {v:.7g})",
    "W_NEAR": "the fixed point ({u:.7g}, {v:.7g}) is only {distance:.2g} mm from the contour or from another one, "
    "with elements of {size:g} mm; the elements between will be slivers: move it there, or away",
    "W_COARSE": "with segments of the target size ({size:g} mm) the straight sides cut something at ({u:.7g}, "
    "{v:.7g}); a smaller size is needed for meshing: {helping:.4g} mm helps",
    "W_COARSE:always": "with segments of the target size ({size:g} mm) the straight sides cut something at ({u:.7g}, "
    "{v:.7g}); larger numbers of divisions are needed for meshing",
}
