"""Where the method stands: speed against accuracy on two drawing boards, the machine's and the draughtsman's.

Each module measures one picture's data: `machine` time against error, `draughtsman` operations against pencil error,
`stability` error near the places where methods fail, `best_forms` the forms over a cycle, `growth` time against size.
"""
