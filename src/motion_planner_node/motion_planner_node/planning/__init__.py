"""How the motion planner works a request out: problem, proofs, destinations, paths, answers."""
