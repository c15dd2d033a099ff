"""The public layer: what `import graphplan` offers, and the commands of the core.

Each function takes a scene and keywords, and gives something that nobody changes: numbers in the scene's units, vectors
as complex numbers, angles and travels in degrees. What it needs is imported when it is called.
"""
