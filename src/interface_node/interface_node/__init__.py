"""GeoHTN's interface: dispatches missions, joins actions and paths, records, draws and replays."""
