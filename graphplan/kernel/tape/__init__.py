"""A program as bare arithmetic: recorded once through its own rules, then replayed at the speed of the machine.

`record` runs the rules on symbols and keeps what they do. All else are readings of that: `written` writes it as
statements of a language (Python for one pose, C, JavaScript), `blocks` as numpy calls on blocks of poses that stay in
the cache, `machine` as a loop in the assembly of LLVM. All give the very numbers that the rules give; where one of the
rules' questions fails, they hand the pose back.
"""
