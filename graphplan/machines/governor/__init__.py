"""Governors: the force that holds their balls, its characteristic, and friction."""
