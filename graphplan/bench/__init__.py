"""Where the method stands: speed against accuracy on two drawing boards, the machine's and the draughtsman's.

Each module measures one picture's data, and says which row stands where and how it looks: `machine` time against error,
`draughtsman` operations against pencil error, `stability` where each method fails, on both boards, and what serves
there, `growth` time against size.
"""
