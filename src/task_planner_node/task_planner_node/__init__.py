"""GeoHTN's task planner: an HTN search whose operators carry geometric preconditions."""
