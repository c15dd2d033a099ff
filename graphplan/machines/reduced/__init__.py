"""Reduction to one link: the inertia and the moment that stand for all masses, loads and friction."""
