{
const count = DATA.squares.length, panels = DATA.shares.length, all = [...Array(count).keys()];
const sum = (list, of) => list.reduce((total, item, at) => total + of(item, at), 0);
// Roots in ascending order and unit vectors, in columns, of a symmetric matrix: cyclic Jacobi rotations.
const jacobi = matrix => {
  const A = matrix.map(row => row.slice()), Q = all.map(i => all.map(j => +(i === j)));
  const turn = (row, p, q, c, s) => [row[p], row[q]] = [c * row[p] - s * row[q], s * row[p] + c * row[q]];
  for (let sweep = 0; sweep < 12; sweep++) for (let p = 0; p < count; p++) for (let q = p + 1; q < count; q++) {
    if (A[p][q] === 0) continue;
    const z = (A[q][q] - A[p][p]) / (2 * A[p][q]), t = (z < 0 ? -1 : 1) / (Math.abs(z) + Math.hypot(1, z));
    const c = 1 / Math.hypot(1, t), s = t * c;
    A.forEach(row => turn(row, p, q, c, s));
    for (let i = 0; i < count; i++) [A[p][i], A[q][i]] = [c * A[p][i] - s * A[q][i], s * A[p][i] + c * A[q][i]];
    Q.forEach(row => turn(row, p, q, c, s));
  }
  const order = all.slice().sort((a, b) => A[a][a] - A[b][b]);
  return { roots: order.map(i => A[i][i]), vectors: Q.map(row => order.map(i => row[i])) };
};
// Test mode j is answered by partner[j]: the pair whose |m| is nearest to one first (4).
const paired = cross => {
  const pairs = all.flatMap(j => all.map(i => ({ i, j, far: Math.abs(1 - Math.abs(cross[i][j])) })));
  const partner = Array(count).fill(-1);
  for (const { i, j } of pairs.sort((a, b) => a.far - b.far)) if (partner[j] < 0 && !partner.includes(i)) partner[j] = i;
  return partner;
};
const unit = shape => { const most = Math.max(...shape.map(Math.abs)); return shape.map(part => part / most); };
// The modes at factors on the panels' stiffness: Ω² + Σ (s - 1) Vᵗ B Kₑ Bᵗ V; errors (5) and (6).
const solved = factors => {
  const stiffness = all.map(i => all.map(j => (i === j ? DATA.squares[i] : 0)
    + sum(factors, (s, e) => (s - 1) * DATA.shares[e][Math.max(i, j) * (Math.max(i, j) + 1) / 2 + Math.min(i, j)])));
  const { roots, vectors } = jacobi(stiffness);
  const shapes = DATA.shapes.map(row => all.map(j => sum(row, (part, i) => part * vectors[i][j])));
  const cross = all.map(i => all.map(j => sum(DATA.masses, (mass, d) => shapes[d][i] * mass * DATA.test[d][j])));
  const partner = paired(cross), hertz = partner.map(i => Math.sqrt(Math.max(roots[i], 0)) / (2 * Math.PI));
  const off = hertz.map((f, j) => f / DATA.hertz[j] - 1);
  const shape = Math.sqrt(sum(all, j => {
    const mine = unit(shapes.map(row => row[partner[j]])), test = unit(DATA.test.map(row => row[j]));
    const sign = cross[partner[j]][j] < 0 ? -1 : 1;
    return sum(mine, (part, d) => (sign * part - test[d]) ** 2) / count;
  }));
  return { hertz, off, frequency: Math.sqrt(sum(off, x => x * x)), shape };
};
// Factors on the stiffness after one more step: they add, at least a thousandth is left, or they are those on the gages.
const next = (stiffness, before, after) => stiffness.map((s, e) => Math.max(DATA.least, s + after[e] / before[e] - 1));
const added = DATA.steps.slice(1).reduce((list, gages, at) => [...list, next(list[at], DATA.steps[at], gages)], [DATA.steps[0]]);
const histories = { adds: added.map(solved), follows: DATA.steps.map(solved) };
const at = (step, gages, adds) => solved(adds ? next(added[step], DATA.steps[step], gages) : gages);
const show = () => {
  // Where a chapter has kept a place for it.
  document.getElementById("play-place")?.replaceWith(document.getElementById("play"));
  const get = name => document.getElementById("play-" + name), slider = get("slider"), adds = get("adds");
  const FIRST = DATA.mils, LEAST = 4, MOST = 18, high = mils => 100 * (mils - LEAST) / (MOST - LEAST);
  let gages = DATA.steps[0].slice(), isMoved = false;
  const tag = (name, attributes, text = "") =>
    `<${name} ${Object.entries(attributes).map(([key, value]) => `${key}="${value}"`).join(" ")}>${text}</${name}>`;
  const percent = x => (100 * x).toFixed(1).replace(/^-0\.0$/, "0.0").replace("-", "−");
  const bars = DATA.steps[0].map((_, e) => {
    const label = document.createElement("label");
    label.innerHTML = `<input type="range" min="${LEAST}" max="${MOST}" step="0.05" aria-label="gage of panel ${e + 1}"><b>${e + 1}</b><span></span>`;
    const bar = get("gages").appendChild(label).firstChild;
    bar.oninput = () => { gages[e] = bar.value / FIRST; isMoved = true; draw(); };
    return bar;
  });
  const truth = get("gages").appendChild(document.createElement("hr"));
  truth.style.top = 150 * (1 - high(DATA.truth) / 100) + "px";
  const canvas = (svg, height) => {
    const wide = Math.max(300, svg.parentNode.clientWidth || 560);
    svg.setAttribute("viewBox", `0 0 ${wide} ${height}`);
    return wide;
  };
  const drawModes = off => {
    const wide = canvas(get("modes"), 210), room = wide / count, y = x => 150 - 420 * Math.max(-0.12, Math.min(0.3, x));
    get("modes").innerHTML = tag("line", { x1: 0, x2: wide, y1: y(0), y2: y(0), stroke: "currentColor" })
      + off.map((x, j) => {
        const middle = room * (j + 0.5), mark = { stroke: "var(--bar)", "stroke-width": 3 };
        return tag("line", { x1: middle, x2: middle, y1: y(0), y2: y(x), ...mark })
          + tag("circle", { cx: middle, cy: y(x), r: 5, fill: "var(--bar)" })
          + tag("text", { x: middle, y: x < 0 ? y(x) + 18 : y(x) - 9, "text-anchor": "middle" }, percent(x))
          + tag("text", { x: middle, y: 208, "text-anchor": "middle" }, j + 1);
      }).join("");
  };
  const drawPath = now => {
    const wide = canvas(get("path"), 210), step = +slider.value, left = 30, right = 12;
    const x = k => left + (wide - left - right) * k / (DATA.steps.length - 1);
    const y = e => 184 - 172 * Math.max(0, Math.min(1, Math.log(e / 0.02) / Math.log(40)));
    const path = (list, style) => tag("path", { fill: "none", "stroke-width": 2, ...style,
      d: list.map((it, k) => `${k ? "L" : "M"}${x(k).toFixed(1)},${y(it.frequency + it.shape).toFixed(1)}`).join("") });
    const chosen = adds.checked, ends = [histories.adds, histories.follows].map(list => list[list.length - 1]);
    get("path").innerHTML = [0.02, 0.05, 0.1, 0.2, 0.5].map(e =>
        tag("line", { x1: left, x2: wide - right, y1: y(e), y2: y(e), stroke: "var(--line)", "stroke-opacity": 0.35 })
        + tag("text", { x: left - 5, y: y(e) + 4, "text-anchor": "end" }, 100 * e)).join("")
      + [0, 10, 20, 30].map(k => tag("text", { x: x(k), y: 204, "text-anchor": "middle" }, k)).join("")
      + path(histories.adds, { stroke: "var(--bar)", "stroke-opacity": chosen ? 1 : 0.35 })
      + path(histories.follows, { stroke: "var(--other)", "stroke-dasharray": "6 3", "stroke-opacity": chosen ? 0.35 : 1 })
      + tag("circle", { cx: x(step), cy: y(now), r: 5, fill: chosen ? "var(--bar)" : "var(--other)" })
      + tag("text", { x: x(28.5), y: y(ends[0].frequency + ends[0].shape) - 10, "text-anchor": "end" }, "adds")
      + tag("text", { x: x(27), y: y(ends[1].frequency + ends[1].shape) - 24, "text-anchor": "end" }, "follows the gage; ◇ exact")
      + tag("path", { d: `M${x(30)},${y(DATA.exact) - 6}l6,6l-6,6l-6,-6z`, fill: "none", stroke: "currentColor", "stroke-width": 1.6 });
  };
  const draw = () => {
    const step = +slider.value, now = isMoved ? at(step, gages, adds.checked) : histories[adds.checked ? "adds" : "follows"][step];
    bars.forEach((bar, e) => {
      if (bar !== document.activeElement || !isMoved) bar.value = FIRST * gages[e];
      bar.style.setProperty("--high", high(FIRST * gages[e]) + "%");
      bar.parentNode.lastChild.textContent = (FIRST * gages[e]).toFixed(1);
      bar.setAttribute("aria-valuetext", (FIRST * gages[e]).toFixed(2) + " thousandths of an inch");
    });
    get("step").textContent = (step ? `After step ${step}` : "First model") + (isMoved ? ", then by hand" : "");
    get("sum").textContent = percent(now.frequency + now.shape) + " %";
    get("frequency").textContent = percent(now.frequency) + " %";
    get("shape").textContent = percent(now.shape) + " %";
    drawModes(now.off);
    drawPath(now.frequency + now.shape);
  };
  slider.oninput = () => { gages = DATA.steps[+slider.value].slice(); isMoved = false; draw(); };
  adds.onchange = draw;
  get("reset").onclick = () => { slider.value = 0; adds.checked = true; slider.oninput(); };
  addEventListener("resize", draw);
  draw();
};
if (typeof document === "undefined") module.exports = { DATA, solved, at, histories }; else show();
}
