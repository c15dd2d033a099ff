"""The order in which to draw: the planner, the plans of motion and of forces, and the construction that they make."""
