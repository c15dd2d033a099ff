"""The page around JSXGraph elements: a board, buttons and a slider for the steps, the sentence of the step shown."""

from __future__ import annotations

import re

PAGE = """\
<!DOCTYPE html>
<html lang="%LANGUAGE%">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>%TITLE%</title>
<style>
  body { margin: 0; display: flex; flex-direction: column; height: 100vh; }
  body { font: 15px/1.4 "DejaVu Sans", Verdana, sans-serif; }
  header, footer { padding: 0.4em 1em; }
  h1 { margin: 0; font-size: 1.1em; }
  header p, #sentence { margin: 0; }
  #sentence { min-height: 2.8em; }
  #board { flex: 1; min-height: 300px; overflow: hidden; background: #fff; }
  footer div { display: flex; gap: 0.5em; align-items: center; }
  #step { flex: 1; }
</style>
%LIBRARY%
</head>
<body>
<header><h1>%TITLE%</h1><p>%SOURCE%</p></header>
<main id="board" style="width: 100%"></main>
<footer>
<div>
<button id="back" title="%BACK%">&#9664;</button>
<input id="step" type="range" min="0" max="%STEPS%" value="%STEPS%" aria-label="%STEP%">
<button id="next" title="%NEXT%">&#9654;</button>
<output id="number"></output>
</div>
<p id="sentence" aria-live="polite"></p>
</footer>
<script>
"use strict";
const sentences = %SENTENCES%;

// On the board x runs to the right and y up, in mm of paper.
function construction() {
  const board = JXG.JSXGraph.initBoard("board", {boundingbox: %BOX%, keepaspectratio: true, axis: false,
    showCopyright: false, zoom: {wheel: true}, pan: {enabled: true, needTwoFingers: false, needShift: false}});
  const M = {}, drawn = [];
  const seen = (step, element) => { drawn.push([step, element]); return element; };
  const by = (P, l, along, across) => {  // so many mm from a point along a line, and to the left of it
    const [, a, b] = l.stdform, n = Math.hypot(a, b);
    return [P.X() + (along * b + across * a) / n, P.Y() + (across * b - along * a) / n];
  };
  const turned = (P, C, degrees) => {
    const t = degrees * Math.PI / 180, c = Math.cos(t), s = Math.sin(t), x = P.X() - C.X(), y = P.Y() - C.Y();
    return [C.X() + c * x - s * y, C.Y() + s * x + c * y];
  };
  board.suspendUpdate();
%ELEMENTS%
  board.unsuspendUpdate();
  const show = (step) => {
    board.suspendUpdate();
    for (const [number, element] of drawn) element.setAttribute({visible: number <= step});
    board.unsuspendUpdate();
  };
  return {board, marks: M, show};
}

// The steps, by button, slider or arrow keys.
function stepper(figure) {
  const slider = document.getElementById("step");
  const go = (step) => {
    slider.value = step;
    const shown = Number(slider.value);
    figure.show(shown);
    document.getElementById("number").textContent = shown + " / " + sentences.length;
    document.getElementById("sentence").textContent = shown ? sentences[shown - 1] : %BEGIN%;
  };
  slider.addEventListener("input", () => go(slider.value));
  document.getElementById("back").addEventListener("click", () => go(Number(slider.value) - 1));
  document.getElementById("next").addEventListener("click", () => go(Number(slider.value) + 1));
  document.getElementById("number").textContent = sentences.length + " / " + sentences.length;
  document.getElementById("sentence").textContent = %DRAG%;
}

if (typeof JXG === "undefined") {
  document.getElementById("sentence").textContent = %MISSING%;
} else {
  window.figure = construction();
  stepper(window.figure);
}
</script>
</body>
</html>
"""


def page(**parts: str) -> str:
    """The page with its parts in their places."""
    return re.sub("%([A-Z]+)%", lambda word: parts[word[1].lower()], PAGE)
