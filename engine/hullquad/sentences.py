"""Every sentence that the engine says of an error, by code (and case): the table that gets translated."""

SENTENCES: dict[str, str] = {
    # metrics and optimisation
    "E_METRIC": "there is no metric of this name; the metrics are {known}",
    "E_CURVED:optimize": "the mesh is not flat, and curved surfaces: not yet; optimise plane plates only",
}
