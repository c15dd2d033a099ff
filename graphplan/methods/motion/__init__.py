"""How motion is drawn: velocities, and the plan of relative normal accelerations."""
