"""Orders for many goals: the local search beside routing libraries, on the same matrices."""
