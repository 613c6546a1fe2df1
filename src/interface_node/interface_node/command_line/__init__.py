"""The ``geohtn`` command: starts the three nodes, plans missions with them, and tells people."""
