"""Where it lies: paper, scales, panels and pages."""
