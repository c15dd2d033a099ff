"""Which drawing of a scene is made: designs, what each costs by a pencil's errors, and the choice among them."""
