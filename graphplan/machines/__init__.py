"""The machine over its cycle: reduction to one link, energy and flywheel, true motion, balancing."""
