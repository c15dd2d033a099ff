"""Cams: from the law of the follower to the base circle, the profile and the steps that construct it."""
