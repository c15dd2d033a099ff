"""Record of this leaf, by which the core finds it: the machine over its cycle, and the errors of its positions."""

from graphplan.leaves import Command, Leaf, TaskKind
from graphplan.phrases import said

LEAF = Leaf(
    commands={
        "flywheel": Command("machine", "graphplan.machines.flywheel.command"),
        "motion": Command("machine", "graphplan.machines.motion.command"),
        "balance": Command("machine", "graphplan.machines.balance_command", takes_scene=False),
        "errors": Command("machine", "graphplan.machines.errors.command"),
    },
    names={"graphplan.machines.subjects": "balance flywheel motion",
           "graphplan.machines.errors.subject": "position_errors"},
    tasks={"rotor": TaskKind(("rotor",), "balance", said("Keys of a rotor"), "graphplan.machines.rotors.rotor")},
    results=("flywheel", "motion"),
)
