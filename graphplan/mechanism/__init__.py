"""Scenes as they are given: their records, pairs, fields, units and faults."""
