"""On what it is drawn: one file a format, imported when it is called."""
