"""The board: a mechanism is drawn with the mouse in a browser, and its sheet, steps and results follow."""
