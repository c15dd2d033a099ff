"""Drawings for CAD programs: layers, entities, and the mechanism in its own size."""
