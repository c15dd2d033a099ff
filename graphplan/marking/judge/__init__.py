"""Hand drawings judged: each step from the student's own earlier marks, with the tolerance that a pencil needs."""
