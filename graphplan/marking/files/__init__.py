"""Drawing programs' files, read as traces."""
