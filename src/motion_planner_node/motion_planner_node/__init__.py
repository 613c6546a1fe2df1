"""GeoHTN's motion planner: meets geometric preconditions and plans the way there."""
