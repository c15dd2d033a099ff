"""Linkages of other programs become scenes: GeoGebra, DXF, Linkage and PMKS."""
