"""The desktop program: shows plates, meshes and their quality, and computes none of it."""

ENGINE_COMMANDS = ("mesh", "optimize", "quality")
"""Subcommands that are the engine's: they need neither Qt nor a screen."""
