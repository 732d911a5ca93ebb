"""Quadrilateral meshes of ship hull plates: made, judged and improved."""


def __getattr__(name: str) -> str:
    """Version of the program; looked up only when asked for, because that takes as long as starting Python."""
    if name != "__version__":
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from importlib.metadata import PackageNotFoundError, version  # noqa: PLC0415

    try:
        __version__ = version("hullquad")
    except PackageNotFoundError:  # started from a checkout that was never installed
        __version__ = "0.1.0"
    return __version__
