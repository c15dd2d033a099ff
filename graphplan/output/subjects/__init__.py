"""Sheets and numbers of subjects: flywheel, motion, balancing of linkages and rotors, cams.
"""
