"""The surveys as pictures: which row stands where, and how it looks."""
