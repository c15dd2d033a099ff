"""What is drawn: strokes, marks and symbols on their plans, in mm of paper."""
