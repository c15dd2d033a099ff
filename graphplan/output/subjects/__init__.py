"""Sheets and numbers of subjects: flywheel, motion, balancing of linkages and rotors, cams.
"""

from __future__ import annotations






