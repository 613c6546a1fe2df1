"""Robots: models, bodies, and motions in closed form."""
