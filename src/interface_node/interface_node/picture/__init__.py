"""``mission.png``: the mission as a picture, in the manner of the paper's Figure 5."""

from interface_node.picture.drawing import draw, write_picture

__all__ = ['draw', 'write_picture']
