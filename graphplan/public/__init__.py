"""The public layer: what `import graphplan` offers, and all that the command line calls.

Each function takes a scene and keywords, and gives something that nobody changes: numbers in the scene's units, vectors
as complex numbers, angles and travels in degrees. What it needs is imported when it is called.
"""
