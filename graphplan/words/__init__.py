"""The tongues that graphplan speaks: English, which stands in the code, and the catalogues beside this file."""

LANGUAGES = ("en", "de", "lv", "et", "ru", "uk")
