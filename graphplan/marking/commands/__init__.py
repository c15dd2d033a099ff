"""The commands of a class: its tasks, and what is said of its drawings."""
