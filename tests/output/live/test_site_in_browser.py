"""The site in Chromium: scenes are filtered, and everyone can read it, by light and dark, at a desk and on a phone."""

from __future__ import annotations

from pathlib import Path

import pytest
from face import ran
from live_browser import browser

PAGES = ("index", "scenes", "tutorial", "reference", "four-bar", "manual/python")
FAULTS = """() => {
  const faults = [], luminance = (colour) => {
    const parts = colour.match(/[\\d.]+/g).slice(0, 3).map((part) => part / 255)
      .map((part) => part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4);
    return 0.2126 * parts[0] + 0.7152 * parts[1] + 0.0722 * parts[2];
  };
  const ground = (element) => {
    for (let at = element; at; at = at.parentElement) {
      const colour = getComputedStyle(at).backgroundColor;
      if (colour !== "rgba(0, 0, 0, 0)") return colour;
    }
    return "rgb(255, 255, 255)";
  };
  for (const element of document.querySelectorAll("p, a, li, h1, h2, h3, th, td, pre, caption, figcaption, label")) {
    const [a, b] = [getComputedStyle(element).color, ground(element)].map(luminance);
    if ((Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05) < 4.5) faults.push(`pale ${element.tagName}`);
  }
  for (const element of document.querySelectorAll("main *"))
    if (element.scrollWidth > element.clientWidth + 1 && getComputedStyle(element).overflowX === "auto"
        && element.tabIndex < 0) faults.push(`out of the keyboard's reach: ${element.tagName}`);
  let level = 0;
  for (const heading of document.querySelectorAll("h1, h2, h3, h4, h5, h6")) {
    const next = Number(heading.tagName[1]);
    if (next > level + 1) faults.push(`after h${level} comes h${next}`);
    level = next;
  }
  for (const image of document.querySelectorAll("img")) if (!image.alt) faults.push(`no words for ${image.src}`);
  for (const field of document.querySelectorAll("input")) if (!field.labels.length) faults.push("no label");
  for (const place of ["nav", "main", "h1"])
    if (document.querySelectorAll(place).length !== 1) faults.push(`not one ${place}`);
  if (document.documentElement.scrollWidth > innerWidth) faults.push("wider than the screen");
  return [...new Set(faults)];
}"""


@pytest.fixture(scope="module")
def site(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A site with a scene, in a folder that was not there."""
    folder = tmp_path_factory.mktemp("sites") / "new" / "site"
    assert ran("gallery", folder, "four-bar", "--brief", "-q").status == 0
    return folder


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_everyone_can_read_it(site: Path, scheme: str) -> None:
    """Contrast, headings, landmarks, labels, words for pictures and the keyboard's reach are as WCAG asks, on all
    pages; none is wider than a phone."""
    for width in (1400, 390):
        page = browser().new_page(color_scheme=scheme, viewport={"width": width, "height": 800})
        for name in PAGES:
            page.goto((site / f"{name}.html").as_uri())
            assert page.evaluate(FAULTS) == [], f"{name} at {width}"
        page.close()


def test_it_is_dark_where_that_is_wished(site: Path) -> None:
    """The ground follows the scheme of the system."""
    grounds = []
    for scheme in ("light", "dark"):
        page = browser().new_page(color_scheme=scheme)
        page.goto((site / "index.html").as_uri())
        grounds.append(page.evaluate("getComputedStyle(document.body).backgroundColor"))
        page.close()
    assert grounds[0] == "rgb(255, 255, 255)"
    assert max(map(int, grounds[1].strip("rgb()").split(","))) < 50


def test_the_filter_leaves_the_scenes_with_all_words(site: Path) -> None:
    """Words of title, source and topic are looked for, in any order and case; without any all scenes are there."""
    page = browser().new_page()
    page.goto((site / "scenes.html").as_uri())
    for words, is_there in (("jaanimets COUPLER", True), ("coupler shaper", False), ("pin joints", True), ("", True)):
        page.get_by_role("searchbox").fill(words)
        assert page.get_by_text("Four-bar linkage with a coupler point").is_visible() is is_there, words
    page.close()


def test_the_start_page_moves(site: Path) -> None:
    """It shows a construction in motion, which stands still where one wishes so, and leads to all six lessons."""
    start, moving = (site / "index.html").read_text(), (site / "moving.svg").read_text()
    assert '<img src="moving.svg"' in start
    assert "<animate" in moving
    assert "prefers-reduced-motion" in moving
    assert [start.count(f"tutorial.html#lesson-{number}") for number in range(1, 8)] == [1] * 6 + [0]
    assert "moving.svg" in (site / "README.md").read_text()
