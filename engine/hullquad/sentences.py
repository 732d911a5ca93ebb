"""Every sentence that the engine says of an error, by code (and case): the table that gets translated."""

SENTENCES: dict[str, str] = {
    # metrics and optimisation
    "E_METRIC": "there is no metric of this name; the metrics are {known}",
    "E_CURVED:optimize": "the mesh is not flat, and curved surfaces: not yet; optimise plane plates only",
    # files
    "E_FILE:missing": "there is no such file; check the name and the folder",
    "E_FILE:folder": "this is a folder; give the name of a file",
    "E_FILE:special": "this is a device or a pipe, no ordinary file; give the name of a file",
    "E_FILE:large": "the file has {size:.1f} GiB, more than the 2 GiB that are read; divide the model",
    "E_FILE:unreadable": "the file cannot be read: {reason}",
    "E_FILE:unwritable": "the file cannot be written: {reason}; nothing was changed",
    "E_FILE:no_folder": "there is no folder {folder}; make it first, or choose another",
    "E_FILE:protected_folder": "the folder {folder} is protected against writing; choose another",
    "E_FILE:protected": "the file is protected against writing; choose another name or remove the protection",
    "E_SUFFIX:read_mesh": "no mesh is read from files with the ending {suffix}, only from {known}",
    "E_SUFFIX:read_plates": "no plates are read from files with the ending {suffix}, only from {known}",
    "E_SUFFIX:write_mesh": "no mesh is written to files with the ending {suffix}, only to {known}",
    # meshes
    "E_EMPTY_MESH": "the mesh has no elements; there is nothing to judge or improve",
    "E_MESH:coordinate": "node {node} has a coordinate that is no number or beyond 1e15 mm (so have {count} nodes); "
    "correct it, or the units, in the program that wrote the mesh",
    "E_MESH:double_node": "element {element} uses a node twice (so do {count}); make it a triangle or remove it",
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
}
