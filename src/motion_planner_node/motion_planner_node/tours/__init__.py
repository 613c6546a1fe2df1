"""Orders in which to meet many sets of preconditions, and where: short tours."""
