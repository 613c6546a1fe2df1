"""Robot models: the car, its motions and their closed forms."""
