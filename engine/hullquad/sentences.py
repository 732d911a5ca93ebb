"""Every sentence that the engine says of an error, by code (and case): the table that gets translated."""

SENTENCES: dict[str, str] = {}
