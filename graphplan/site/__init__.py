"""The manual: a small site, offline, of the gallery, a tutorial, chapters in Markdown, and tables made from records."""
