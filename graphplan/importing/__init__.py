"""Linkages of other programs become scenes: GeoGebra, DXF, Linkage and PMKS.

A reader a format makes a sketch (sketch.py), which is tidied alike for all; written.py says it as a scene, and
proposed.py sees to it that the scene moves, or that a comment or the refusal says why not.
"""
