"""Tolerances of what is imported: of what size each is a part, and why it is so large."""

PLACE_TOL = 1e-9  # of the sketch: points that rounding alone keeps apart, and pins that lie on a line
# of the sketch: slots and links that are no further off one line, or a level, lie on it; files have seven digits or
# more
LINE_TOL = 1e-6
JOINT_TOL = 2e-4  # of the drawing: ends that are so near are one joint, as they are drawn by hand at a screen
DIRECTION_TOL = 1e-6  # of a unit vector: by which the directions of bars in one line differ
# of the mechanism and its places: a piston's two joints that are no further apart are one; addresses have few digits
PISTON_TOL = 1e-6
SLOT_TOL = 0.01  # of a curved slot's radius: a pin is drawn into it by hand, and its own place counts
# radians: half of the last of three decimals, by which a guide may miss a multiple of 15 degrees that it plainly has
ANGLE_TOL = 5e-4
DECIMAL_TOL = 1e-5  # radians: half of the third decimal of a degree, by which a rounded angle was rounded again
THOUSANDTH = 1.001e-3  # of the file's unit: by which an end of a guide whose ends have three decimals may miss a line
# by how much a driving angle or number of a drawing moves, to see which lengths change; one way alone may be a turning
# point
STEPS = (0.01, -0.017)
