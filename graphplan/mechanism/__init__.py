"""What is given: scenes, their records, pairs, fields, units and faults."""
