"""``mission.mcap``: writing and reading what happened in a mission."""
