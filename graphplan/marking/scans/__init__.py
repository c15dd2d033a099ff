"""Scans and photos, read as traces."""
