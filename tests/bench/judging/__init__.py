"""Hand drawings made apart from the judge: what students with wobble and mistakes of their own hand in, and a table of
how it is judged."""
