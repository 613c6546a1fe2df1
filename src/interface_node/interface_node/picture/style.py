"""The picture's colours and lines."""

from __future__ import annotations

from matplotlib.colors import LinearSegmentedColormap

#: Of the first attitude, when it was assigned, of the last and of those between.
START, END, BETWEEN = '#1a9641', '#d7191c', '#2c5f9e'
#: The way of a single robot, from its start to its end.
PROGRESS = LinearSegmentedColormap.from_list('progress', [START, '#2c7fb8', '#7b3294', END])
OBJECTIVE, INK, QUIET = '#ffd23f', '#22262b', '#6b7480'
#: Lines from an attitude to what its action regards: objects, and other robots.
VIEW, PAIR = (0, (4, 3)), (0, (1, 2))
