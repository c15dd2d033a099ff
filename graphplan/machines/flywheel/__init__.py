"""The steady cycle: energy, Wittenbauer's diagram, the flywheel, and how it is drawn."""
