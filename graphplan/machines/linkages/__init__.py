"""Mass centre and balancing of linkages: principal vectors, shaking forces, counterweights, engines."""
