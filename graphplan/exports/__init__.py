"""The steps exported: the construction as dependent objects of geometry programs, and of TeX."""
