"""What the columns of a sheet say: the task, the steps, tables and results."""
