"""The search: task networks, states with an undo trail, geometric requests, and explanations."""
