"""A program as bare arithmetic: recorded once through its own rules, then replayed at the speed of the machine.

`record` runs the rules on symbols, keeps what they do, and writes it down as straight-line Python for one pose;
`blocks` writes it as numpy calls on blocks of poses that stay in cache, or as a loop for numba. All give the very
numbers that the rules give; where one of the rules' questions might fail, they hand the pose back to the rules.
"""
