"""Meshes that several tests roll with, as text of a case file: a coarse sector of a roller, and a block whose top is at
z = 0."""

MESHES = """[meshes.roller]
type = "roller"
radius = 0.4
bore_radius = 0.36
arc_start = -0.03
arc_end = 0.03
zone_size = 0.004
coarse_size = 0.02
zone_layers = 2
[meshes.block]
type = "box"
origin = [-0.05, -0.05, -0.02]
size = [0.1, 0.1, 0.02]
divisions = [5, 5, 1]
"""
