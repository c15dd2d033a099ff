// Opens pages in a headless browser and prints where their marks are, in the pose given and with a point dragged.
// Reads a JSON list of pages on standard input: {html, points: [id], lines: [id], ..., drag: {id, x, y}}.
const {JSDOM, VirtualConsole} = require("jsdom");
const fs = require("fs");

function values(figure, marks) {
  const found = {};
  for (const [id, kind] of Object.entries(marks)) {
    const mark = figure.marks[id];
    if (kind === "point") found[id] = [mark.X(), mark.Y()];
    if (kind === "line") {
      const [c, a, b] = mark.stdform, n = a * a + b * b;
      found[id] = [-a * c / n, -b * c / n, b, -a];
    }
    if (kind === "opening") found[id] = [mark()];
    if (kind === "circle") found[id] = [mark.center.X(), mark.center.Y(), mark.Radius()];
  }
  return found;
}

const answers = JSON.parse(fs.readFileSync(0, "utf-8")).map(({html, marks, drag}) => {
  const problems = [];
  const quiet = new VirtualConsole();
  quiet.on("jsdomError", (error) => problems.push(String(error.detail || error.message)));
  const {window} = new JSDOM(html, {runScripts: "dangerously", pretendToBeVisual: true, virtualConsole: quiet});
  const {document, figure} = window, answer = {problems, text: document.getElementById("sentence").textContent};
  if (figure) {
    answer.given = values(figure, marks);
    if (drag) {
      figure.marks[drag.id].setPosition(window.JXG.COORDS_BY_USER, [drag.x, drag.y]);
      figure.board.update();
      answer.dragged = values(figure, marks);
    }
    document.getElementById("back").click();
    answer.number = document.getElementById("number").textContent;
    answer.last = document.getElementById("sentence").textContent;
    answer.hidden = figure.board.objectsList.filter((one) => one.visProp.visible === false).length;
    document.getElementById("step").value = 0;
    document.getElementById("step").dispatchEvent(new window.Event("input"));
    answer.none = figure.board.objectsList.filter((one) => one.visProp.visible === false).length;
  }
  window.close();
  return answer;
});
console.log(JSON.stringify(answers));
