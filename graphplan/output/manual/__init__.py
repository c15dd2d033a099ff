"""The manual: the gallery as a small site, offline, made from the records that the program itself reads."""
